import assert from "node:assert/strict";
import { test } from "node:test";
import {
    cameraBasis,
    cameraFromStyle,
    defaultCamera,
    orbited,
    panned,
    projectDirection,
    radiiPerPixel,
    rolled,
    styleFromCamera,
    zoomed,
    type Camera,
} from "../src/model/camera";
import { add, dot, scaled, type Vector } from "../src/model/vector";

const front: Camera = { ...defaultCamera, azimuth: 0, elevation: 0, roll: 0 };

function near(actual: readonly number[], expected: readonly number[], tolerance = 1e-9): void {
    actual.forEach((value, i) => assert.ok(Math.abs(value - expected[i]!) < tolerance, `${actual} against ${expected}`));
}

test("azimuth 0 looks along +y with x to the right and z up", () => {
    const { right, up, towardsEye } = cameraBasis(front);
    near(right, [1, 0, 0]);
    near(up, [0, 0, 1]);
    near(towardsEye, [0, -1, 0]);
});

test("azimuth 90 stands on +x, elevation 90 looks straight down", () => {
    near(cameraBasis({ ...front, azimuth: 90 }).towardsEye, [1, 0, 0]);
    near(cameraBasis({ ...front, elevation: 90 }).towardsEye, [0, 0, 1]);
});

test("roll turns the eye clockwise, so the picture turns counter-clockwise", () => {
    const [x, y] = projectDirection({ ...front, roll: 90 }, [1, 0, 0]);
    near([x, y], [0, 1]);
});

test("the basis stays orthonormal for any angles", () => {
    for (let i = 0; i < 50; ++i) {
        const { right, up, towardsEye } = cameraBasis({ ...front, azimuth: 37 * i, elevation: (13 * i) % 90, roll: 29 * i });
        near([dot(right, up), dot(up, towardsEye), dot(right, right), dot(up, up)], [0, 0, 1, 1]);
    }
});

test("dragging turns the object along with the pointer, whatever the roll", () => {
    for (const roll of [0, 60, 180, -110]) {
        for (const [dx, dy] of [[8, 0], [0, 8], [-5, 3]] as const) {
            const before: Camera = { ...front, azimuth: 40, elevation: 10, roll };
            const after = orbited(before, dx, dy, 200);
            // A point of the object that faces the eye moves the way the pointer moved.
            const facing = cameraBasis(before).towardsEye;
            const [x, y] = projectDirection(after, facing);
            assert.ok(x * dx - y * dy > 0, `roll ${roll}: pointer ${dx},${dy} moved it ${x},${-y}`);
            assert.ok(Math.abs(x * dy + y * dx) < 0.3 * Math.hypot(dx, dy) * Math.hypot(x, y), "sideways");
        }
    }
});

test("elevation stops at the poles", () => {
    assert.equal(orbited(front, 0, 1e6, 100).elevation, 90);
    assert.equal(orbited(front, 0, -1e6, 100).elevation, -90);
});

test("panning moves the target by exactly the pointer's way", () => {
    const camera = panned({ ...front, distance: 4 }, 10, -20, 400);
    const perPixel = radiiPerPixel(front, 400);
    near(camera.target, [-10 * perPixel, 0, -20 * perPixel]);
});

test("zooming keeps what is under the pointer there", () => {
    const before: Camera = { ...defaultCamera, roll: 20, target: [0.1, -0.2, 0.3] };
    const under = (camera: Camera): Vector => {
        const { right, up } = cameraBasis(camera);
        const perPixel = radiiPerPixel(camera, 300);
        return add(camera.target, add(scaled(right, 80 * perPixel), scaled(up, 50 * perPixel)));
    };
    const after = zoomed(before, 1.7, 80, -50, 300);
    assert.ok(after.distance < before.distance);
    near(under(after), under(before));
});

test("rolling by a quarter turn of the pointer turns the picture as far", () => {
    // Clockwise on the screen, from the right edge to the lower one.
    const camera = rolled(front, 10, 0, 0, 10);
    const [x, y] = projectDirection(camera, [1, 0, 0]);
    near([x, y], [0, -1]);
});

test("a camera survives the way through style keys", () => {
    const camera: Camera = { ...front, azimuth: 12.5, elevation: -3, roll: 7, distance: 2.25, target: [0.5, 0, -1] };
    assert.deepEqual(cameraFromStyle(styleFromCamera(camera), front), camera);
    assert.deepEqual(cameraFromStyle({ "camera.azimuth": "much", "camera.target": [1, 2] }, front), front);
});
