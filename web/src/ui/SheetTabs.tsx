// The sheets of the workbook, and how many columns the one on show has.
import { Maximize2, Minimize2, Minus, Pause, Play, Plus, StepBack, StepForward, ZoomIn, ZoomOut } from "lucide-preact";
import { currentSheet } from "../state/book";
import { useApp, useSelect } from "./app_context";
import { IconButton } from "./IconButton";

function Player() {
    const { view } = useApp();
    const steps = useSelect((state) => Math.max(1, ...state.book.datasets.map((dataset) => dataset.steps ?? 1)));
    const playing = useSelect((state) => state.page.playing);
    const time = useSelect((state) => state.page.look.style["time"] ?? currentSheet(state.book)?.cells[0]?.style["time"]?.value);
    if (steps < 2) return null;
    return (
        <div class="player" role="group" aria-label="Time">
            <IconButton icon={StepBack} label="Step back" keys="," onClick={() => view.advance(-1)} />
            <IconButton
                icon={playing ? Pause : Play}
                label={playing ? "Pause" : "Play"}
                keys="space"
                onClick={() => view.togglePlaying()}
            />
            <IconButton icon={StepForward} label="Step forward" keys="." onClick={() => view.advance(1)} />
            <span>
                step {typeof time === "number" ? time + 1 : 1} of {steps}
            </span>
        </div>
    );
}

export function SheetTabs() {
    const app = useApp();
    const names = useSelect(
        (state) => state.book.book?.sheets.map((sheet) => sheet.name).join("\n") ?? "",
    ).split("\n");
    const sheet = useSelect((state) => currentSheet(state.book));
    const enlarged = useSelect((state) => state.page.enlarged);
    const zoom = useSelect((state) => state.page.gridZoom);
    if (!sheet) return null;
    return (
        <div class="sheet-tabs">
            <div role="tablist" aria-label="Sheets" class="tabs">
                {names.map((name) => (
                    <button
                        type="button"
                        key={name}
                        role="tab"
                        aria-selected={name === sheet.name}
                        onClick={() => name !== sheet.name && app.showSheet(name)}
                    >
                        {name}
                    </button>
                ))}
            </div>
            <Player />
            {enlarged && (
                <IconButton
                    icon={Minimize2}
                    label={`Back from ${enlarged} to the sheet`}
                    keys="Esc"
                    text="back to the sheet"
                    onClick={() => app.view.enlarge(null)}
                />
            )}
            <div class="stepper" role="group" aria-label="Size of the tiles">
                <IconButton icon={ZoomOut} label="Smaller tiles, more cells" keys="Shift + Z" onClick={() => app.grid.step(-1)} />
                {zoom !== 1 && <IconButton icon={Maximize2} label="Fit the tiles to the window" keys="0" onClick={() => app.grid.fit()} />}
                <IconButton icon={ZoomIn} label="Larger tiles, fewer cells" keys="Z" onClick={() => app.grid.step(1)} />
            </div>
            <div class="stepper" role="group" aria-label="Columns">
                <span>columns</span>
                <IconButton
                    icon={Minus}
                    label="One column fewer"
                    disabled={sheet.columns <= 1}
                    onClick={() => void app.cells.setColumns(sheet.columns - 1)}
                />
                <output>{sheet.columns}</output>
                <IconButton icon={Plus} label="One column more" onClick={() => void app.cells.setColumns(sheet.columns + 1)} />
            </div>
        </div>
    );
}
