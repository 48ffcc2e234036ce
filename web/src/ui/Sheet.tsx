// The grid: column and row headers, tiles, and the enlarged tile over all of it.
import { useEffect, useRef, useState } from "preact/hooks";
import { columnName, formatAddress, parseAddress, type Address } from "../model/address";
import { gridWindow, linesShown, sameWindow, type GridWindow } from "../model/grid_window";
import { gridHeader, isCramped, tileSize } from "../model/grid_zoom";
import { isSelected, moveSelection, selectColumn, selectRow, selectSheet, type Selection } from "../model/selection";
import type { SheetState } from "../api/types";
import { currentSheet } from "../state/book";
import { useApp, useSelect } from "./app_context";
import { SharedColourBar } from "./ColourBar";
import { focusHeading, focusTitle, insertReference } from "./FormulaBar";
import { LevelsPanel } from "./levels/LevelsPanel";
import { SheetTabs } from "./SheetTabs";
import { Tile } from "./Tile";

function modifiersOf(event: MouseEvent): { extend: boolean; toggle: boolean } {
    return { extend: event.shiftKey, toggle: event.ctrlKey || event.metaKey };
}

function focusHeader(selection: Selection): void {
    const name =
        selection.kind === "columns" ? columnName(selection.active.column) : String(selection.active.row + 1);
    focusHeading(name);
}

/** Arrow keys on titles and headers move the selection; the focus goes along. */
function useHeaderKeys(sheet: SheetState): (event: KeyboardEvent) => void {
    const { store } = useApp();
    const steps: Record<string, [number, number]> = {
        ArrowLeft: [-1, 0],
        ArrowRight: [1, 0],
        ArrowUp: [0, -1],
        ArrowDown: [0, 1],
    };
    return (event) => {
        const step = steps[event.key];
        const target = event.target as HTMLElement;
        if (!step || !(target.dataset["titleOf"] || target.dataset["header"])) return;
        event.preventDefault();
        event.stopPropagation();
        const selection = moveSelection(store.get().page.selection, step[0], step[1], event.shiftKey, sheet);
        store.dispatch({ type: "page/select", selection });
        if (selection.kind === "cells") focusTitle(formatAddress(selection.active));
        else focusHeader(selection);
    };
}

function ColumnHeader({ column, sheet }: { column: number; sheet: SheetState }) {
    const { store } = useApp();
    const name = columnName(column);
    const selected = useSelect((state) => {
        const { selection } = state.page;
        return selection.kind === "sheet" || (selection.kind === "columns" && isSelected(selection, { column, row: 0 }));
    });
    const cells = sheet.cells.filter((cell) => cell.cell.replace(/[0-9]+$/, "") === name).map((cell) => cell.cell);
    return (
        <div
            class={`column-header ${selected ? "selected" : ""}`}
            role="columnheader"
            aria-selected={selected}
            aria-colindex={column + 1}
            style={{ gridColumn: column + 2, gridRow: 1 }}
        >
            <button
                type="button"
                data-header={name}
                title={`Select column ${name}`}
                onClick={(event) =>
                    store.dispatch({
                        type: "page/select",
                        selection: selectColumn(store.get().page.selection, column, modifiersOf(event)),
                    })
                }
            >
                {name} {sheet.columnTitles?.[name] && <span>{sheet.columnTitles[name]}</span>}
            </button>
            <SharedColourBar cells={cells} />
        </div>
    );
}

function RowHeader({ row, title }: { row: number; title: string | undefined }) {
    const { store } = useApp();
    const selected = useSelect((state) => {
        const { selection } = state.page;
        return selection.kind === "sheet" || (selection.kind === "rows" && isSelected(selection, { column: 0, row }));
    });
    return (
        <div
            class={`row-header ${selected ? "selected" : ""}`}
            role="rowheader"
            aria-selected={selected}
            style={{ gridColumn: 1, gridRow: row + 2 }}
        >
            <button
                type="button"
                data-header={String(row + 1)}
                title={`Select row ${row + 1}${title ? `: ${title}` : ""}`}
                onClick={(event) =>
                    store.dispatch({
                        type: "page/select",
                        selection: selectRow(store.get().page.selection, row, modifiersOf(event)),
                    })
                }
            >
                {row + 1} {title && <span>{title}</span>}
            </button>
        </div>
    );
}

