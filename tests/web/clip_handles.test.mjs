// Clipping by the handles on the pictures: plane, box and clip object, each by pointer, by key and by number.
import assert from "node:assert/strict";
import { test } from "node:test";
import { dragFrom, look, metric, middleOf, select, settled, styleOf, waitForOrigin, waitForStyle } from "./page.mjs";
import { withPage } from "./session.mjs";
import { writeBalls } from "./volumes.mjs";

const cells = ["A1", "B1", "A2", "B2"];
let page;

withPage(async (folder) => [...(await writeBalls(folder, 4, 40, 0.06)), "--columns", "2"], (made) => ({ page } = made), { cells });

const looks = () => Promise.all(cells.map((cell) => look(page, cell)));
const changed = (one, other) => cells.filter((_, i) => one[i].hash !== other[i].hash);
const handle = (cell, name) => page.locator(`[data-cell="${cell}"] [data-handle="${name}"]`);
const styles = async (key) => Promise.all(cells.map(async (cell) => (await styleOf(page, cell, key)).value));

/** Waits for one undo to take a style key back to what it was. */
async function undoTo(key, value) {
    const now = (await styleOf(page, "A1", key)).value;
    await page.keyboard.press("Control+z");
    await waitForStyle(page, "A1", key, now);
    assert.deepEqual((await styleOf(page, "A1", key)).value, value);
}

test("a plane is added facing the viewer, in all cells, and cuts their pictures", async () => {
    const whole = await looks();
    await page.getByRole("button", { name: "Add a clip plane that faces the viewer" }).click();
    await waitForOrigin(page, "clip.planes", "sheet");
    await settled(page, cells);
    const cut = await looks();
    assert.deepEqual(changed(cut, whole), cells);
    for (const cell of cells) assert.ok(await handle(cell, "plane-0").isVisible(), cell);
});

test("dragging a plane's disc moves it in all cells, live, as one undo step", async () => {
    const before = await looks();
    const planes = (await styleOf(page, "A1", "clip.planes")).value;
    const { frames } = await dragFrom(page, await middleOf(handle("A1", "plane-0")), { dx: 12, dy: 20, steps: 25 });
    console.log(`${frames} distinct frames while dragging a plane`);
    assert.ok(frames >= 3, `${frames} frames`);
    const moved = await waitForStyle(page, "A1", "clip.planes", planes);
    assert.deepEqual(moved.slice(0, 3), planes.slice(0, 3), "the disc moves, only the arrow turns");
    assert.deepEqual(await styles("clip.planes"), cells.map(() => moved), "linked over the cells");
    await settled(page, cells);
    assert.deepEqual(changed(await looks(), before), cells);
    await undoTo("clip.planes", planes);
    await settled(page, cells);
    assert.deepEqual(await looks(), before);
});

test("its arrow turns the plane; keys and numbers do what the drags do", async () => {
    const before = await looks();
    const planes = (await styleOf(page, "A1", "clip.planes")).value;
    await dragFrom(page, await middleOf(handle("A1", "plane-0-arrow")), { dx: 15, dy: 25, steps: 8 });
    const turned = await waitForStyle(page, "A1", "clip.planes", planes);
    assert.notDeepEqual(turned.slice(0, 3), planes.slice(0, 3));
    await settled(page, cells);
    assert.deepEqual(changed(await looks(), before), cells);
    await undoTo("clip.planes", planes);

    await handle("A1", "plane-0").focus();
    await page.keyboard.press("Shift+ArrowUp");
    const byKey = await waitForStyle(page, "A1", "clip.planes", planes);
    assert.ok(Math.abs(byKey[3] - planes[3] - 0.1) < 0.001, `${planes[3]} became ${byKey[3]}`);
    await settled(page, cells);
    const after = await looks();
    assert.deepEqual(changed(after, before), cells);
    await undoTo("clip.planes", planes);

    const field = page.locator('[data-key="clip.planes"] input').nth(3);
    await field.fill(String(byKey[3]));
    await field.press("Enter");
    await waitForStyle(page, "A1", "clip.planes", planes);
    await settled(page, cells);
    assert.deepEqual(await looks(), after);
    await page.locator('[data-picture-of="A1"]').focus();
    await undoTo("clip.planes", planes);
    await settled(page, cells);
});

test("Alt + drag moves the plane of one cell; its chip says so, and its reset links it again", async () => {
    const before = await looks();
    await select(page, "B1");
    await dragFrom(page, await middleOf(handle("B1", "plane-0")), { dx: 12, dy: 20, steps: 8, keys: ["Alt"] });
    await waitForOrigin(page, "clip.planes", "cell");
    await settled(page, cells);
    assert.deepEqual(changed(await looks(), before), ["B1"]);
    assert.match(await page.locator('[data-key="clip.planes"] .origin').innerText(), /cell B1/);
    await page.locator('[data-key="clip.planes"] .reset').click();
    await waitForOrigin(page, "clip.planes", "sheet");
    await settled(page, cells);
    assert.deepEqual(await looks(), before);
});

test("Delete removes the plane, Esc in a drag leaves it", async () => {
    const planes = (await styleOf(page, "A1", "clip.planes")).value;
    const at = await middleOf(handle("A1", "plane-0"));
    await page.mouse.move(at.x, at.y);
    await page.mouse.down();
    await page.mouse.move(at.x + 20, at.y + 20, { steps: 4 });
    await page.keyboard.press("Escape");
    await page.mouse.up();
    await settled(page, cells);
    assert.deepEqual((await styleOf(page, "A1", "clip.planes")).value, planes);
    await select(page, "A1");
    await handle("A1", "plane-0").focus();
    await page.keyboard.press("Delete");
    await waitForStyle(page, "A1", "clip.planes", planes);
    await handle("A1", "plane-0").waitFor({ state: "detached" });
});

