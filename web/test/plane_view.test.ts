import assert from "node:assert/strict";
import { test } from "node:test";
import type { CellState } from "../src/api/types";
import { cameraBasis, defaultCamera, panned, zoomed } from "../src/model/camera";
import { flatView, pictureBasis } from "../src/model/plane_view";
import { cross, dot, type Vector } from "../src/model/vector";
import { edgeLetters } from "../src/ui/OrientationMarks";

function cellWith(style: Record<string, unknown>, orientation = true): CellState {
    const values = Object.fromEntries(Object.entries(style).map(([key, value]) => [key, { value, origin: "sheet" }]));
    return { cell: "A1", state: "ok", orientation, style: values } as unknown as CellState;
}

const lettersOf = (axis: string): string => {
    const basis = pictureBasis(cellWith({ technique: "plane", "plane.axis": axis }), defaultCamera);
    return [
        [-1, 0],
        [1, 0],
        [0, 1],
        [0, -1],
    ]
        .map(([right, up]) => edgeLetters(basis, right!, up!))
        .join(" ");
};

test("planes of patients carry the letters of the radiological convention: left, right, top, bottom", () => {
    assert.equal(lettersOf("axial"), "R L A P");
    assert.equal(lettersOf("coronal"), "R L S I");
    assert.equal(lettersOf("sagittal"), "A P S I");
});

test("other data have x or y to the right", () => {
    const right = (axis: string): Vector =>
        pictureBasis(cellWith({ technique: "plane", "plane.axis": axis }, false), defaultCamera).right;
    assert.deepEqual(right("axial"), [1, 0, 0]);
    assert.deepEqual(right("coronal"), [1, 0, 0]);
    assert.deepEqual(right("sagittal"), [0, 1, 0]);
});

test("custom planes face the eye upright, and other techniques follow the camera", () => {
    for (const normal of [
        [1, 2, 3],
        [0, 0, -2],
    ]) {
        const basis = pictureBasis(
            cellWith({ technique: "plane", "plane.axis": "custom", "plane.normal": normal }),
            defaultCamera,
        );
        assert.ok(dot(basis.towardsEye, normal as unknown as Vector) > 0);
        assert.ok(basis.up[2] > 0 || basis.up[1] === 1);
        const across = cross(basis.right, basis.up);
        across.forEach((part, i) => assert.ok(Math.abs(part - basis.towardsEye[i]!) < 1e-12));
    }
    assert.deepEqual(pictureBasis(cellWith({ technique: "mip" }), defaultCamera), cameraBasis(defaultCamera));
});

test("dragging a plane moves it with the pointer, and zooming keeps what lies under it", () => {
    const box = { origin: [0, 0, 0], edges: [[2, 0, 0], [0, 4, 0], [0, 0, 3]] };
    const cell = { ...cellWith({ technique: "plane", "plane.axis": "axial" }), box } as unknown as CellState;
    const flat = flatView(cell, 1)!;
    const radius = Math.hypot(2, 4, 3) / 2;
    const camera = { ...defaultCamera, distance: 3.9, azimuth: 77 };
    // 100 pixels show 1.04 * 4: a drag by 100 pixels to the right takes the patient's left (-x) away from the middle.
    const after = panned(camera, 100, 0, 100, flat);
    assert.ok(Math.abs(after.target[0] * radius - 1.04 * 4) < 1e-9);
    assert.ok(Math.abs(after.target[1]) < 1e-12);
    const zoom = zoomed(camera, 2, 0, -50, 100, flat);
    assert.ok(Math.abs(zoom.target[1] * radius - 1.04) < 1e-9, "the upper edge stays where it is");
    assert.equal(flatView({ ...cell, style: {} }, 1), undefined);
});

test("planes of a lattice face the eye along their vector of the reciprocal lattice", () => {
    // A hexagonal cell: (110) is at right angles to a + b, (100) is not to a.
    const lattice = [[2, 0, 0], [-1, Math.sqrt(3), 0], [0, 0, 5]];
    const box = { origin: [0, 0, 0], edges: lattice, lattice };
    const towardsEye = (hkl: number[]): Vector =>
        pictureBasis({ ...cellWith({ technique: "plane", "plane.axis": "hkl", "plane.hkl": hkl }), box } as unknown as CellState, defaultCamera).towardsEye;
    const near = (actual: Vector, expected: Vector): void => actual.forEach((part, i) => assert.ok(Math.abs(part - expected[i]!) < 1e-12));
    near(towardsEye([1, 1, 0]), [0.5, Math.sqrt(3) / 2, 0]);
    near(towardsEye([1, 0, 0]), [Math.sqrt(3) / 2, 0.5, 0]);
    near(towardsEye([0, 0, -3]), [0, 0, -1]);
});
