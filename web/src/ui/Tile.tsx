// One cell: title strip, picture, and what stands over the picture.
import { Link2Off, Loader, TriangleAlert } from "lucide-preact";
import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import { PictureController } from "../app/picture_controller";
import type { CellState } from "../api/types";
import { formatAddress, type Address } from "../model/address";
import { formatPercent, probeText } from "../model/format";
import { hasOwnCamera } from "../model/look";
import { isPlane } from "../model/plane_view";
import { isSelected, selectCell } from "../model/selection";
import { cellOf, cellTitle, currentSheet } from "../state/book";
import { isMoving } from "../state/page";
import { newTile, type TileInfo } from "../state/tiles";
import { useApp, useSelect } from "./app_context";
import { ClipHandles } from "./clip/ClipHandles";
import { ColourBar } from "./ColourBar";
import { CrosshairLines } from "./CrosshairLines";
import { LevelBadge } from "./levels/LevelBadge";
import { NoteMark } from "./NoteMark";
import { OrientationMarks } from "./OrientationMarks";
import { PictureGestures } from "../input/picture_gestures";

function TileError({ code, message }: { code: string; message: string }) {
    const [open, setOpen] = useState(false);
    const end = message.indexOf(". ");
    const first = end > 0 ? message.slice(0, end + 1) : message;
    return (
        <div class="tile-error" role="alert">
            <span class="error-code">
                <TriangleAlert size={16} aria-hidden="true" /> {code || "Error"}
            </span>
            <p>{open ? message : first}</p>
            {first !== message && (
                <button type="button" class="text-button" aria-expanded={open} onClick={() => setOpen(!open)}>
                    {open ? "less" : "details"}
                </button>
            )}
        </div>
    );
}

function TileProgress({ progress, label }: { progress: number; label: string }) {
    const known = progress > 0 && progress < 1;
    return (
        <div class="tile-waiting">
            <Loader size={18} class="spin" aria-hidden="true" />
            <span>
                {label} {known ? formatPercent(progress) : ""}
            </span>
            <div
                class="progress"
                role="progressbar"
                aria-label={label}
                aria-valuemin={0}
                aria-valuemax={100}
                aria-valuenow={known ? Math.round(100 * progress) : undefined}
            >
                <i style={{ width: known ? `${100 * progress}%` : "100%" }} />
            </div>
        </div>
    );
}

function pictureKeys(cell: CellState | undefined): string {
    return isPlane(cell) ? "Arrow keys move it, brackets step through the volume" : "Arrow keys turn it";
}

/** Not while people drag: they know, and a layer for the bar of each of many cells slows all their pictures down. */
function Refining() {
    const moving = useSelect((state) => isMoving(state.page));
    return moving ? null : <div class="refining" aria-hidden="true" />;
}

function ProbeChip({ cell }: { cell: string }) {
    const found = useSelect((state) => state.page.probe?.values.find((value) => value.cell === cell) ?? null);
    if (!found) return null;
    return <output class="probe-chip">{probeText(found)}</output>;
}

/** What the stream says about a cell comes with its frames; what the workbook says comes with edits. The newer error wins. */
function shownState(cell: CellState | undefined, tile: TileInfo): { state: string; code: string; message: string; progress: number } {
    if (!cell || cell.state === "empty") return { state: "empty", code: "", message: "", progress: 0 };
    if (cell.state !== "ok") {
        const streamed = tile.state === cell.state;
        return {
            state: cell.state,
            code: cell.code || tile.code,
            message: cell.message || tile.message,
            progress: streamed ? tile.progress : (cell.progress ?? 0),
        };
    }
    return { state: tile.state === "empty" ? "ok" : tile.state, code: tile.code, message: tile.message, progress: tile.progress };
}

function usePicture(cell: string) {
    const app = useApp();
    const picture = useRef<HTMLDivElement>(null);
    const canvas = useRef<HTMLCanvasElement>(null);
    useEffect(() => {
        const element = picture.current!;
        const surface = canvas.current!;
        const size = (): { width: number; height: number } => {
            const box = element.getBoundingClientRect();
            return { width: Math.round(box.width), height: Math.round(box.height) };
        };
        new PictureGestures(element, new PictureController(app, cell, size));
        app.painter.register(cell, surface);
        app.sizes.watch(cell, element);
        return () => {
            app.painter.unregister(cell, surface);
            app.sizes.unwatch(element);
        };
    }, [app, cell]);
    return { picture, canvas };
}

