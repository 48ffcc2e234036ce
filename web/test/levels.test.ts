import assert from "node:assert/strict";
import { test } from "node:test";
import type { TimingPoint } from "../src/api/levels";
import { axisSteps, inOrder, lines, pointText } from "../src/model/levels";

function point(n: number, level: number, more: Partial<TimingPoint> = {}): TimingPoint {
    return { n, level, ms: 10 * n, ms_low: 9 * n, ms_high: 11 * n, frames: 5, partly: false, r_raw: null, r: null, r_low: null, r_high: null, resident_bytes: 4e6, ...more };
}

test("axis steps are round and few", () => {
    assert.deepEqual(axisSteps(97, 4), [0, 50]);
    assert.deepEqual(axisSteps(100, 4), [0, 50, 100]);
    assert.deepEqual(axisSteps(0.7, 4), [0, 0.2, 0.4, 0.6]);
    assert.deepEqual(axisSteps(0, 4), [0]);
});

test("points run by N, lines by level", () => {
    const points = [point(2, 1), point(1, 0), point(2, 0), point(3, 1)];
    assert.deepEqual(inOrder(points).map(({ n, level }) => [n, level]), [[1, 0], [2, 0], [2, 1], [3, 1]]);
    assert.deepEqual(lines(points).map((line) => line.map(({ n }) => n)), [[1, 2], [2, 3]]);
});

test("a point in words says what is not known yet, and an unbounded interval", () => {
    assert.match(pointText(point(3, 0, { frames: 1 })), /N = 3, T_N 30\.0 ms \(27\.0 to 33\.0\) from 1 frame, R not known yet, level 0, textures 4 MB/);
    assert.match(pointText(point(3, 0, { partly: true })), /\(27\.0 to 33\.0\) from redraws of some cells, R/);
    assert.match(pointText(point(3, 0, { r: 1.02, r_low: 0.9, r_high: null, r_raw: 1.4 })), /R 1\.02 \(0\.90 to ∞\), raw R 1\.40/);
});
