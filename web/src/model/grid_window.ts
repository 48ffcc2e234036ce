// Which rows and columns of a large sheet are drawn: those in view and one more on each side.

export interface GridMeasures {
    columns: number;
    rows: number;
    /** CSS pixels of one tile, and of what stands before the first. */
    tile: { width: number; height: number };
    header: { width: number; height: number };
}

export interface GridWindow {
    firstColumn: number;
    lastColumn: number;
    firstRow: number;
    lastRow: number;
}

const beyond = 1;

function range(scrolled: number, area: number, header: number, tile: number, count: number): [number, number] {
    // Headers stick to the edge: tiles under them are not in view.
    const first = Math.floor(scrolled / tile) - beyond;
    const last = Math.ceil((scrolled + area - header) / tile) - 1 + beyond;
    return [Math.max(0, Math.min(first, count - 1)), Math.max(0, Math.min(last, count - 1))];
}

export function gridWindow(
    measures: GridMeasures,
    scroll: { left: number; top: number },
    area: { width: number; height: number },
): GridWindow {
    const { columns, rows, tile, header } = measures;
    const [firstColumn, lastColumn] = range(scroll.left, area.width, header.width, tile.width, columns);
    const [firstRow, lastRow] = range(scroll.top, area.height, header.height, tile.height, rows);
    return { firstColumn, lastColumn, firstRow, lastRow };
}

export function sameWindow(a: GridWindow, b: GridWindow): boolean {
    return a.firstColumn === b.firstColumn && a.lastColumn === b.lastColumn && a.firstRow === b.firstRow && a.lastRow === b.lastRow;
}

/** Numbers from first to last, and the others in ascending order. */
export function linesShown(first: number, last: number, others: readonly number[]): number[] {
    const shown = new Set(others);
    for (let line = first; line <= last; ++line) shown.add(line);
    return [...shown].sort((a, b) => a - b);
}
