// Planes: stepping by wheel and keys, linked over cells; moving and zooming them by keys; three of them beside a volume, with
// one crosshair.
import assert from "node:assert/strict";
import { test } from "node:test";
import { look, middleOf, select, setScope, settled, styleOf, waitForOrigin, waitForStyle, waitUntil } from "./page.mjs";
import { withPage } from "./session.mjs";
import { ball, writeBalls } from "./volumes.mjs";
import { writeFile } from "node:fs/promises";

const cells = ["A1", "B1"];
const size = 33;
let page;

withPage(
    async (folder) => {
        const small = `${folder}/small.nrrd`;
        await writeFile(small, ball(17, [0.5, 0.5, 0.5]));
        return [...(await writeBalls(folder, 2, size)), small, "--columns", "3", "--set", "technique=plane"];
    },
    (made) => ({ page } = made),
    { cells },
);

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
});

const views = ["A1", "A2", "A3", "A4"];
const near = (actual, expected, tolerance) =>
    actual.forEach((part, i) => assert.ok(Math.abs(part - expected[i]) < tolerance, `${actual} against ${expected}`));

async function clickAt(cell, x, y, modifiers = []) {
    const box = await picture(cell).boundingBox();
    await picture(cell).click({ position: { x: x * box.width, y: y * box.height }, modifiers });
}

test("one key shows the selected volumes as three planes, too; one undo takes them back", async () => {
    await select(page, "A1");
    await page.locator('[data-title-of="B1"]').click({ modifiers: ["Shift"] });
    await page.keyboard.press("p");
    await page.locator('[data-cell="B4"][data-state="ok"]').waitFor();
    await settled(page, [...views, "B1", "B2", "B3", "B4"]);
    const techniques = await Promise.all(views.map((cell) => valueOf(cell, "technique")));
    assert.deepEqual(techniques, ["raycast", "plane", "plane", "plane"], "what showed a plane is a volume again");
    const axes = await Promise.all(views.slice(1).map((cell) => valueOf(cell, "plane.axis")));
    assert.deepEqual(axes, ["axial", "coronal", "sagittal"]);
    assert.deepEqual(await valueOf("B3", "plane.crosshair"), [0.5, 0.5, 0.5]);
    for (const cell of [...views, "B4"]) assert.equal(await page.locator(`[data-crosshair="${cell}"]`).count(), 1, cell);
    await undo();
    await page.locator('[data-cell="A2"]').waitFor({ state: "detached" });
    assert.equal(await valueOf("A1", "technique"), "plane");
    await page.getByRole("button", { name: "Redo" }).click();
    await page.locator('[data-cell="B4"][data-state="ok"]').waitFor();
    await settled(page, views);
});

test("a click on a plane takes the crosshair there, and the other planes with it", async () => {
    const before = await Promise.all(views.map((cell) => look(page, cell)));
    const half = [0.5, 0.5, 0.5];
    await clickAt("A2", 0.5, 0.3);
    const value = await waitForStyle(page, "A1", "plane.crosshair", half);
    assert.equal((await styleOf(page, "A4", "plane.crosshair")).origin, "sheet");
    assert.deepEqual(await valueOf("B4", "plane.crosshair"), value, "linked over the volumes");
    // Axial: x to the right, y up; the box fits with a margin of 4 %.
    near(value, [0.5, 0.5 + 0.2 * 1.04, 0.5], 0.02);
    await settled(page, views);
    const after = await Promise.all(views.map((cell) => look(page, cell)));
    assert.equal(after[1].hash, before[1].hash, "the plane that was pressed stays");
    assert.notEqual(after[2].hash, before[2].hash, "the coronal plane moves");
    assert.equal(after[3].hash, before[3].hash, "the sagittal plane does not: x is what it was");
    const line = page.locator('[data-crosshair="A2"] line').first();
    const height = (await picture("A2").boundingBox()).height;
    assert.ok(Math.abs(Number(await line.getAttribute("y1")) - 0.3 * height) < 2, "its line is where the pointer was");
    await undo();
    await waitForStyle(page, "A1", "plane.crosshair", value);
    assert.deepEqual(await valueOf("A1", "plane.crosshair"), half);
});

