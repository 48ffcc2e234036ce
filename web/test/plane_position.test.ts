import assert from "node:assert/strict";
import { test } from "node:test";
import type { CellState, StyleValue } from "../src/api/types";
import { steppedPlane } from "../src/model/plane_position";
import type { VolumeBox } from "../src/model/volume_box";

const style = (values: Record<string, StyleValue>) => (key: string): StyleValue | undefined =>
    ({ technique: "plane", "plane.axis": "axial", "plane.position": 0.5, ...values })[key];

function stepped(box: VolumeBox, values: Record<string, StyleValue>, by: number): number | undefined {
    const cell = { cell: "A1", state: "ok", box, style: { technique: { value: "plane", origin: "sheet" } } };
    return steppedPlane(cell as unknown as CellState, style(values), by)?.["plane.position"] as number | undefined;
}

/** 11 x 21 x 9 samples, 2, 1 and 3 apart, from first to last. */
const points: VolumeBox = {
    origin: [-10, 5, 7],
    edges: [[20, 0, 0], [0, 20, 0], [0, 0, 24]],
    voxels: [10, 20, 8],
    firstSample: [0, 0, 0],
};
/** Four cells along z, each 3 thick, the third axis pointing down. */
const cells: VolumeBox = {
    origin: [0, 0, 12],
    edges: [[5, 0, 0], [0, 5, 0], [0, 0, -12]],
    voxels: [5, 5, 4],
    firstSample: [0.5, 0.5, 0.5],
};

const near = (actual: number | undefined, expected: number): void =>
    assert.ok(actual !== undefined && Math.abs(actual - expected) < 1e-9, `${actual} against ${expected}`);

test("a step is one voxel along the normal, in fractions of the box", () => {
    near(stepped(points, {}, 1), 5 / 8);
    near(stepped(points, {}, -2), 2 / 8);
    near(stepped(points, { "plane.axis": "sagittal" }, 1), 6 / 10);
    near(stepped(points, { "plane.axis": "coronal" }, 1), 11 / 20);
});

test("from between two planes of samples the first step goes to the next one", () => {
    near(stepped(points, { "plane.position": 0.51 }, 1), 5 / 8);
    near(stepped(points, { "plane.position": 0.51 }, -1), 4 / 8);
    // The middle of four cells lies between the second and the third.
    near(stepped(cells, {}, 1), 2.5 / 4);
    near(stepped(cells, {}, -1), 1.5 / 4);
});

test("the last planes of samples hold", () => {
    near(stepped(points, {}, 100), 1);
    near(stepped(cells, {}, 100), 3.5 / 4);
    assert.equal(stepped(points, { "plane.position": 1 }, 1), undefined);
    assert.equal(stepped(cells, { "plane.position": 0.5 / 4 }, -1), undefined);
});

test("an oblique plane moves by at most one voxel along every axis", () => {
    const cube: VolumeBox = { origin: [0, 0, 0], edges: [[8, 0, 0], [0, 8, 0], [0, 0, 8]], voxels: [8, 8, 8], firstSample: [0, 0, 0] };
    const custom = { "plane.axis": "custom", "plane.normal": [0, 3, 4], "plane.position": 0.5 };
    // The normal is (0, 0.6, 0.8): 1 / 0.8 along it is one voxel along z; the box reaches 8 * 1.4 along it.
    near(stepped(cube, custom, 1), 0.5 + 1.25 / 11.2);
});

test("layers of a sheared grid are one step apart along their common normal", () => {
    const sheared: VolumeBox = { origin: [1, 1, 1], edges: [[4, 0, 0], [2, 4, 0], [1, 1, 4]], voxels: [4, 4, 4], firstSample: [0, 0, 0] };
    near(stepped(sheared, { "plane.position": 0.25 }, 1), 0.5);
});

test("cells that show no plane, or nothing, do not step", () => {
    assert.equal(steppedPlane(undefined, style({}), 1), null);
    const other = { cell: "A1", state: "ok", box: points, style: { technique: { value: "mip", origin: "sheet" } } };
    assert.equal(steppedPlane(other as unknown as CellState, style({}), 1), null);
});

test("planes of a lattice step by about a voxel, from lattice plane to lattice plane", () => {
    // A primitive cell of face-centred cubic, 24 samples along each vector, 2 x 1 x 1 periods drawn.
    const lattice: VolumeBox["edges"] = [[0, 2, 2], [2, 0, 2], [2, 2, 0]];
    const fcc: VolumeBox = {
        origin: [1, 2, 3],
        edges: [[0, 4, 4], [2, 0, 2], [2, 2, 0]],
        voxels: [48, 24, 24],
        firstSample: [0, 0, 0],
        lattice,
    };
    // (111) of the primitive vectors has the normal (1, 1, 1) and the distance 4 / sqrt(3).
    const shown = { "plane.axis": "hkl", "plane.hkl": [1, 1, 1], "periodic.replicate": [2, 1, 1] };
    // A step of 1 / 8 of it moves by one voxel along each of the three axes.
    const reach = 4; // planes of the set that the box crosses: hkl . (2, 1, 1)
    near(stepped(fcc, { ...shown, "plane.position": 1 / reach }, 8), 2 / reach);
    near(stepped(fcc, { ...shown, "plane.position": 1 / reach }, 1), (1 + 1 / 8) / reach);
    // A shift moves the lattice points: the first step leads to a place counted from them.
    const shifted = { ...shown, "periodic.shift": [0.01, 0, 0], "plane.position": 1 / reach };
    near(stepped(fcc, shifted, 1), (1 + 0.01) / reach);
    assert.equal(stepped({ ...fcc, lattice: undefined }, shown, 1), undefined);
});
