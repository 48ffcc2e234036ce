import assert from "node:assert/strict";
import { test } from "node:test";
import { cameraBasis, defaultCamera, type Camera } from "../src/model/camera";
import { directionAt, directionInView, directionInWorld } from "../src/model/clip/arrow_ball";
import { clipOf, hasClip, noTransform, type BoxRow, type PlaneRow } from "../src/model/clip/clip";
import { clipBoxInWorld, facePart, facePath, middleBox, withFace } from "../src/model/clip/clip_box";
import { objectFrame, rotationOf, toWorld, withCentre, withScale, withTurn } from "../src/model/clip/clip_object";
import { cutPolygon, facingPlane, planeCentre, planeRow, worldPlane } from "../src/model/clip/clip_plane";
import { rowsOf, valueOfRows } from "../src/model/number_rows";
import { followPath, pictureView, toPixel } from "../src/model/projection";
import { add, applied, dot, length, rotation, scaled, subtract, type Vector } from "../src/model/vector";
import { boxCentre, boxCorners, fractionsOf, pointAt, type VolumeBox } from "../src/model/volume_box";

const cube: VolumeBox = { origin: [0, 0, 0], edges: [[2, 0, 0], [0, 2, 0], [0, 0, 2]] };
const skewed: VolumeBox = { origin: [10, -4, 3], edges: [[4, 0, 0], [1, 3, 0], [0, 0.5, 2]] };
const cameras: Camera[] = [
    { ...defaultCamera, azimuth: 25, elevation: 35, roll: 15 },
    { ...defaultCamera, azimuth: -130, elevation: -20, projection: "orthographic" },
];

function near(actual: readonly number[], expected: readonly number[], tolerance = 1e-9): void {
    assert.equal(actual.length, expected.length);
    actual.forEach((value, i) => assert.ok(Math.abs(value - expected[i]!) <= tolerance, `${actual} against ${expected}`));
}

test("rows of numbers read in every way that the API writes them, and are written as it takes them", () => {
    assert.deepEqual(rowsOf(3, 1), [[3]]);
    assert.deepEqual(rowsOf([1, 2], 1), [[1], [2]]);
    assert.deepEqual(rowsOf([1, 0, 0, 0.5], 4), [[1, 0, 0, 0.5]]);
    assert.deepEqual(rowsOf([[1, 0, 0, 0.5], [0, 1, 0, 0.2]], 4), [[1, 0, 0, 0.5], [0, 1, 0, 0.2]]);
    for (const none of ["none", "auto", null, undefined, [], [1, 2], [[1]], 7]) assert.equal(rowsOf(none as never, 4), null);
    assert.deepEqual(valueOfRows([[1], [2]], 1, 8), [1, 2]);
    assert.deepEqual(valueOfRows([[1, 2, 3, 4]], 4, 8), [[1, 2, 3, 4]]);
    assert.deepEqual(valueOfRows([[1, 2, 3, 4, 5, 6]], 6, 1), [1, 2, 3, 4, 5, 6]);
});

test("what is clipped is read from the style, and nothing from nothing", () => {
    const values: Record<string, unknown> = { "clip.planes": [[1, 0, 0, 0.5]], "clip.box": "none", "clip.shape": "torus" };
    const clip = clipOf((key) => values[key] as never);
    assert.deepEqual(clip, { units: "fraction", planes: [[1, 0, 0, 0.5]], box: null, shape: "torus", transform: noTransform });
    assert.equal(hasClip(clip), true);
    assert.equal(hasClip(clipOf(() => "none")), false);
});

test("a plane's position runs from the box's first corner along the normal to its last", () => {
    const normal: Vector = [1, 1, 1];
    assert.ok(Math.abs(worldPlane([...normal, 0], "fraction", cube)!.offset) < 1e-12);
    near([worldPlane([...normal, 1], "fraction", cube)!.offset], [6 / Math.sqrt(3)]);
    near([worldPlane([0, 0, 2, 1.25], "world", cube)!.offset], [1.25]);
    assert.equal(worldPlane([0, 0, 0, 1], "fraction", cube), null);
});

