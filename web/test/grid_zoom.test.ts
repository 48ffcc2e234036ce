import assert from "node:assert/strict";
import { test } from "node:test";
import { isCramped, steppedZoom, tilesInView, tileSize } from "../src/model/grid_zoom";

const area = { width: 1232, height: 828 };
const large = { columns: 16, rows: 16 };

test("at zoom 1 a small grid fills the window and a large one scrolls", () => {
    assert.deepEqual(tileSize({ columns: 2, rows: 2 }, area, 1), { width: 600, height: 400 });
    assert.deepEqual(tileSize(large, area, 1), { width: 150, height: 140 });
    assert.ok(!isCramped(tileSize(large, area, 1)) && isCramped(tileSize(large, area, 0.9)));
    assert.deepEqual(tilesInView(large, area, 1), { columns: 8, rows: 5 });
});

test("zooming out shows all cells of a large grid, zooming in few, and both end", () => {
    let zoom = 1;
    for (let i = 0; i < 40; ++i) zoom = steppedZoom(large, area, zoom, -1);
    assert.deepEqual(tileSize(large, area, zoom), { width: 72, height: 72 });
    assert.deepEqual(tilesInView(large, area, zoom), { columns: 16, rows: 11 });
    for (let i = 0; i < 80; ++i) zoom = steppedZoom(large, area, zoom, 1);
    assert.deepEqual(tileSize(large, area, zoom), { width: 1200, height: 800 });
    assert.deepEqual(tilesInView(large, area, zoom), { columns: 1, rows: 1 });
});

test("in and out again is what it was", () => {
    let zoom = 1;
    for (const step of [1, 1, -1, -1, -1, 1] as const) zoom = steppedZoom(large, area, zoom, step);
    assert.equal(zoom, 1);
});
