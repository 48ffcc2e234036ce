import assert from "node:assert/strict";
import { test } from "node:test";
import { Refresher } from "../src/app/refresher";
import { groupKeys, keyLabel, optionsOf, readValue, sliderSpan, valueText } from "../src/model/keys";
import { formatBytes, formatNumber, formatUnit } from "../src/model/format";
import { newAppStore } from "../src/state/app_state";
import { selectColumn } from "../src/model/selection";

test("selecting headers edits there; going back to cells edits the sheet again", () => {
    const store = newAppStore();
    const { selection } = store.get().page;
    store.dispatch({ type: "page/select", selection: selectColumn(selection, 1) });
    assert.equal(store.get().page.scope, "column");
    store.dispatch({ type: "page/select", selection });
    assert.equal(store.get().page.scope, "sheet");
    store.dispatch({ type: "page/scope", scope: "cell" });
    store.dispatch({ type: "page/select", selection });
    assert.equal(store.get().page.scope, "cell");
});

test("subscribers hear of changes only", () => {
    const store = newAppStore();
    let told = 0;
    const end = store.subscribe(() => ++told);
    store.dispatch({ type: "page/moving", moving: false });
    assert.equal(told, 0);
    store.dispatch({ type: "page/moving", moving: true });
    end();
    store.dispatch({ type: "page/moving", moving: false });
    assert.equal(told, 1);
});

test("pictures alone change nothing that stands around them", () => {
    const store = newAppStore();
    const painted = { painted: true, level: 1, final: false };
    store.dispatch({ type: "tiles/update", tiles: { A1: painted, B1: painted } });
    const before = store.get();
    store.dispatch({ type: "tiles/update", tiles: { A1: { ...painted }, B1: { ...painted } } });
    assert.equal(store.get().tiles, before.tiles);
    store.dispatch({ type: "tiles/update", tiles: { A1: { final: true }, B1: painted } });
    assert.equal(store.get().tiles["A1"]!.final, true);
    assert.equal(store.get().tiles["A1"]!.level, 1);
    assert.equal(store.get().tiles["B1"], before.tiles["B1"]);
});

test("opening a stream again counts as restored", () => {
    const store = newAppStore();
    for (const phase of ["live", "lost", "connecting", "live"] as const) store.dispatch({ type: "connection/phase", phase });
    assert.equal(store.get().connection.openings, 2);
});

test("many requests to refresh are one under way and one after it", async () => {
    let runs = 0;
    const refresher = new Refresher(async () => {
        ++runs;
        await new Promise((resolve) => setTimeout(resolve, 5));
    });
    await Promise.all([refresher.request(), refresher.request(), refresher.request()]);
    assert.equal(runs, 2);
    await refresher.request();
    assert.equal(runs, 3);
});

test("a choice that may be left to the program offers the word for it", () => {
    assert.deepEqual(optionsOf({ name: "shading.model", type: "choice", takesAuto: true, choices: ["none", "phong"] }), ["auto", "none", "phong"]);
    assert.deepEqual(optionsOf({ name: "clip.mode", type: "choice", choices: ["probe", "clip"] }), ["probe", "clip"]);
});

test("keys that depend on another appear only when they matter", () => {
    const keys = [
        { name: "range.mode", type: "choice", group: "Range" },
        { name: "range.min", type: "number", group: "Range", appliesWhen: { key: "range.mode", values: ["fixed"] } },
    ];
    const cell = (value: string) => ({ cell: "A1", state: "ok" as const, style: { "range.mode": { value, origin: "sheet" as const } } });
    assert.equal(groupKeys(keys, cell("own"))[0]!.keys.length, 1);
    assert.equal(groupKeys(keys, cell("fixed"))[0]!.keys.length, 2);
});

test("values read back as they were shown", () => {
    for (const value of [1.5, "auto", "#aabbcc", [[0, 0.5], [1, 1]]] as const) {
        assert.deepEqual(readValue(valueText(value as never)), value);
    }
    assert.equal(readValue("  "), null);
    assert.equal(keyLabel("transfer.unitLength", "Transfer function"), "Unit length");
    assert.equal(keyLabel("sampling.distance", "Picture"), "Sampling distance");
    assert.equal(sliderSpan({ name: "x", type: "number", min: -1e300, max: 1e300 }), null);
});

test("numbers read well", () => {
    assert.deepEqual([0, 0.02134567, 312, 1.2e-7, -4.5, 2e9].map((value) => formatNumber(value)), ["0", "0.02135", "312", "1.2e−7", "−4.5", "2e9"]);
    assert.equal(formatNumber(null), "–");
    assert.deepEqual(["e/Å^3", "HU", "m^-1", "x^5", ""].map(formatUnit), ["e/Å³", "HU", "m⁻¹", "x^5", ""]);
    assert.equal(formatBytes(12_345_678), "12\u2009MB");
});
