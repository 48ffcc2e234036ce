// Rescaling with one press, and the range in numbers: its ends, or window and level.
import type { CellState } from "../api/types";
import { plainNumber } from "../model/format";
import { rangeOfWindowLevel, windowLevelOf } from "../model/value_range";
import type { ValueRange } from "../model/transfer";
import { useApp, useSelect } from "./app_context";
import { TextField } from "./TextField";

/** As the picture shows it now: with the drag under way, if there is one. */
function useShownRange(cell: string): ValueRange | null {
    const low = useSelect((state) => state.page.live[cell]?.["range.min"] ?? state.book.bars[cell]?.low);
    const high = useSelect((state) => state.page.live[cell]?.["range.max"] ?? state.book.bars[cell]?.high);
    return typeof low === "number" && typeof high === "number" ? { low, high } : null;
}

function NumberField({ label, text, set }: { label: string; text: number; set: (value: number) => void }) {
    return (
        <label>
            <span>{label}</span>
            <TextField
                numeric
                label={`range ${label}`}
                value={plainNumber(text)}
                set={(typed) => {
                    const value = Number(typed);
                    if (typed.trim() !== "" && Number.isFinite(value)) set(value);
                }}
            />
        </label>
    );
}

function CustomRange({ range }: { range: ValueRange }) {
    const { ranges } = useApp();
    const set = (next: ValueRange): void => void ranges.setTo(next);
    const { window, level } = windowLevelOf(range);
    return (
        <div class="custom-range" role="group" aria-label="Range in numbers">
            <NumberField label="min" text={range.low} set={(low) => set({ ...range, low })} />
            <NumberField label="max" text={range.high} set={(high) => set({ ...range, high })} />
            <NumberField label="window" text={window} set={(wide) => set(rangeOfWindowLevel({ window: wide, level }))} />
            <NumberField label="level" text={level} set={(middle) => set(rangeOfWindowLevel({ window, level: middle }))} />
        </div>
    );
}

export function RangeTools({ cell }: { cell: CellState }) {
    const { ranges } = useApp();
    const range = useShownRange(cell.cell);
    const steps = useSelect((state) => state.book.datasets.find(({ name }) => name === cell.dataset)?.steps ?? 1);
    const button = (label: string, doc: string, press: () => Promise<void>) => (
        <button type="button" class="chip" title={doc} data-rescale={label} onClick={() => void press()}>
            {label}
        </button>
    );
    return (
        <>
            <div class="range-tools" role="group" aria-label="Rescale to">
                {steps > 1
                    ? button("data", `From the smallest to the largest value of ${cell.cell} at this time step`, () => ranges.fitTo(cell.cell, "data"))
                    : button("data", "From the smallest to the largest value, each cell by its own", () => ranges.follow("own"))}
                {button("visible", `From the smallest to the largest value that the picture of ${cell.cell} shows now`, () => ranges.fitTo(cell.cell, "visible"))}
                {steps > 1 && button("over time", "From the smallest to the largest value of all time steps, each cell by its own", () => ranges.follow("own"))}
                {button("linked cells", "One range for all these cells that show the same quantity in the same unit", () => ranges.follow("shared"))}
                {button("linked, symmetric", "One range for all these cells that show the same quantity in the same unit, the same on both sides of zero", () =>
                    ranges.follow("shared symmetric"),
                )}
                {button("symmetric", "The same on both sides of zero, each cell by its own largest magnitude", () => ranges.follow("symmetric"))}
            </div>
            {range && <CustomRange range={range} />}
        </>
    );
}