test("planes survive the way to the world and back", () => {
    for (const units of ["fraction", "world"] as const) {
        for (const row of [[1, 0, 0, 0.25], [0.6, 0, -0.8, 0.5], [0, -1, 0, 0.1]] as PlaneRow[]) {
            near(planeRow(worldPlane(row, units, skewed)!, units, skewed), row, 1e-4);
        }
    }
});

test("the cut through a cube is a square, a triangle or a hexagon", () => {
    const cut = (row: PlaneRow): Vector[] => cutPolygon(worldPlane(row, "fraction", cube)!, cube);
    assert.equal(cut([1, 0, 0, 0.5]).length, 4);
    assert.equal(cut([1, 1, 1, 0.2]).length, 3);
    assert.equal(cut([1, 1, 1, 0.5]).length, 6);
    assert.equal(cut([1, 1, 0, 0.5]).length, 4);
    assert.equal(cut([1, 0, 0, 0]).length, 4); // a face of the box
    assert.equal(cut([1, 0, 0, 1.2]).length, 0);
    assert.equal(cut([1, 1, 1, 0]).length, 0); // only a corner
});

test("a cut polygon lies in the plane and in the box, convex and in order", () => {
    for (let i = 0; i < 60; ++i) {
        const row: PlaneRow = [Math.sin(i), Math.cos(2.3 * i), Math.sin(1.7 * i + 1), (i % 10) / 10 + 0.05];
        const plane = worldPlane(row, "fraction", skewed)!;
        const points = cutPolygon(plane, skewed);
        assert.ok(points.length >= 3 && points.length <= 6, `${points.length} corners`);
        points.forEach((point, at) => {
            assert.ok(Math.abs(dot(point, plane.normal) - plane.offset) < 1e-9);
            assert.ok(fractionsOf(skewed, point).every((part) => part > -1e-9 && part < 1 + 1e-9));
            const next = points[(at + 1) % points.length]!;
            const after = points[(at + 2) % points.length]!;
            const [a, b] = [subtract(next, point), subtract(after, next)];
            const turn = a[0] * (b[1] * plane.normal[2] - b[2] * plane.normal[1]) + a[1] * (b[2] * plane.normal[0] - b[0] * plane.normal[2]) + a[2] * (b[0] * plane.normal[1] - b[1] * plane.normal[0]);
            assert.ok(turn > -1e-9, `corner ${at} turns back`);
        });
        assert.ok(fractionsOf(skewed, planeCentre(plane, skewed)).every((part) => part > 0 && part < 1));
    }
});

test("the handle of a plane that misses the box waits at the box", () => {
    near(planeCentre(worldPlane([1, 0, 0, -3], "fraction", cube)!, cube), [0, 1, 1]);
    near(planeCentre(worldPlane([1, 1, 1, 9], "fraction", cube)!, cube), [2, 2, 2]);
});

test("dragging a plane's handle by pixels gives the position whose handle is under the pointer", () => {
    for (const camera of cameras) {
        const view = pictureView(camera, skewed, 640, 480);
        for (const normal of [[1, 0, 0], [0.3, -0.8, 0.5]] as Vector[]) {
            const centre = (part: number): Vector => planeCentre(worldPlane([...normal, part], "fraction", skewed)!, skewed);
            const pressed = toPixel(view, centre(0.4))!;
            const follow = followPath(view, centre, 0.4, pressed);
            for (const part of [0.15, 0.4, 0.8]) {
                const pointer = toPixel(view, centre(part))!;
                const found = toPixel(view, centre(follow(pointer)))!;
                near([found.x, found.y], [pointer.x, pointer.y], 1e-3);
                near([follow(pointer)], [part], 1e-5);
            }
        }
    }
});

test("a new plane cuts through the middle and keeps what is behind it", () => {
    for (const camera of cameras) {
        const { towardsEye } = cameraBasis(camera);
        const plane = worldPlane(facingPlane(towardsEye, "fraction", skewed), "fraction", skewed)!;
        near([dot(boxCentre(skewed), plane.normal)], [plane.offset], 1e-3);
        assert.ok(dot(plane.normal, towardsEye) < -0.999);
    }
});