/** \param cramped  too small for marks on the picture, unless it is enlarged */
export function Tile({ address, cramped }: { address: Address; cramped: boolean }) {
    const app = useApp();
    const { store, view } = app;
    const name = formatAddress(address);
    const cell = useSelect((state) => cellOf(currentSheet(state.book), name));
    const tile = useSelect((state) => state.tiles[name] ?? newTile);
    const selected = useSelect((state) => isSelected(state.page.selection, address));
    const active = useSelect((state) => formatAddress(state.page.selection.active) === name);
    const enlarged = useSelect((state) => state.page.enlarged === name);
    const own = useSelect((state) => {
        const current = cellOf(currentSheet(state.book), name);
        return current !== undefined && current.state !== "empty" && hasOwnCamera(state.page.look, current);
    });
    const clipHandles = useSelect((state) => state.page.clipHandles);
    const { picture, canvas } = usePicture(name);
    const title = cellTitle(cell);
    const shown = shownState(cell, tile);
    const drawn = shown.state === "ok";
    const marked = enlarged || !cramped;
    const titleProps = useMemo(
        () => ({
            onClick: (event: MouseEvent) => {
                const modifiers = { extend: event.shiftKey, toggle: event.ctrlKey || event.metaKey };
                const selection = selectCell(store.get().page.selection, address, modifiers);
                store.dispatch({ type: "page/select", selection });
            },
            onDblClick: () => view.reset(null),
        }),
        [store, view, address.column, address.row],
    );

    return (
        <div
            class={`tile ${selected ? "selected" : ""} ${active ? "active" : ""} ${enlarged ? "enlarged" : ""}`}
            role="gridcell"
            aria-selected={selected}
            aria-colindex={address.column + 1}
            data-cell={name}
            data-state={shown.state}
        >
            <div class="tile-title">
                <button
                    type="button"
                    class="title-button"
                    data-title-of={name}
                    tabIndex={active ? 0 : -1}
                    title={title ? `${name}: ${title}. Double-click resets the view` : name}
                    {...titleProps}
                >
                    <b>{name}</b> <span>{title}</span>
                </button>
                {own && (
                    <button
                        type="button"
                        class="badge"
                        title="This cell has a camera of its own; click to follow the others again"
                        aria-label={`Link the camera of ${name} again`}
                        onClick={() => view.reset(name)}
                    >
                        <Link2Off size={12} aria-hidden="true" />
                    </button>
                )}
                {drawn && tile.painted && <NoteMark cell={name} />}
                {drawn && tile.painted && <LevelBadge cell={name} />}
            </div>
            <div
                class="picture"
                ref={picture}
                data-picture-of={name}
                tabIndex={active ? 0 : -1}
                role={clipHandles ? "group" : "img"}
                aria-label={
                    drawn
                        ? `Picture of ${name}: ${title}. ${pictureKeys(cell)}, plus and minus zoom, Enter enlarges.`
                        : `${name}: ${shown.state === "empty" ? "empty" : `${shown.code} ${shown.message}`}`
                }
                onDblClick={() => drawn && view.enlarge(enlarged ? null : name)}
            >
                <canvas ref={canvas} class={drawn && tile.painted ? "" : "blank"} width={1} height={1} />
                {drawn && !tile.final && <Refining />}
                {drawn && tile.painted && marked && <OrientationMarks cell={name} />}
                {drawn && tile.painted && <CrosshairLines cell={name} />}
                {drawn && tile.painted && marked && <ColourBar cell={name} />}
                {drawn && clipHandles && !isPlane(cell) && <ClipHandles cell={name} />}
                {drawn && <ProbeChip cell={name} />}
                {shown.state === "importing" && <TileProgress progress={shown.progress} label="Importing" />}
                {shown.state === "error" && <TileError code={shown.code} message={shown.message} />}
                {shown.state === "empty" && <span class="tile-empty">empty</span>}
            </div>
        </div>
    );
}
