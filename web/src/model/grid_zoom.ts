// How large the tiles of the grid are: what fits the window, times the zoom that a person chose.

export interface Size {
    width: number;
    height: number;
}

/** CSS pixels that stand before the first tile: the row and the column header. */
export const gridHeader: Size = { width: 32, height: 28 };
const titlePixels = 26;
/** Below these the grid scrolls, unless one zooms out further. */
const smallestFitting: Size = { width: 150, height: 140 };
const smallest: Size = { width: 72, height: 72 };
const zoomStep = 1.25;

/** At zoom 1 columns fill the width and rows the height, down to a size below which the grid scrolls. */
export function tileSize(grid: { columns: number; rows: number }, area: Size, zoom: number): Size {
    const room = { width: area.width - gridHeader.width, height: area.height - gridHeader.height };
    const fitWidth = Math.max(smallestFitting.width, room.width / Math.max(1, grid.columns));
    const fitHeight = room.height / Math.max(1, grid.rows);
    // The angle of view is that of the height: a picture higher than wide would cut the volume off at its sides.
    const fit = { width: fitWidth, height: Math.max(smallestFitting.height, Math.min(fitHeight, fitWidth + titlePixels)) };
    // One tile fills the window at most; what fits it at zoom 1 is never too large.
    const bounded = (length: number, least: number, most: number): number => Math.floor(Math.min(Math.max(length, least), Math.max(least, most)));
    return {
        width: bounded(zoom * fit.width, smallest.width, Math.max(room.width, fit.width)),
        height: bounded(zoom * fit.height, smallest.height, Math.max(room.height, fit.height)),
    };
}

/** What stands beside and on a picture would cover it. */
export function isCramped(tile: Size): boolean {
    return tile.width < smallestFitting.width || tile.height < smallestFitting.height;
}

/** A step in (1) or out (-1). The zoom stays where a step would change nothing. */
export function steppedZoom(grid: { columns: number; rows: number }, area: Size, zoom: number, step: 1 | -1): number {
    // Powers of the step, so that in and out again is exactly what it was.
    const next = zoomStep ** (Math.round(Math.log(zoom) / Math.log(zoomStep)) + step);
    const before = tileSize(grid, area, zoom);
    const after = tileSize(grid, area, next);
    return before.width === after.width && before.height === after.height ? zoom : next;
}

/** How many tiles the area shows whole. */
export function tilesInView(grid: { columns: number; rows: number }, area: Size, zoom: number): { columns: number; rows: number } {
    const tile = tileSize(grid, area, zoom);
    const whole = (room: number, length: number, most: number): number => Math.max(1, Math.min(most, Math.floor(room / length)));
    return {
        columns: whole(area.width - gridHeader.width, tile.width, grid.columns),
        rows: whole(area.height - gridHeader.height, tile.height, grid.rows),
    };
}
