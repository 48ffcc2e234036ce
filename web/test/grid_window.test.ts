import assert from "node:assert/strict";
import { test } from "node:test";
import { gridWindow, linesShown, sameWindow } from "../src/model/grid_window";

const measures = { columns: 16, rows: 16, tile: { width: 150, height: 140 }, header: { width: 32, height: 28 } };

test("only the rows and columns in view, and one more on each side, are drawn", () => {
    const window = gridWindow(measures, { left: 0, top: 0 }, { width: 632, height: 448 });
    assert.deepEqual(window, { firstColumn: 0, lastColumn: 4, firstRow: 0, lastRow: 3 });
    const scrolled = gridWindow(measures, { left: 300, top: 281 }, { width: 632, height: 448 });
    assert.deepEqual(scrolled, { firstColumn: 1, lastColumn: 6, firstRow: 1, lastRow: 6 });
});

test("a window beyond the sheet's end, and a sheet smaller than the window, stay within the sheet", () => {
    const end = gridWindow(measures, { left: 99999, top: 99999 }, { width: 632, height: 448 });
    assert.deepEqual(end, { firstColumn: 15, lastColumn: 15, firstRow: 15, lastRow: 15 });
    const small = gridWindow({ ...measures, columns: 2, rows: 1 }, { left: 0, top: 0 }, { width: 2000, height: 2000 });
    assert.deepEqual(small, { firstColumn: 0, lastColumn: 1, firstRow: 0, lastRow: 0 });
    assert.equal(sameWindow(end, small), false);
    assert.equal(sameWindow(end, { ...end }), true);
});

test("what must stay in place is drawn outside the window too", () => {
    assert.deepEqual(linesShown(3, 5, [9, 0, 4]), [0, 3, 4, 5, 9]);
});
