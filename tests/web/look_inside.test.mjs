// Looking into volumes: presets, isovalues on the histogram, both signs, light. Every control by pointer, by key, by number.
import assert from "node:assert/strict";
import { writeFile } from "node:fs/promises";
import { test } from "node:test";
import { dragFrom, look, middleOf, originOf, select, setScope, settled, styleOf, waitForOrigin, waitForStyle } from "./page.mjs";
import { withPage } from "./session.mjs";
import { twoSigns, writeBalls } from "./volumes.mjs";

const cells = ["A1", "B1", "C1"];
const signed = "C1";
let page;

withPage(
    async (folder) => {
        await writeFile(`${folder}/signed.nrrd`, twoSigns(40));
        return [...(await writeBalls(folder, 2, 40)), `${folder}/signed.nrrd`, "--columns", "3"];
    },
    (made) => ({ page } = made),
    { cells },
);

const looks = () => Promise.all(cells.map((cell) => look(page, cell)));
const changed = (one, other) => cells.filter((_, i) => one[i].hash !== other[i].hash);
const preset = (name) => page.locator(`[data-preset="${name}"]`).click();
const isovalueLine = (name = "0") => page.locator(`[data-isovalue="${name}"]`);
const undo = () => page.keyboard.press("Control+z");

test("a preset changes all pictures with one press, is one undo step, and comes back", async () => {
    const volume = await looks();
    const technique = (await styleOf(page, "A1", "technique")).value;
    await preset("half");
    await waitForOrigin(page, "clip.planes", "sheet");
    await settled(page, cells);
    const half = await looks();
    assert.deepEqual(changed(half, volume), cells);
    await preset("isosurface");
    await waitForStyle(page, "A1", "technique", "raycast");
    await settled(page, cells);
    const surface = await looks();
    assert.deepEqual(changed(surface, half), cells);
    assert.equal(await originOf(page, "clip.planes"), "default", "a preset resets what another preset has set");
    await undo();
    await waitForStyle(page, "A1", "technique", "isosurface");
    await settled(page, cells);
    assert.deepEqual(await looks(), half);
    await undo();
    await waitForStyle(page, "A1", "clip.planes", [0, -1, 0, 0.5]);
    await settled(page, cells);
    assert.deepEqual(await looks(), volume);
    assert.equal((await styleOf(page, "A1", "technique")).value, technique);
});