test("a box is added, and each face is dragged, moved by keys and by numbers", async () => {
    await page.getByRole("button", { name: "Clip by a box" }).click();
    await handle("A1", "box-1").waitFor();
    await settled(page, cells);
    const before = await looks();
    const box = (await styleOf(page, "A1", "clip.box")).value;
    await dragFrom(page, await middleOf(handle("A1", "box-5")), { dx: 0, dy: 30, steps: 12 });
    const lower = await waitForStyle(page, "A1", "clip.box", box);
    assert.ok(lower[5] < box[5], `${lower[5]} after ${box[5]}`);
    assert.deepEqual(lower.slice(0, 5), box.slice(0, 5), "one face moves, the others stay");
    assert.deepEqual(await styles("clip.box"), cells.map(() => lower));
    await settled(page, cells);
    assert.deepEqual(changed(await looks(), before), cells);
    await undoTo("clip.box", box);

    await handle("A1", "box-5").focus();
    for (let i = 0; i < 2; ++i) await page.keyboard.press("Shift+ArrowDown");
    const byKey = await waitForStyle(page, "A1", "clip.box", box);
    assert.ok(Math.abs(box[5] - byKey[5] - 0.2) < 0.001, `${box[5]} became ${byKey[5]}`);
    await settled(page, cells);
    const after = await looks();
    await undoTo("clip.box", box);
    const field = page.locator('[data-key="clip.box"] input').nth(5);
    await field.fill(String(byKey[5]));
    await field.press("Enter");
    await waitForStyle(page, "A1", "clip.box", box);
    await settled(page, cells);
    assert.deepEqual(await looks(), after);
    await page.getByRole("button", { name: "Remove all clipping" }).click();
    await handle("A1", "box-5").waitFor({ state: "detached" });
});

test("a clip object is moved, turned and scaled by its coordinates alone: dragging it uploads nothing", async () => {
    await settled(page, cells);
    const whole = await looks();
    await page.getByRole("button", { name: "Clip by an object" }).click();
    await page.getByRole("menuitem", { name: "sphere" }).click();
    await handle("A1", "object-centre").waitFor();
    await settled(page, cells);
    let before = await looks();
    assert.deepEqual(changed(before, whole), cells);
    const uploaded = await metric(page, "voxsheet_texture_uploaded_bytes_total");
    assert.ok(uploaded > 0);
    const drags = {
        "object-centre": { dx: 30, dy: 15 },
        "object-axis": { dx: 15, dy: 15 },
        "object-scale": { dx: -15, dy: -15 },
    };
    for (const [name, way] of Object.entries(drags)) {
        const transform = (await styleOf(page, "A1", "clip.transform")).value;
        const { frames } = await dragFrom(page, await middleOf(handle("A1", name)), { ...way, steps: 15 });
        assert.ok(frames >= 2, `${frames} frames for ${name}`);
        await waitForStyle(page, "A1", "clip.transform", transform);
        await settled(page, cells);
        const now = await looks();
        assert.deepEqual(changed(now, before), cells, name);
        before = now;
    }
    const ring = page.locator('[data-cell="A1"] [data-handle="object-turn"] .ring-mark');
    const middle = await middleOf(ring);
    const radius = (await ring.boundingBox()).width / 2;
    const transform = (await styleOf(page, "A1", "clip.transform")).value;
    await dragFrom(page, { x: middle.x - radius, y: middle.y }, { dx: 20, dy: -40, steps: 10 });
    const turned = await waitForStyle(page, "A1", "clip.transform", transform);
    assert.deepEqual([turned.slice(0, 3), turned.slice(6)], [transform.slice(0, 3), transform.slice(6)], "the ring turns, and no more");
    await settled(page, cells);
    assert.deepEqual(changed(await looks(), before), cells);
    assert.equal(await metric(page, "voxsheet_texture_uploaded_bytes_total"), uploaded);
});

test("keys and numbers move the clip object too, and its mode keeps the inside instead", async () => {
    const transform = (await styleOf(page, "A1", "clip.transform")).value;
    const before = await looks();
    await handle("A1", "object-centre").focus();
    await page.keyboard.press("Shift+ArrowRight");
    const byKey = await waitForStyle(page, "A1", "clip.transform", transform);
    await settled(page, cells);
    const after = await looks();
    assert.deepEqual(changed(after, before), cells);
    await undoTo("clip.transform", transform);
    await settled(page, cells);
    assert.deepEqual(await looks(), before);
    for (let i = 0; i < 3; ++i) {
        const old = (await styleOf(page, "A1", "clip.transform")).value;
        if (old[i] === byKey[i]) continue;
        const field = page.locator('[data-key="clip.transform"] input').nth(i);
        await field.fill(String(byKey[i]));
        await field.press("Enter");
        await waitForStyle(page, "A1", "clip.transform", old);
    }
    await settled(page, cells);
    assert.deepEqual(await looks(), after);
    await page.locator("#key-clip-mode").selectOption("probe");
    await waitForStyle(page, "A1", "clip.mode", "clip");
    await settled(page, cells);
    const inside = await looks();
    assert.deepEqual(changed(inside, after), cells);
    assert.ok(inside[0].covered < after[0].covered, `${inside[0].covered} and ${after[0].covered} pixels`);
});

test("c hides the handles and shows them again, and nothing went wrong on the way", async () => {
    await page.locator('[data-picture-of="A1"]').focus();
    await page.keyboard.press("c");
    await handle("A1", "object-centre").waitFor({ state: "detached" });
    await page.keyboard.press("c");
    await handle("A1", "object-centre").waitFor();
    assert.deepEqual(page.problems, []);
});
