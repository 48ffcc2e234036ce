import assert from "node:assert/strict";
import { test } from "node:test";
import { probeText } from "../src/model/format";

test("a probe's words name every layer, and say why one has no value", () => {
    assert.equal(probeText({ value: 12.5, unit: "HU" }), "12.5\u2009HU");
    assert.equal(probeText({ value: null, note: "outside" }), "outside");
    const layers = [
        { name: "B1", value: 0.25 },
        { name: "run 2", value: null, note: "outside" },
    ];
    assert.equal(probeText({ value: 10, layers }), "10 · B1: 0.25 · run 2: outside");
});
