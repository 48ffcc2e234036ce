import assert from "node:assert/strict";
import { test } from "node:test";
import { defaultCamera, panned, type Camera } from "../src/model/camera";
import { depthOf, followPath, pictureView, pointUnder, toPixel } from "../src/model/projection";
import { add, length, scaled, subtract, type Vector } from "../src/model/vector";
import { boundingRadius, boxCentre, boxCorners, extentAlong, fractionsOf, pointAt, supportPoint, type VolumeBox } from "../src/model/volume_box";

/** Skewed and away from the origin, as crystals are. */
const box: VolumeBox = {
    origin: [10, -4, 3],
    edges: [
        [4, 0, 0],
        [1, 3, 0],
        [0, 0.5, 2],
    ],
};
const cameras: Camera[] = [
    { ...defaultCamera, azimuth: 25, elevation: -35, roll: 15, target: [0.1, 0.2, -0.1] },
    { ...defaultCamera, azimuth: -130, elevation: 60, projection: "orthographic" },
];

function near(actual: number, expected: number, tolerance: number, what = ""): void {
    assert.ok(Math.abs(actual - expected) <= tolerance, `${what} ${actual} against ${expected}`);
}

test("a box knows its corners, its ends and its fractions", () => {
    assert.deepEqual(boxCentre(box), [12.5, -2.25, 4]);
    assert.equal(boxCorners(box).length, 8);
    const inside: Vector = [0.2, 0.7, 0.4];
    fractionsOf(box, pointAt(box, inside)).forEach((value, i) => near(value, inside[i]!, 1e-12));
    assert.deepEqual(extentAlong(box, [0, 0, 1]), { low: 3, high: 5 });
    // The lowest points along x are two corners of an edge along z: half of its sideways step is in their middle.
    assert.deepEqual(supportPoint(box, [1, 0, 0]), [10, -3.75, 4]);
});

test("the target is in the middle of the picture, and one bounding radius is what the angle of view says", () => {
    for (const projection of ["perspective", "orthographic"] as const) {
        const camera: Camera = { ...defaultCamera, azimuth: 0, elevation: 0, projection };
        const view = pictureView(camera, box, 400, 300);
        const centre = boxCentre(box);
        assert.deepEqual(toPixel(view, centre), { x: 200, y: 150 });
        const radius = boundingRadius(box);
        // Azimuth 0 looks along +y: x is to the right, z upwards.
        const scale = 150 / (4 * Math.tan((15 * Math.PI) / 180));
        const right = toPixel(view, add(centre, [radius, 0, 0]))!;
        near(right.x, 200 + scale, 1e-9);
        near(toPixel(view, add(centre, [0, 0, radius]))!.y, 150 - scale, 1e-9);
        near(depthOf(view, centre), 4 * radius, 1e-9);
        // Nearer is larger in perspective only.
        const nearer = toPixel(view, add(centre, [radius, -radius, 0]))!;
        near(nearer.x, 200 + scale * (projection === "perspective" ? 4 / 3 : 1), 1e-9);
    }
});

test("the shorter side sees the angle of view", () => {
    const view = pictureView({ ...defaultCamera, azimuth: 0, elevation: 0 }, box, 200, 400);
    const wide = pictureView({ ...defaultCamera, azimuth: 0, elevation: 0 }, box, 200, 200);
    const point = add(boxCentre(box), [1, 0, 0]);
    near(toPixel(view, point)!.x, toPixel(wide, point)!.x, 1e-9);
});

test("panning moves points in the target's plane by the pointer's way", () => {
    for (const camera of cameras) {
        const radius = boundingRadius(box);
        const point = add(boxCentre(box), scaled(camera.target, radius));
        const before = toPixel(pictureView(camera, box, 500, 400), point)!;
        const after = toPixel(pictureView(panned(camera, 30, -12, 400), box, 500, 400), point)!;
        near(after.x - before.x, 30, 1e-9);
        near(after.y - before.y, -12, 1e-9);
    }
});

test("a pixel and a depth are a point, there and back", () => {
    for (const camera of cameras) {
        const view = pictureView(camera, box, 640, 480);
        for (const corner of boxCorners(box)) {
            const back = pointUnder(view, toPixel(view, corner)!, corner);
            near(length(subtract(back, corner)), 0, 1e-9);
        }
    }
});

test("what is behind the eye has no pixel", () => {
    const view = pictureView(defaultCamera, box, 300, 300);
    assert.equal(toPixel(view, add(view.eye, scaled(view.basis.towardsEye, 1))), null);
});

test("following a path keeps the path's point under the pointer, and the nearest one beside the path", () => {
    for (const camera of cameras) {
        const view = pictureView(camera, box, 640, 480);
        const path = (part: number): Vector => pointAt(box, [part, 0.5, 0.5]);
        const start = toPixel(view, path(0.3))!;
        // Pressed a little beside the handle: that offset stays.
        const pressed = { x: start.x + 3, y: start.y - 2 };
        const follow = followPath(view, path, 0.3, pressed);
        near(follow(pressed), 0.3, 1e-6);
        for (const part of [0, 0.11, 0.5, 0.93, 1]) {
            const at = toPixel(view, path(part))!;
            near(follow({ x: at.x + 3, y: at.y - 2 }), part, 1e-6);
        }
        const ends = [toPixel(view, path(0))!, toPixel(view, path(1))!] as const;
        const along = { x: ends[1].x - ends[0].x, y: ends[1].y - ends[0].y };
        // Sideways moves change nothing.
        near(follow({ x: pressed.x - along.y * 0.05, y: pressed.y + along.x * 0.05 }), 0.3, 0.02);
        assert.equal(Math.round(follow({ x: ends[1].x + 50 * along.x, y: ends[1].y + 50 * along.y }) * 1e6), 1e6);
    }
});

test("a path towards the viewer is followed by moving up and down", () => {
    const view = pictureView({ ...defaultCamera, azimuth: 0, elevation: 0, projection: "orthographic" }, box, 300, 200);
    const path = (part: number): Vector => add(boxCentre(box), [0, part, 0]);
    const follow = followPath(view, path, 0.5, { x: 150, y: 100 });
    near(follow({ x: 190, y: 60 }), 0.7, 1e-12);
    assert.equal(follow({ x: 150, y: -500 }), 1);
});