test("wheel and brackets move the crosshair along the plane's normal", async () => {
    await wheel("A4", -2);
    const value = await waitForStyle(page, "A1", "plane.crosshair", [0.5, 0.5, 0.5]);
    near(value, [0.5 + 2 / (size - 1), 0.5, 0.5], 1e-6);
    assert.equal(await valueOf("A4", "plane.position"), 0.5);
    await select(page, "A3");
    await picture("A3").focus();
    await page.keyboard.press("[");
    const next = await waitForStyle(page, "A1", "plane.crosshair", value);
    near(next, [value[0], 0.5 - 1 / (size - 1), 0.5], 1e-6);
});

test("x takes the crosshair to what lies under the pointer, in a volume too; Shift + x turns it off", async () => {
    const before = await valueOf("A1", "plane.crosshair");
    const at = await middleOf(picture("A1"));
    await page.mouse.move(at.x + 3, at.y + 3);
    await page.mouse.move(at.x, at.y);
    await waitUntil(page, () => window.voxsheet.store.get().page.probe?.world);
    const world = await page.evaluate(() => window.voxsheet.store.get().page.probe.world);
    await page.keyboard.press("x");
    const value = await waitForStyle(page, "A1", "plane.crosshair", before);
    near(value, world.map((part) => part / (size - 1)), 0.02);
    await page.keyboard.press("Shift+X");
    await waitForStyle(page, "A1", "plane.crosshair", value);
    assert.equal(await valueOf("A1", "plane.crosshair"), "none");
    assert.equal(await page.locator("[data-crosshair]").count(), 0);
    await settled(page, views);
    const [x, y, z] = await Promise.all(["x", "y", "z"].map((axis) => page.getByLabel(`plane.crosshair ${axis}`).inputValue()));
    assert.deepEqual([x, y, z], ["", "", ""]);
    await page.getByLabel("plane.crosshair y").fill("0.25");
    await page.getByLabel("plane.crosshair y").press("Enter");
    await waitForStyle(page, "A1", "plane.crosshair", "none");
    assert.deepEqual(await valueOf("A1", "plane.crosshair"), [0, 0.25, 0]);
});

test("the position's slider moves the crosshair along the plane's normal where there is one", async () => {
    await select(page, "A3");
    await setScope(page, "sheet");
    assert.equal(await page.locator("#key-plane-position").inputValue(), "0.25", "coronal: y");
    await page.locator("#key-plane-position").fill("0.75");
    await page.locator("#key-plane-position").press("Enter");
    assert.deepEqual(await waitForStyle(page, "A1", "plane.crosshair", [0, 0.25, 0]), [0, 0.75, 0]);
    assert.equal(await valueOf("A3", "plane.position"), 0.5);
});

test("linked cells of different size share a scale, or a place, by camera.frame, and clicks still mean what lies there", async () => {
    const frameOf = (cell) =>
        page.evaluate((name) => window.voxsheet.store.get().book.book.sheets[0].cells.find((each) => each.cell === name).frame, cell);
    assert.equal((await frameOf("C1")).size, null);
    await page.locator('[data-group="Camera"] h3 button').click();
    for (const [frame, x, y] of [["centre", 0.45, 0.55], ["world", 0.3, 0.7]]) {
        const before = await look(page, "C1");
        await page.locator("#key-camera-frame").selectOption(frame);
        await waitForOrigin(page, "camera.frame", "sheet");
        await waitUntil(page, (name) => window.voxsheet.store.get().book.book.sheets[0].cells[0].style["camera.frame"].value === name, frame);
        assert.deepEqual((await frameOf("C1")).size, [size - 1, size - 1, size - 1], "the largest of them");
        await settled(page, ["C1"]);
        const after = await look(page, "C1");
        assert.ok(after.covered < before.covered || frame === "world", "the small one is shown as small as it is");
        const crosshair = await valueOf("C1", "plane.crosshair");
        await clickAt("C1", x, y);
        const value = await waitForStyle(page, "C1", "plane.crosshair", crosshair);
        const world = await page.evaluate(async ([px, py]) => {
            const box = document.querySelector('[data-picture-of="C1"]').getBoundingClientRect();
            const query = new URLSearchParams({ cell: "C1", px: px * box.width, py: py * box.height, width: Math.round(box.width), height: Math.round(box.height) });
            return (await (await fetch(`api/v1/sheets/Sheet1/probe?${query}`)).json()).world;
        }, [x, y]);
        near(value, world.map((part) => part / 16), 0.02);
    }
    assert.deepEqual((await frameOf("A1")).centre, (await frameOf("C1")).centre);
    assert.deepEqual(page.problems, []);
});