test("the tip of an arrow follows the pointer over both halves of its ball", () => {
    const basis = cameraBasis(cameras[0]!);
    const towards = directionInWorld(basis, directionAt(0.6, 0, true));
    near(directionInView(basis, towards), [0.6, 0, 0.8]);
    near(directionAt(0.6, 0, false), [0.6, 0, -0.8]);
    near(directionAt(1, 0, true), [1, 0, 0]);
    // Over the rim: the other half, as far in as the pointer is out.
    near(directionAt(1.4, 0, true), [0.6, 0, -0.8]);
    near(directionAt(0, -5, false), [0, 0, 1]);
});

test("faces of the clip box stay apart and follow the pointer", () => {
    for (const units of ["fraction", "world"] as const) {
        const row = middleBox(units, skewed);
        for (let face = 0; face < 6; ++face) {
            near([facePart(row, face, units, skewed)], [face % 2 ? 0.9 : 0.1], 1e-5);
            near([facePart(withFace(row, face, 0.4, units, skewed), face, units, skewed)], [0.4], 1e-4);
            // Not through the opposite face.
            const squeezed = withFace(row, face, face % 2 ? -1 : 2, units, skewed);
            assert.ok(squeezed[face - (face % 2)]! < squeezed[face - (face % 2) + 1]!);
            const view = pictureView(cameras[0]!, skewed, 640, 480);
            const path = facePath(row, face, units, skewed);
            const start = facePart(row, face, units, skewed);
            const follow = followPath(view, path, start, toPixel(view, path(start))!);
            near([follow(toPixel(view, path(0.45))!)], [0.45], 1e-5);
        }
    }
});

test("the clip box in fractions lies along the volume's axes, in world units along the world's", () => {
    const half: BoxRow = [0.25, 0.75, 0, 1, 0, 0.5];
    near(boxCorners(clipBoxInWorld(half, "fraction", skewed))[7]!, pointAt(skewed, [0.75, 1, 0.5]));
    near(boxCorners(clipBoxInWorld([1, 2, 3, 4, 5, 6], "world", skewed))[7]!, [2, 4, 6]);
});

test("the clip object is scaled, turned about x, y, z, and moved", () => {
    near(toWorld(objectFrame(noTransform, "world", skewed), [1, 2, 3]), [1, 2, 3]);
    // Fractions: half the shortest edge is the unit, the middle of the box the origin.
    near(toWorld(objectFrame(noTransform, "fraction", cube), [1, 0, 0]), [2, 1, 1]);
    // x of length 2, turned to y by 90 degrees about z; then moved.
    near(toWorld(objectFrame([0, 0, 5, 0, 0, 90, 2, 1, 1], "world", cube), [1, 0, 0]), [0, 2, 5]);
    // About x first, then about y: z goes to -y, which y does not move.
    near(applied(rotationOf([0, 0, 0, 90, 90, 0, 1, 1, 1]), [0, 0, 1]), [0, -1, 0]);
});

test("moving, turning and scaling the clip object do what they say", () => {
    for (const units of ["fraction", "world"] as const) {
        const centre: Vector = [11, -3, 4];
        const moved = withCentre(noTransform, centre, units, skewed);
        near(objectFrame(moved, units, skewed).centre, centre, 1e-3);
        assert.deepEqual(moved.slice(3), noTransform.slice(3));
    }
    for (const start of [[20, 30, 40], [-170, 85, 10], [0, 90, 0], [5, -90, 30]]) {
        const row = [0, 0, 0, ...start, 1, 2, 3];
        const turn = rotation([1, -2, 0.5], 0.7);
        const turned = withTurn(row, turn);
        for (const axis of [[1, 0, 0], [0, 1, 0], [0, 0, 1]] as Vector[]) {
            // Angles are rounded to 0.01 degrees.
            near(applied(rotationOf(turned), axis), applied(turn, applied(rotationOf(row), axis)), 4e-4);
        }
        assert.deepEqual(turned.slice(6), [1, 2, 3]);
    }
    assert.deepEqual(withScale(noTransform, 2).slice(6), [2, 2, 2]);
    assert.ok(length(scaled(add([0, 0, 0], withScale(noTransform, 0).slice(6) as unknown as Vector), 1)) > 0);
});
