import assert from "node:assert/strict";
import { test } from "node:test";
import { setTimeout as wait } from "node:timers/promises";
import { Pace } from "../src/app/pace";

const everyMs = 20;

function paced(): { told: number[]; pace: Pace<number> } {
    const told: number[] = [];
    return { told, pace: new Pace<number>((value) => told.push(value), everyMs) };
}

test("a figure is told at once, then the newest of those that follow, once", async () => {
    const { told, pace } = paced();
    for (let value = 1; value <= 20; ++value) pace.offer(value);
    assert.deepEqual(told, [1]);
    await wait(4 * everyMs);
    assert.deepEqual(told, [1, 20]);
    await wait(4 * everyMs);
    pace.offer(21);
    assert.deepEqual(told, [1, 20, 21], "at once again after a silence");
});

test("what waits is told when it is asked for, and not again", async () => {
    const { told, pace } = paced();
    pace.flush();
    assert.deepEqual(told, []);
    pace.offer(1);
    pace.offer(2);
    pace.flush();
    assert.deepEqual(told, [1, 2]);
    await wait(4 * everyMs);
    assert.deepEqual(told, [1, 2]);
});
