// Planes: stepping by wheel and keys, linked over cells; moving and zooming them by keys.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { look, middleOf, openBrowser, openPage, select, setScope, settled, styleOf, waitForOrigin, waitForStyle } from "./page.mjs";
import { makeFolder, removeFolder, startServer, stopServer } from "./server.mjs";
import { writeBalls } from "./volumes.mjs";

const cells = ["A1", "B1"];
const size = 33;
let folder, server, browser, page;

before(async () => {
    folder = await makeFolder();
    server = await startServer(folder, [...(await writeBalls(folder, 2, size)), "--columns", "2", "--set", "technique=plane"]);
    browser = await openBrowser();
    page = await openPage(browser, server.url);
    await settled(page, cells);
});

after(async () => {
    await browser?.close();
    if (server) await stopServer(server);
    await removeFolder(folder);
});

const picture = (cell) => page.locator(`[data-picture-of="${cell}"]`);
const looks = () => Promise.all(cells.map((cell) => look(page, cell)));
const hashes = async () => (await looks()).map(({ hash }) => hash);
const valueOf = async (cell, key) => (await styleOf(page, cell, key)).value;
const camera = () => page.evaluate(() => window.voxsheet.app.view.camera("A1"));

async function undo() {
    await page.getByRole("button", { name: "Undo" }).click();
}

async function wheel(cell, notches, keys = []) {
    const at = await middleOf(picture(cell));
    await page.mouse.move(at.x, at.y);
    for (const key of keys) await page.keyboard.down(key);
    for (let i = 0; i < Math.abs(notches); ++i) await page.mouse.wheel(0, 100 * Math.sign(notches));
    for (const key of keys) await page.keyboard.up(key);
}

test("the wheel steps the planes of all linked cells by voxels, and the notches in a row are one undo step", async () => {
    const start = await hashes();
    await wheel("A1", -3);
    const position = await waitForStyle(page, "A1", "plane.position", 0.5);
    assert.ok(Math.abs(position - (0.5 + 3 / (size - 1))) < 1e-6, `${position} after three notches upwards`);
    assert.equal(await valueOf("B1", "plane.position"), position);
    assert.equal((await styleOf(page, "B1", "plane.position")).origin, "sheet");
    await settled(page, cells);
    const stepped = await hashes();
    stepped.forEach((hash, i) => assert.notEqual(hash, start[i], `${cells[i]} shows another plane`));
    await undo();
    await waitForStyle(page, "A1", "plane.position", position);
    await settled(page, cells);
    assert.deepEqual(await hashes(), start);
});

test("Alt + wheel steps one cell; its reset links it again", async () => {
    const start = await hashes();
    await wheel("B1", 2, ["Alt"]);
    const position = await waitForStyle(page, "B1", "plane.position", 0.5);
    assert.ok(Math.abs(position - (0.5 - 2 / (size - 1))) < 1e-6, `${position}`);
    assert.equal(await valueOf("A1", "plane.position"), 0.5);
    await settled(page, cells);
    assert.equal((await hashes())[0], start[0]);
    await undo();
    await waitForStyle(page, "B1", "plane.position", position);
});

test("brackets and Page Up and Down step, a slider and a number do the same", async () => {
    await select(page, "A1");
    await picture("A1").focus();
    await page.keyboard.press("]");
    const up = await waitForStyle(page, "A1", "plane.position", 0.5);
    assert.ok(Math.abs(up - 17 / 32) < 1e-6, `${up}`);
    await page.keyboard.press("PageDown");
    await waitForStyle(page, "A1", "plane.position", up);
    await page.keyboard.press("[");
    const down = await waitForStyle(page, "A1", "plane.position", 0.5);
    assert.ok(Math.abs(down - 15 / 32) < 1e-6, `${down}`);
    await setScope(page, "sheet");
    const field = page.locator("#key-plane-position");
    await field.fill("0.5");
    await field.press("Enter");
    await waitForStyle(page, "A1", "plane.position", down);
    assert.equal(await valueOf("B1", "plane.position"), 0.5);
});

test("the planes of other axes step along their own normals", async () => {
    await page.locator("#key-plane-axis").selectOption("sagittal");
    await waitForOrigin(page, "plane.axis", "sheet");
    await settled(page, cells);
    const start = await hashes();
    await wheel("A1", -1);
    const position = await waitForStyle(page, "A1", "plane.position", 0.5);
    await settled(page, cells);
    (await hashes()).forEach((hash, i) => assert.notEqual(hash, start[i]));
    await undo();
    await waitForStyle(page, "A1", "plane.position", position);
    await undo();
    await waitForOrigin(page, "plane.axis", "default");
    await settled(page, cells);
});

test("Ctrl + wheel and Shift + wheel zoom, arrows move the picture, and nothing turns", async () => {
    const before = await camera();
    await wheel("A1", -1, ["Control"]);
    const near = await camera();
    assert.ok(near.distance < before.distance, `${near.distance} of ${before.distance}`);
    await wheel("A1", 1, ["Shift"]);
    assert.ok((await camera()).distance > near.distance);
    assert.equal(await valueOf("A1", "plane.position"), 0.5);
    await page.keyboard.press("r");
    await settled(page, cells);
    const start = await hashes();
    await picture("A1").focus();
    await page.keyboard.press("ArrowRight");
    const moved = await camera();
    assert.equal(moved.azimuth, before.azimuth);
    assert.ok(moved.target[0] < 0 && moved.target[1] === 0 && moved.target[2] === 0, `the volume goes to the right: ${moved.target}`);
    await settled(page, cells);
    (await hashes()).forEach((hash, i) => assert.notEqual(hash, start[i]));
    await page.keyboard.press("r");
    await settled(page, cells);
    assert.deepEqual(await hashes(), start);
    assert.deepEqual(page.problems, []);
});