/** The scrolled element and its size in CSS pixels. */
interface Area {
    width: number;
    height: number;
    element: HTMLElement;
}

/** The part of the grid that is in view; the others have no elements. */
function useWindow(sheet: SheetState, tile: { width: number; height: number }, area: Area): GridWindow {
    const measures = {
        columns: sheet.columns,
        rows: sheet.rows,
        tile,
        header: gridHeader,
    };
    const now = (): GridWindow => {
        const { scrollLeft, scrollTop } = area.element;
        return gridWindow(measures, { left: scrollLeft, top: scrollTop }, area);
    };
    const [, redraw] = useState(0);
    const shown = useRef(now());
    const latest = useRef(now);
    latest.current = now;
    const current = now();
    if (!sameWindow(current, shown.current)) shown.current = current;
    useEffect(() => {
        const onScroll = (): void => {
            if (!sameWindow(latest.current(), shown.current)) redraw((count) => count + 1);
        };
        area.element.addEventListener("scroll", onScroll, { passive: true });
        return () => area.element.removeEventListener("scroll", onScroll);
    }, [area.element]);
    return shown.current;
}

/** Cells that keep their elements wherever the sheet is scrolled to: the one with the focus, and the enlarged one. */
function useKeptCells(): Address[] {
    const active = useSelect((state) => formatAddress(state.page.selection.active));
    const enlarged = useSelect((state) => state.page.enlarged);
    return [active, enlarged].map((name) => (name ? parseAddress(name) : null)).filter((cell): cell is Address => cell !== null);
}

function Grid({ sheet, area }: { sheet: SheetState; area: Area }) {
    const { store } = useApp();
    const enlarged = useSelect((state) => state.page.enlarged);
    const onKeyDown = useHeaderKeys(sheet);
    const zoom = useSelect((state) => state.page.gridZoom);
    const size = tileSize(sheet, area, zoom);
    const shown = useWindow(sheet, size, area);
    const kept = useKeptCells().filter((cell) => cell.column < sheet.columns && cell.row < sheet.rows);
    const columns = linesShown(shown.firstColumn, shown.lastColumn, kept.map((cell) => cell.column));
    const rows = linesShown(shown.firstRow, shown.lastRow, kept.map((cell) => cell.row));
    const isShown = (row: number, column: number): boolean =>
        (row >= shown.firstRow && row <= shown.lastRow && column >= shown.firstColumn && column <= shown.lastColumn) ||
        kept.some((cell) => cell.row === row && cell.column === column);
    const style = {
        gridTemplateColumns: `${gridHeader.width}px repeat(${sheet.columns}, ${size.width}px)`,
        gridTemplateRows: `${gridHeader.height}px repeat(${sheet.rows}, ${size.height}px)`,
    };
    return (
        <div
            class={`grid ${enlarged ? "has-enlarged" : ""} ${isCramped(size) ? "cramped" : ""}`}
            style={style}
            role="grid"
            aria-label={`Sheet ${sheet.name}`}
            aria-multiselectable="true"
            aria-rowcount={sheet.rows}
            aria-colcount={sheet.columns}
            onKeyDown={onKeyDown}
        >
            <div role="row" class="row">
                <div class="corner" role="columnheader">
                    <button
                        type="button"
                        aria-label="Select the whole sheet"
                        title="Select the whole sheet"
                        onClick={() =>
                            store.dispatch({ type: "page/select", selection: selectSheet(store.get().page.selection) })
                        }
                    />
                </div>
                {columns.map((column) => (
                    <ColumnHeader key={column} column={column} sheet={sheet} />
                ))}
            </div>
            {rows.map((row) => (
                <div role="row" class="row" key={row} aria-rowindex={row + 1}>
                    <RowHeader row={row} title={sheet.rowTitles?.[String(row + 1)]} />
                    {columns
                        .filter((column) => isShown(row, column))
                        .map((column) => (
                            <DropTile key={`${sheet.name} ${column}`} address={{ column, row }} cramped={isCramped(size)} />
                        ))}
                </div>
            ))}
        </div>
    );
}

