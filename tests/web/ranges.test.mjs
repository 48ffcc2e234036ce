// Rescaling: by buttons, in numbers, by dragging; and what the colour bars say about it.
import assert from "node:assert/strict";
import { test } from "node:test";
import { drag, look, select, setScope, settled, styleOf, waitForOrigin, waitForStyle, waitUntil } from "./page.mjs";
import { withPage } from "./session.mjs";
import { twoSteps, writeBalls } from "./volumes.mjs";
import { writeFile } from "node:fs/promises";

const cells = ["A1", "B1"];
let page;

withPage(
    async (folder) => {
        const series = `${folder}/series.nrrd`;
        await writeFile(series, twoSteps());
        return [...(await writeBalls(folder, 2, 32)), series, "--columns", "3", "--set", "technique=plane"];
    },
    (made) => ({ page } = made),
    { cells, scope: "sheet" },
);

const valueOf = async (cell, key) => (await styleOf(page, cell, key)).value;
const rescale = (label) => page.locator(`[data-rescale="${label}"]`).click();
const bar = (cell) => page.evaluate((name) => window.voxsheet.store.get().book.bars[name], cell);

async function undoTo(key, wanted) {
    const now = await valueOf("A1", key);
    await page.getByRole("button", { name: "Undo" }).click();
    if (JSON.stringify(now) !== JSON.stringify(wanted)) await waitForStyle(page, "A1", key, now);
    assert.deepEqual(await valueOf("A1", key), wanted);
}

async function type(label, number) {
    const field = page.getByLabel(`range ${label}`, { exact: true });
    await field.fill(String(number));
    await field.press("Enter");
}

test("visible spans what the plane shows, in all cells of the layer, as one undo step", async () => {
    await page.locator("#key-plane-position").fill("0.9");
    await page.locator("#key-plane-position").press("Enter");
    await waitForOrigin(page, "plane.position", "sheet");
    await settled(page, cells);
    const before = await look(page, "A1");
    await rescale("visible");
    assert.equal(await waitForStyle(page, "A1", "range.mode", "auto"), "fixed");
    const high = await valueOf("A1", "range.max");
    // Far from the ball's middle at 0.35, nothing is brighter than exp(-(0.54 / 0.3)^2) of 255.
    assert.ok(high >= 1 && high <= 20, `${high} on a plane far from the ball`);
    await settled(page, cells);
    const after = await look(page, "A1");
    assert.notEqual(after.hash, before.hash);
    assert.ok(after.colours > before.colours, `${after.colours} colours after, ${before.colours} before`);
    assert.equal((await styleOf(page, "B1", "range.max")).value, high);
    await undoTo("range.mode", "auto");
});

test("the range in numbers: ends, window and level", async () => {
    await type("max", 100);
    assert.equal(await waitForStyle(page, "A1", "range.max", "none"), 100);
    assert.equal(await valueOf("A1", "range.mode"), "fixed");
    await waitUntil(page, () => window.voxsheet.store.get().book.bars.A1?.high === 100);
    const low = await valueOf("A1", "range.min");
    await type("window", 50);
    await waitForStyle(page, "A1", "range.max", 100);
    await waitUntil(page, () => window.voxsheet.store.get().book.bars.A1?.high !== 100);
    await type("level", 40);
    await waitUntil(page, () => window.voxsheet.store.get().book.bars.A1?.high === 65);
    assert.deepEqual([await valueOf("A1", "range.min"), await valueOf("A1", "range.max")], [15, 65]);
    assert.ok(typeof low === "number");
});

test("a drag with w changes the same numbers while it goes on", async () => {
    await settled(page, cells);
    const field = page.getByLabel("range window", { exact: true });
    await drag(page, "A1", { dx: 60, dy: 0, keys: ["w"] });
    await waitForStyle(page, "A1", "range.max", 65);
    await waitUntil(page, () => window.voxsheet.store.get().book.bars.A1?.high !== 65);
    assert.ok(Number(await field.inputValue()) > 50, "to the right the window gets wider");
    const middle = ((await valueOf("A1", "range.min")) + (await valueOf("A1", "range.max"))) / 2;
    assert.ok(Math.abs(middle - 40) < 0.01, `the level stays: ${middle}`);
});

test("an end beyond the other is refused with a word, and changes nothing", async () => {
    const before = await valueOf("A1", "range.max");
    await type("max", -1000);
    await page.getByText("its lower end is not below its upper end").waitFor();
    assert.equal(await valueOf("A1", "range.max"), before);
});

test("data, linked cells and symmetric are rules: they hold for every cell", async () => {
    await rescale("data");
    assert.equal(await waitForStyle(page, "A1", "range.mode", "fixed"), "own");
    assert.equal((await styleOf(page, "A1", "range.min")).origin, "default", "typed ends are gone");
    await rescale("linked cells");
    assert.equal(await waitForStyle(page, "A1", "range.mode", "own"), "shared");
    await waitUntil(page, () => ["A1", "B1"].every((cell) => window.voxsheet.store.get().book.bars[cell]?.shared));
    const [a, b] = [await bar("A1"), await bar("B1")];
    assert.deepEqual([a.low, a.high], [b.low, b.high]);
    await rescale("symmetric");
    await waitForStyle(page, "A1", "range.mode", "shared");
    await waitUntil(page, () => window.voxsheet.store.get().book.bars.A1?.low < 0);
    const symmetric = await bar("A1");
    assert.equal(symmetric.low, -symmetric.high);
});

test("colour bars say the scale, and the colours of what lies outside the range", async () => {
    await type("min", 20);
    await waitForStyle(page, "A1", "range.mode", "symmetric");
    await page.locator("#key-range-scale").selectOption("symlog");
    await waitForOrigin(page, "range.scale", "sheet");
    await page.locator('[data-cell="A1"] .bar-unit').getByText("symlog").waitFor();
    assert.equal(await page.locator('[data-cell="A1"] .bar-end').count(), 0);
    const below = page.locator("#key-transfer-belowColor");
    await below.fill("#ff0000");
    await below.press("Enter");
    await waitForOrigin(page, "transfer.belowColor", "sheet");
    const block = page.locator('[data-cell="A1"] .bar-end[title="below the range"]');
    await block.waitFor();
    assert.equal(await block.evaluate((element) => getComputedStyle(element).backgroundColor), "rgb(255, 0, 0)");
});

test("with several time steps, data means the one on show, and over time all of them", async () => {
    await select(page, "C1");
    await setScope(page, "cell");
    const before = await valueOf("C1", "range.max");
    await rescale("data");
    assert.equal(await waitForStyle(page, "C1", "range.max", before), 70);
    assert.equal(await valueOf("C1", "range.mode"), "fixed");
    await rescale("over time");
    await waitForStyle(page, "C1", "range.mode", "fixed");
    await waitUntil(page, () => window.voxsheet.store.get().book.bars.C1?.high === 170);
    assert.deepEqual(page.problems, []);
});
