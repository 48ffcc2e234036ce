// Rows of numbers: each number a field, rows added and removed; "none" or "auto" where there are no rows.
import { Plus, X } from "lucide-preact";
import { formatAddress } from "../model/address";
import { plainNumber } from "../model/format";
import { keyLabel } from "../model/keys";
import { cameraOf } from "../model/look";
import { newRow, type RowContext } from "../model/new_row";
import { numbersPerLine, rowShape, rowsOf, valueOfRows, withNumber } from "../model/number_rows";
import { cellOf, currentSheet } from "../state/book";
import { useApp } from "./app_context";
import { IconButton } from "./IconButton";
import type { ControlProps } from "./KeyControl";
import { TextField } from "./TextField";

/** One hundredth of a number's size, rounded to a decimal place; 0.01 at least for small ones. */
function stepOf(value: number): number {
    const size = Math.abs(value);
    return size <= 1 ? 0.01 : 10 ** (Math.floor(Math.log10(size)) - 1);
}

function useRowContext(): () => RowContext {
    const { store, styles } = useApp();
    return () => {
        const { book, page } = store.get();
        const name = formatAddress(page.selection.active);
        const cell = cellOf(currentSheet(book), name);
        const bar = book.bars[name];
        return {
            camera: cameraOf(page.look, cell),
            units: styles.shownValue(name, "clip.units") === "world" ? "world" : "fraction",
            box: cell?.box ?? null,
            range: bar ? { low: bar.low, high: bar.high } : null,
        };
    };
}

export function NumberRows({ spec, value, id, set, nudge }: ControlProps) {
    const context = useRowContext();
    const shape = rowShape(spec);
    const rows = rowsOf(value, shape.columns) ?? [];
    const perLine = numbersPerLine(shape.columns);
    const label = keyLabel(spec.name, spec.group);
    const standsFor = rows.length === 0 ? (typeof value === "string" ? value : spec.takesNone ? "none" : "auto") : null;
    const emptyWord = spec.takesNone ? "none" : spec.takesAuto ? "auto" : null;
    const written = (next: readonly (readonly number[])[]) => valueOfRows(next, shape.columns, shape.maxRows);
    const clamped = (number: number): number => Math.min(shape.max, Math.max(shape.min, number));
    const remove = (row: number): void => {
        const left = rows.filter((_, i) => i !== row);
        if (left.length >= Math.max(1, shape.minRows)) set(written(left));
        else if (emptyWord) set(emptyWord);
    };
    const mayRemove = rows.length > Math.max(1, shape.minRows) || emptyWord !== null;
    const mayAdd = rows.length < shape.maxRows;
    const rowName = shape.maxRows > 1 ? (row: number): string => `${label} ${row + 1}` : (): string => label;
    return (
        <div class={`rows-control ${shape.columns === 1 ? "values" : ""}`} role="group" aria-label={label} id={id}>
            {rows.map((numbers, row) => (
                <div class="number-row" key={row}>
                    <div class="numbers" style={{ gridTemplateColumns: `repeat(${perLine}, minmax(0, 1fr))` }}>
                        {numbers.map((number, column) => {
                            const name = shape.columnNames[column] ?? "";
                            return (
                                <label class="named-number" key={column}>
                                    {shape.columns > 1 && <small aria-hidden="true">{name}</small>}
                                    <TextField
                                        numeric
                                        label={`${rowName(row)} ${name}`.trim()}
                                        value={plainNumber(number)}
                                        set={(typed) => {
                                            const next = Number(typed);
                                            if (typed.trim() !== "" && Number.isFinite(next)) set(written(withNumber(rows, row, column, next)));
                                        }}
                                        step={(by) => {
                                            const next = Number((number + by * stepOf(number)).toPrecision(10));
                                            nudge(written(withNumber(rows, row, column, clamped(next))));
                                        }}
                                    />
                                </label>
                            );
                        })}
                    </div>
                    {mayRemove && <IconButton icon={X} class="small" label={`Remove ${rowName(row)}`} onClick={() => remove(row)} />}
                </div>
            ))}
            {standsFor && <span class="stands-for">{standsFor}</span>}
            {mayAdd && (
                <IconButton
                    icon={Plus}
                    class="small add"
                    label={`Add to ${label}`}
                    onClick={() => set(written([...rows, newRow(spec, rows, context())]))}
                />
            )}
        </div>
    );
}