test("a picture that is empty because no surface lies inside the data carries a note", async () => {
    assert.equal(await page.locator("[data-note-of]").count(), 0);
    const style = (value) =>
        page.evaluate((body) => fetch("api/v1/sheets/Sheet1/cells/A1", { method: "PATCH", body: JSON.stringify(body), headers: { "Content-Type": "application/json" } }).then((answer) => answer.status), value);
    assert.equal(await style({ technique: "isosurface", isovalue: 1e6 }), 200);
    const mark = page.locator('[data-note-of="A1"]');
    await mark.waitFor();
    assert.match(await mark.getAttribute("title"), /no surface is drawn: the data's values go from .* and the isovalue is 1e\+06/);
    assert.match(await mark.getAttribute("aria-label"), /^Note on A1: no surface/);
    assert.equal(await page.locator("[data-note-of]").count(), 1);
    assert.equal(await style({ technique: null, isovalue: null }), 200);
    await mark.waitFor({ state: "detached" });
    await settled(page, cells);
});

test("another cell is fused into the pictures, which say so", async () => {
    const alone = await looks();
    await page.locator("#key-layers").fill("B1");
    await page.locator("#key-layers").press("Enter");
    await waitForStyle(page, "A1", "layers", "none");
    await settled(page, cells);
    assert.deepEqual(changed(await looks(), alone), ["A1", "C1"], "B1 itself is not blended twice");
    await page.locator('[data-picture-of="A1"] .layer-bars', { hasText: "B1" }).waitFor();
    await page.locator('[data-key="layers"] .reset').click();
    await waitForOrigin(page, "layers", "default");
    await settled(page, cells);
    assert.deepEqual(await looks(), alone);
});

test("the technique can be switched, and an automatic isovalue stands on the histogram where it is drawn", async () => {
    await page.locator("#key-technique").selectOption("isosurface");
    await waitForOrigin(page, "technique", "sheet");
    await settled(page, cells);
    const { low, high, isovalues } = await page.evaluate(() => window.voxsheet.store.get().book.bars.A1);
    const shown = Number(await isovalueLine().getAttribute("aria-valuenow"));
    assert.equal(shown, isovalues[0].value);
    const strip = await page.locator(".isovalue-editor .points").boundingBox();
    const part = ((await middleOf(isovalueLine())).x - strip.x) / strip.width;
    assert.ok(Math.abs(part - (shown - low) / (high - low)) < 0.02, `at ${part} for ${shown} of ${low} to ${high}`);
    assert.ok(part > 0.05 && part < 0.95, `at ${part}`);
    const bar = await page.locator('[data-cell="A1"] .bar-scale').boundingBox();
    const mark = await middleOf(page.locator('[data-cell="A1"] .isovalue-mark'));
    assert.ok(Math.abs((bar.y + bar.height - mark.y) / bar.height - part) < 0.05, "the colour bar marks it too");
});

test("dragging an isovalue moves the surfaces of all cells live, and is one undo step", async () => {
    const before = await looks();
    const value = (await styleOf(page, "A1", "isovalue")).value;
    const valueBefore = Number(await isovalueLine().getAttribute("aria-valuenow"));
    const { frames } = await dragFrom(page, await middleOf(isovalueLine()), { dx: 60, dy: 0, steps: 30 });
    console.log(`${frames} distinct frames while dragging an isovalue`);
    assert.ok(frames >= 3, `${frames} frames`);
    const dragged = await waitForStyle(page, "A1", "isovalue", value);
    assert.ok([dragged].flat()[0] > valueBefore, `${dragged} after ${valueBefore}`);
    await settled(page, cells);
    const after = await looks();
    assert.deepEqual(changed(after, before), cells);
    // A higher value of a ball that is densest in its middle is a smaller surface.
    assert.ok(after[0].covered < 0.9 * before[0].covered, `${after[0].covered} of ${before[0].covered} pixels`);
    await undo();
    await waitForStyle(page, "A1", "isovalue", dragged);
    assert.deepEqual((await styleOf(page, "A1", "isovalue")).value, value);
    await settled(page, cells);
    assert.deepEqual(await looks(), before);
});

test("Esc in the middle of a drag leaves everything as it was", async () => {
    const before = await looks();
    const { version } = await page.evaluate(() => window.voxsheet.store.get().book.book);
    const at = await middleOf(isovalueLine());
    await page.mouse.move(at.x, at.y);
    await page.mouse.down();
    await page.mouse.move(at.x + 50, at.y, { steps: 5 });
    await page.keyboard.press("Escape");
    await page.mouse.up();
    await settled(page, cells);
    assert.deepEqual(await looks(), before);
    assert.equal(await page.evaluate(() => window.voxsheet.store.get().book.book.version), version);
});

test("keys and numbers do what the drag does; keys in a row are one undo step", async () => {
    const auto = (await styleOf(page, "A1", "isovalue")).value;
    const before = await looks();
    await isovalueLine().focus();
    for (let i = 0; i < 3; ++i) await page.keyboard.press("Shift+ArrowRight");
    const byKey = await waitForStyle(page, "A1", "isovalue", auto);
    await settled(page, cells);
    const after = await looks();
    assert.deepEqual(changed(after, before), cells);
    assert.ok(after[0].covered < before[0].covered);
    await undo();
    await waitForStyle(page, "A1", "isovalue", byKey);
    assert.deepEqual((await styleOf(page, "A1", "isovalue")).value, auto);

    await page.getByRole("button", { name: "Add to Isovalue" }).click();
    const added = await waitForStyle(page, "A1", "isovalue", auto);
    const field = page.getByLabel("Isovalue 1 value");
    await field.fill(String([byKey].flat()[0]));
    await field.press("Enter");
    await waitForStyle(page, "A1", "isovalue", added);
    await settled(page, cells);
    assert.deepEqual(await looks(), after);
    await page.locator('[data-key="isovalue"] .reset').click();
    await waitForOrigin(page, "isovalue", "default");
    await settled(page, cells);
    assert.deepEqual(await looks(), before);
});

test("one control shows +v and -v, its mirrored handle moves both", async () => {
    await select(page, signed);
    await setScope(page, "cell");
    await page.getByRole("button", { name: "Add to Isovalue" }).click();
    await waitForOrigin(page, "isovalue", "cell");
    const field = page.getByLabel("Isovalue 1 value");
    const first = (await styleOf(page, signed, "isovalue")).value;
    await field.fill("0.5");
    await field.press("Enter");
    if ([first].flat()[0] !== 0.5) await waitForStyle(page, signed, "isovalue", first);
    await settled(page, cells);
    const one = await looks();
    await page.locator("#key-isosurface-mirror").selectOption("on");
    await waitForOrigin(page, "isosurface.mirror", "cell");
    await settled(page, cells);
    const both = await looks();
    assert.deepEqual(changed(both, one), [signed]);
    // The two balls are mirror images: twice the surface.
    assert.ok(both[2].covered > 1.5 * one[2].covered, `${both[2].covered} of ${one[2].covered} pixels`);
    const mirrored = isovalueLine("0 mirrored");
    assert.equal(Number(await mirrored.getAttribute("aria-valuenow")), -0.5);
    const half = (await styleOf(page, signed, "isovalue")).value;
    await dragFrom(page, await middleOf(mirrored), { dx: -20, dy: 0, steps: 8 });
    const [moved] = [await waitForStyle(page, signed, "isovalue", half)].flat();
    assert.ok(moved > 0.5, `${moved}`);
    assert.equal(Number(await isovalueLine().getAttribute("aria-valuenow")), moved);
    await settled(page, cells);
    assert.ok((await look(page, signed)).covered < both[2].covered);
});

test("a light is turned on its ball by pointer and by keys, and by numbers", async () => {
    await select(page, "A1");
    await setScope(page, "sheet");
    await settled(page, cells);
    const start = (await styleOf(page, "A1", "light.direction")).value;
    const before = await looks();
    const ball = await middleOf(page.locator(".light-ball svg"));
    await dragFrom(page, { x: ball.x - 30, y: ball.y - 10 }, { dx: 0, dy: 25, steps: 10 });
    const byDrag = await waitForStyle(page, "A1", "light.direction", start);
    await settled(page, cells);
    const lit = await looks();
    assert.deepEqual(changed(lit, before), cells);
    assert.deepEqual(lit.map(({ covered }) => covered), before.map(({ covered }) => covered), "light changes no silhouette");

    await page.locator(".light-ball .light").first().focus();
    await page.keyboard.press("Shift+ArrowRight");
    const byKey = await waitForStyle(page, "A1", "light.direction", byDrag);
    await settled(page, cells);
    assert.deepEqual(changed(await looks(), lit), cells);

    const row = page.locator('[data-key="light.direction"] input');
    const numbers = [byDrag].flat(2);
    for (const [i, number] of numbers.slice(0, 3).entries()) {
        const old = (await styleOf(page, "A1", "light.direction")).value;
        await row.nth(i).fill(String(number));
        await row.nth(i).press("Enter");
        if ([old].flat(2)[i] !== number) await waitForStyle(page, "A1", "light.direction", old);
    }
    assert.notDeepEqual(byKey, byDrag);
    await settled(page, cells);
    assert.deepEqual(await looks(), lit);
    assert.deepEqual(page.problems, []);
});
