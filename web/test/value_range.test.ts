import assert from "node:assert/strict";
import { test } from "node:test";
import { rangeOfWindowLevel, roundedOutwards, windowLevelOf } from "../src/model/value_range";

test("ends with few digits leave no value out", () => {
    assert.deepEqual(roundedOutwards({ low: 0, high: 255 }), { low: 0, high: 255 });
    const { low, high } = roundedOutwards({ low: -0.123456789, high: 1.987654321 });
    assert.deepEqual([low, high], [-0.12346, 1.98766]);
    const far = roundedOutwards({ low: 1e6 + 1 / 3, high: 1e6 + 2 / 3 });
    assert.ok(far.low <= 1e6 + 1 / 3 && far.high >= 1e6 + 2 / 3);
    assert.ok(far.low > 1e6 + 0.3333 && far.high < 1e6 + 0.6667);
});

test("a single value gets a range about it", () => {
    assert.deepEqual(roundedOutwards({ low: 4, high: 4 }), { low: 2, high: 6 });
    assert.deepEqual(roundedOutwards({ low: 0, high: 0 }), { low: -0.5, high: 0.5 });
});

test("window and level are width and middle", () => {
    assert.deepEqual(windowLevelOf({ low: -160, high: 240 }), { window: 400, level: 40 });
    assert.deepEqual(rangeOfWindowLevel({ window: 400, level: 40 }), { low: -160, high: 240 });
});
