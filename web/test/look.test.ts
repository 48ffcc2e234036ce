import assert from "node:assert/strict";
import { test } from "node:test";
import type { CellState, SheetState } from "../src/api/types";
import {
    cameraOf,
    hasOwnCamera,
    lookFromText,
    lookToText,
    noLook,
    viewOverrides,
    withCamera,
    withKey,
    withoutCamera,
} from "../src/model/look";

const linked: CellState = { cell: "A1", state: "ok", style: { "camera.azimuth": { value: 10, origin: "sheet" } } };
const own: CellState = { cell: "B1", state: "ok", style: { "camera.azimuth": { value: 70, origin: "cell" } } };
const sheet: SheetState = { name: "S", rows: 1, columns: 2, cells: [linked, own] };

test("turning a linked cell turns all linked ones, and leaves cells with a camera of their own", () => {
    const turned = withCamera(noLook, linked, { ...cameraOf(noLook, linked), azimuth: 33 }, false);
    assert.equal(cameraOf(turned, linked).azimuth, 33);
    assert.equal(cameraOf(turned, own).azimuth, 70);
    const sent = viewOverrides(turned, sheet, {});
    assert.equal(sent.style["camera.azimuth"], 33);
    assert.equal(sent.cells["B1"]!["camera.azimuth"], 70);
    assert.equal(sent.cells["A1"], undefined);
});

test("Alt turns one cell alone, and resetting it links it again", () => {
    const alone = withCamera(noLook, linked, { ...cameraOf(noLook, linked), azimuth: 5 }, true);
    assert.deepEqual(Object.keys(alone.cells), ["A1"]);
    assert.ok(hasOwnCamera(alone, linked));
    assert.ok(!hasOwnCamera(withoutCamera(alone, "A1"), linked));
});

test("resetting keeps what is not camera", () => {
    const look = withKey(withCamera(noLook, linked, cameraOf(noLook, linked), false), "time", 4);
    assert.deepEqual(withoutCamera(look, null), { style: { time: 4 }, cells: {} });
});

test("edits being dragged stand above the camera of their cell only", () => {
    const sent = viewOverrides(noLook, sheet, { A1: { "range.min": 2 } });
    assert.deepEqual(sent.cells, { A1: { "range.min": 2 } });
});

test("a look survives the way through a link, and nonsense is refused", () => {
    const look = withCamera(noLook, linked, cameraOf(noLook, linked), true);
    assert.deepEqual(lookFromText(lookToText(look)), look);
    for (const wrong of ["", "%7B%7D", "[1,2]", "%5B%5D", "%E0%A4%A"]) assert.equal(lookFromText(wrong), null);
});
