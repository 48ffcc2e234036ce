// Values that are rows of numbers, as the API writes them: one number, a flat list, or a list of lists.
import type { StyleKey } from "../api/types";
import type { StyleValue } from "./camera";

function isNumbers(value: unknown): value is number[] {
    return Array.isArray(value) && value.every((number) => typeof number === "number" && Number.isFinite(number));
}

/** null when the value is no rows of this width: "none", "auto", or not there. */
export function rowsOf(value: StyleValue | undefined, columns: number): number[][] | null {
    if (typeof value === "number") return columns === 1 ? [[value]] : null;
    if (!Array.isArray(value) || value.length === 0) return null;
    if (isNumbers(value)) {
        if (value.length % columns !== 0) return null;
        return Array.from({ length: value.length / columns }, (_, row) => value.slice(row * columns, (row + 1) * columns));
    }
    return value.every((row) => isNumbers(row) && row.length === columns) ? (value as number[][]) : null;
}

export function valueOfRows(rows: readonly (readonly number[])[], columns: number, maxRows: number): StyleValue {
    if (columns === 1) return rows.map((row) => row[0]!);
    return maxRows === 1 ? [...(rows[0] ?? [])] : rows.map((row) => [...row]);
}

export interface RowShape {
    columns: number;
    columnNames: string[];
    minRows: number;
    maxRows: number;
    min: number;
    max: number;
}

export function rowShape(key: StyleKey): RowShape {
    const columns = Math.max(1, key.columns ?? 1);
    return {
        columns,
        columnNames: key.columnNames ?? [],
        minRows: key.minRows ?? 1,
        maxRows: key.maxRows ?? 1,
        min: key.min ?? -Infinity,
        max: key.max ?? Infinity,
    };
}

export function withNumber(rows: readonly (readonly number[])[], row: number, column: number, value: number): number[][] {
    return rows.map((numbers, i) => numbers.map((old, j) => (i === row && j === column ? value : old)));
}

/** How many numbers stand side by side: as many as fit and divide the row evenly. */
export function numbersPerLine(columns: number): number {
    if (columns <= 3) return columns;
    return columns % 3 === 0 && columns % 2 !== 0 ? 3 : 2;
}
