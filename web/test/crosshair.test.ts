import assert from "node:assert/strict";
import { test } from "node:test";
import type { CellState, StyleValue } from "../src/api/types";
import { defaultCamera } from "../src/model/camera";
import { crosshairAxes, crosshairPoint, crosshairValue } from "../src/model/crosshair";
import { steppedPlane } from "../src/model/plane_position";
import { cellPictureView } from "../src/model/plane_view";
import { pictureView, pointUnder, toPixel } from "../src/model/projection";
import type { Vector } from "../src/model/vector";
import type { VolumeBox } from "../src/model/volume_box";

/** 20 x 40 x 30, the second axis pointing backwards. */
const box: VolumeBox = {
    origin: [-5, 50, 0],
    edges: [[20, 0, 0], [0, -40, 0], [0, 0, 30]],
    voxels: [10, 40, 30],
    firstSample: [0, 0, 0],
};

function cellWith(style: Record<string, StyleValue>, more: Partial<CellState> = {}): CellState {
    const values = Object.fromEntries(Object.entries(style).map(([key, value]) => [key, { value, origin: "sheet" as const }]));
    return { cell: "A1", state: "ok", box, style: values, ...more };
}

const near = (actual: readonly number[], expected: readonly number[]): void =>
    actual.forEach((part, i) => assert.ok(Math.abs(part - expected[i]!) < 1e-9, `${actual} against ${expected}`));

test("fractions run along the world's axes, whichever way the volume's own run", () => {
    near(crosshairPoint(box, [0.5, 0.25, 0.1], "fraction")!, [5, 20, 3]);
    near(crosshairPoint(box, [1, 2, 3], "world")!, [1, 2, 3]);
    assert.equal(crosshairPoint(box, "none", "fraction"), null);
    near(crosshairValue(box, [5, 20, 3], "fraction"), [0.5, 0.25, 0.1]);
    near(crosshairValue(box, [500, 20, -3], "world"), [15, 20, 0]);
});

test("a step along a plane's normal takes the crosshair along, in its own units", () => {
    const stepped = (axis: string, value: StyleValue, units: string): StyleValue | undefined => {
        const style = { technique: "plane", "plane.axis": axis, "plane.position": 0.9, "plane.crosshair": value, "plane.units": units };
        const cell = cellWith(style);
        return steppedPlane(cell, (key) => cell.style[key]?.value, 1)?.["plane.crosshair"];
    };
    near(stepped("sagittal", [0.5, 0.25, 0.1], "fraction") as number[], [0.6, 0.25, 0.1]);
    near(stepped("coronal", [5, 20, 3], "world") as number[], [5, 21, 3]);
    assert.equal(stepped("axial", [0.5, 0.5, 1], "fraction"), undefined, "the last plane of samples holds");
});

test("in a volume its lines run through the box along the world's axes", () => {
    const lines = crosshairAxes(box, [1, 42, 7]);
    near(lines[0]![0], [-5, 42, 7]);
    near(lines[1]![1], [1, 50, 7]);
    near(lines[2]![1], [1, 42, 30]);
});

test("a pixel of a plane's picture is a place on the plane, and back", () => {
    const cell = cellWith({ technique: "plane", "plane.axis": "coronal" }, { orientation: true });
    const view = cellPictureView(cell, { ...defaultCamera, distance: 3.9 }, 300, 200)!;
    const point: Vector = [2, 31, 11];
    const pixel = toPixel(view, point)!;
    near(pointUnder(view, pixel, [0, 31, 0]), point);
    // The longest edge in the picture, 30 high, takes 200 pixels less a margin; patients' right is on the left.
    assert.ok(Math.abs(pixel.y - (100 + ((15 - 11) * 200) / (1.04 * 30))) < 1e-9);
    assert.ok(pixel.x > 150);
});

test("cells of one frame show a place of the world at the same pixel", () => {
    const frame = { centre: [100, 0, 0] as Vector, radius: 80, size: [120, 60, 60] as Vector };
    const other: VolumeBox = { ...box, origin: [100, 0, 0] };
    for (const technique of ["raycast", "plane"]) {
        const at = [box, other].map((each) => {
            const view = cellPictureView(cellWith({ technique, "plane.axis": "axial" }, { box: each, frame }), defaultCamera, 200, 200)!;
            return toPixel(view, [90, 5, 3])!;
        });
        near([at[0]!.x, at[0]!.y], [at[1]!.x, at[1]!.y]);
    }
    const own = pictureView(defaultCamera, box, 200, 200);
    near(own.eye, cellPictureView(cellWith({ technique: "mip" }), defaultCamera, 200, 200)!.eye);
});