export const datasetDragType = "application/x-voxsheet-dataset";

/** A tile that takes a dataset dragged from the list. */
function DropTile({ address, cramped }: { address: Address; cramped: boolean }) {
    const app = useApp();
    const [over, setOver] = useState(false);
    const takes = (event: DragEvent): boolean => event.dataTransfer?.types.includes(datasetDragType) ?? false;
    return (
        <div
            class={`tile-slot ${over ? "drop-target" : ""}`}
            role="presentation"
            style={{ gridColumn: address.column + 2, gridRow: address.row + 2 }}
            onDragOver={(event) => {
                if (!takes(event)) return;
                event.preventDefault();
                setOver(true);
            }}
            onDragLeave={() => setOver(false)}
            onDrop={(event) => {
                setOver(false);
                const name = event.dataTransfer?.getData(datasetDragType);
                if (!name) return;
                event.preventDefault();
                void app.cells.setSource(formatAddress(address), name).then((objection) => {
                    if (objection) app.notices.error(objection);
                });
            }}
        >
            <Tile address={address} cramped={cramped} />
        </div>
    );
}

function useAreaSize() {
    const area = useRef<HTMLDivElement>(null);
    const [size, setSize] = useState({ width: 0, height: 0 });
    useEffect(() => {
        const observer = new ResizeObserver(([entry]) => {
            if (!entry) return;
            const { width, height } = entry.contentRect;
            setSize({ width, height });
        });
        observer.observe(area.current!);
        return () => observer.disconnect();
    }, []);
    return { area, size };
}

/** Ctrl + wheel on a header zooms the grid, rather than the browser's page. */
function useHeaderWheel(area: { current: HTMLElement | null }): void {
    const { grid } = useApp();
    useEffect(() => {
        const element = area.current!;
        const onWheel = (event: WheelEvent): void => {
            const onHeader = (event.target as HTMLElement).closest(".column-header, .row-header, .corner") !== null;
            if (!onHeader || !(event.ctrlKey || event.metaKey) || event.deltaY === 0) return;
            event.preventDefault();
            grid.step(event.deltaY < 0 ? 1 : -1);
        };
        element.addEventListener("wheel", onWheel, { passive: false });
        return () => element.removeEventListener("wheel", onWheel);
    }, []);
}

export function Sheet() {
    const sheet = useSelect((state) => currentSheet(state.book));
    const { area, size } = useAreaSize();
    /** While a formula is typed, a press on a cell puts its address there instead of selecting it. */
    const takePress = (event: PointerEvent | MouseEvent): void => {
        const cell = (event.target as HTMLElement).closest<HTMLElement>("[data-cell]")?.dataset["cell"];
        if (!cell) return;
        if (event.type === "pointerdown") swallowing.current = insertReference(cell);
        if (!swallowing.current) return;
        event.preventDefault();
        event.stopPropagation();
        if (event.type === "click") swallowing.current = false;
    };
    const swallowing = useRef(false);
    useHeaderWheel(area);
    return (
        <main class="sheet-area">
            <div
                class="grid-scroll"
                ref={area}
                onPointerDownCapture={takePress}
                onMouseDownCapture={takePress}
                onClickCapture={takePress}
            >
                {sheet && area.current && size.width > 0 && (
                    <Grid key={sheet.name} sheet={sheet} area={{ ...size, element: area.current }} />
                )}
            </div>
            <SheetTabs />
            <LevelsPanel />
        </main>
    );
}
