import assert from "node:assert/strict";
import { test } from "node:test";
import { withoutMirrored } from "../src/model/isovalues";
import {
    addedPoint,
    movedPoint,
    opacityAt,
    opacityPointsOf,
    positionOf,
    removedPoint,
    simplifiedCurve,
    valueAt,
    windowLevel,
    type OpacityPoint,
    type Scale,
} from "../src/model/transfer";

const curve: OpacityPoint[] = [
    [0.1, 0],
    [0.5, 0.8],
    [0.9, 0.2],
];

test("opacity is linear between points and constant beyond them", () => {
    assert.equal(opacityAt(curve, 0), 0);
    assert.ok(Math.abs(opacityAt(curve, 0.3) - 0.4) < 1e-12);
    assert.equal(opacityAt(curve, 1), 0.2);
});

test("only lists of pairs are points", () => {
    assert.equal(opacityPointsOf("auto"), null);
    assert.equal(opacityPointsOf([]), null);
    assert.equal(opacityPointsOf([[0, "a"]]), null);
    assert.deepEqual(opacityPointsOf([[0, 0.5]]), [[0, 0.5]]);
});

test("a point cannot pass its neighbours nor leave the box", () => {
    assert.deepEqual(movedPoint(curve, 1, 0.95, 2)[1], [0.9, 1]);
    assert.deepEqual(movedPoint(curve, 0, -1, -1)[0], [0, 0]);
    assert.deepEqual(movedPoint(curve, 2, 2, 0.3)[2], [1, 0.3]);
});

test("points are added in order and two always remain", () => {
    const { points, index } = addedPoint(curve, 0.3, 0.6);
    assert.equal(index, 1);
    assert.deepEqual(points.map((point) => point[0]), [0.1, 0.3, 0.5, 0.9]);
    assert.equal(removedPoint(removedPoint(curve, 0), 0).length, 2);
});

test("a sampled curve comes back to its corners", () => {
    const samples = Array.from({ length: 101 }, (_, i): OpacityPoint => [i / 100, opacityAt(curve, i / 100)]);
    const simple = simplifiedCurve(samples, 0.005);
    assert.ok(simple.length <= 5, String(simple.length));
    for (const [position, opacity] of samples) assert.ok(Math.abs(opacityAt(simple, position) - opacity) <= 0.0051);
});

test("value and position are inverse for every scale", () => {
    for (const scale of ["linear", "log", "symlog"] as Scale[]) {
        const range = scale === "log" ? { low: 0.001, high: 50 } : { low: -30, high: 50 };
        assert.ok(Math.abs(positionOf(range.low, range, scale)) < 1e-9);
        assert.ok(Math.abs(positionOf(range.high, range, scale) - 1) < 1e-9);
        for (const position of [0.1, 0.5, 0.77]) {
            const back = positionOf(valueAt(position, range, scale), range, scale);
            assert.ok(Math.abs(back - position) < 1e-6, `${scale} ${position} ${back}`);
        }
    }
});

test("window and level: across widens about the centre, upwards raises", () => {
    const wider = windowLevel({ low: 0, high: 100 }, 0.5, 0);
    assert.deepEqual([wider.low, wider.high], [-50, 150]);
    const higher = windowLevel({ low: 0, high: 100 }, 0, -0.2);
    assert.deepEqual([higher.low, higher.high], [20, 120]);
    const narrow = windowLevel({ low: 0, high: 100 }, -50, 0);
    assert.ok(narrow.high > narrow.low);
});

test("of mirrored isovalues as drawn, only those remain that make the others", () => {
    assert.deepEqual(withoutMirrored([0.5, -0.5, 2, -2]), [0.5, 2]);
    assert.deepEqual(withoutMirrored([-1, 1]), [-1]);
    assert.deepEqual(withoutMirrored([0, 3]), [0, 3]);
    assert.deepEqual(withoutMirrored([0]), [0]);
});
