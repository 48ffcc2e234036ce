// A spreadsheet's habits: copy, cut, paste and Delete; window and level; a view that becomes part of the workbook; fingers.
import assert from "node:assert/strict";
import { test } from "node:test";
import { drag, look, openPage, select, setScope, settled, styleOf, waitForOrigin, waitForState, waitForStyle, waitUntil } from "./page.mjs";
import { withPage } from "./session.mjs";
import { writeBalls } from "./volumes.mjs";

const cells = ["A1", "B1", "C1"];
let server, browser, page;

withPage(
    async (folder) => [...(await writeBalls(folder, 3, 32)), "--columns", "3"],
    (made) => ({ server, browser, page } = made),
    { cells, context: { permissions: ["clipboard-read", "clipboard-write"] } },
);

const looks = () => Promise.all(cells.map((cell) => look(page, cell)));
const sourceOf = (cell) =>
    page.evaluate((name) => {
        const { source } = window.voxsheet.store.get().book.book.sheets[0].cells.find((each) => each.cell === name) ?? {};
        return source?.formula ?? source?.dataset ?? null;
    }, cell);

async function waitForSource(cell, wanted) {
    await waitUntil(
        page,
        ([name, text]) => {
            const { source } = window.voxsheet.store.get().book.book.sheets[0].cells.find((each) => each.cell === name) ?? {};
            return (source?.formula ?? source?.dataset ?? null) === text;
        },
        [cell, wanted],
    );
}

test("a copied cell is pasted as often as one likes, and one undo takes a paste back", async () => {
    const [source] = await Promise.all([sourceOf("A1"), page.getByRole("button", { name: "One column more" }).click()]);
    await page.locator('[data-cell="D1"]').waitFor();
    await settled(page, cells);
    await select(page, "A1");
    await page.keyboard.press("Control+c");
    await select(page, "D1");
    await page.keyboard.press("Control+v");
    await waitForSource("D1", source);
    await settled(page, [...cells, "D1"]);
    assert.equal((await look(page, "D1")).hash, (await look(page, "A1")).hash, "the same volume, seen alike");
    await page.keyboard.press("Control+z");
    await waitForState(page, "D1", "empty");
    assert.equal(await sourceOf("A1"), source, "copying takes nothing away");
});

test("a copied formula means the cells beside its new place", async () => {
    await select(page, "C1");
    await page.keyboard.press("F2");
    await page.locator("#formula-input").fill("=A1+B1");
    await page.keyboard.press("Enter");
    await waitForSource("C1", "=A1+B1");
    await select(page, "C1");
    await page.keyboard.press("Control+c");
    await select(page, "D1");
    await page.keyboard.press("Control+v");
    await waitForSource("D1", "=B1+C1");
    await settled(page, [...cells, "D1"]);
});

test("several cells are cut and pasted in one piece", async () => {
    const sources = await Promise.all(["A1", "B1"].map(sourceOf));
    await select(page, "D1");
    await page.keyboard.press("Delete");
    await waitForState(page, "D1", "empty");
    await select(page, "C1");
    await page.keyboard.press("Delete");
    await waitForState(page, "C1", "empty");
    await select(page, "A1");
    await page.locator('[data-title-of="B1"]').click({ modifiers: ["Shift"] });
    await page.keyboard.press("Control+x");
    await waitForState(page, "A1", "empty");
    await waitForState(page, "B1", "empty");
    await select(page, "C1");
    await page.keyboard.press("Control+v");
    await waitForSource("C1", sources[0]);
    await waitForSource("D1", sources[1]);
    await page.keyboard.press("Control+z");
    await waitForState(page, "C1", "empty");
    await page.keyboard.press("Control+z");
    await waitForSource("A1", sources[0]);
    await waitForSource("B1", sources[1]);
});

test("a middle drag sets window and level, as w + drag does", async () => {
    await select(page, "A1");
    await setScope(page, "sheet");
    await settled(page, ["A1", "B1"]);
    const before = await look(page, "A1");
    await drag(page, "A1", { button: "middle", dx: -50, dy: 20, steps: 8 });
    await waitForOrigin(page, "range.min", "sheet");
    assert.equal((await styleOf(page, "A1", "range.mode")).value, "fixed");
    await settled(page, ["A1", "B1"]);
    const windowed = await look(page, "A1");
    assert.notEqual(windowed.hash, before.hash);
    await page.keyboard.press("Control+z");
    await waitForStyle(page, "A1", "range.mode", "fixed");
    await settled(page, ["A1", "B1"]);
    assert.deepEqual(await look(page, "A1"), before);
});

test("saving the view writes the camera into the workbook: who opens the page anew sees the same", async () => {
    const azimuth = (await styleOf(page, "A1", "camera.azimuth")).value;
    await drag(page, "A1", { dx: 60, dy: 20, steps: 8 });
    await settled(page, ["A1", "B1"]);
    const turned = await look(page, "A1");
    await page.getByRole("button", { name: "Save view into the workbook" }).click();
    await waitForStyle(page, "A1", "camera.azimuth", azimuth);
    assert.equal((await styleOf(page, "A1", "camera.azimuth")).origin, "sheet");
    await settled(page, ["A1", "B1"]);
    assert.equal((await look(page, "A1")).hash, turned.hash);
    const other = await openPage(browser, server.url);
    await settled(other, ["A1", "B1"]);
    assert.deepEqual(await look(other, "A1"), turned);
    await other.context().close();
});

test("one finger turns, two fingers pan and zoom", async () => {
    const touched = await openPage(browser, server.url, { hasTouch: true });
    await settled(touched, ["A1", "B1"]);
    const session = await touched.context().newCDPSession(touched);
    const box = await touched.locator('[data-picture-of="A1"]').boundingBox();
    const middle = { x: box.x + box.width / 2, y: box.y + box.height / 2 };
    const camera = () => touched.evaluate(() => window.voxsheet.app.view.camera("A1"));
    /** Fingers from places to places, relative to the picture's middle. */
    const touch = async (from, to, steps = 8) => {
        const points = (part) =>
            from.map(([x, y], id) => ({ id, x: middle.x + x + part * (to[id][0] - x), y: middle.y + y + part * (to[id][1] - y) }));
        await session.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: points(0) });
        for (let i = 1; i <= steps; ++i) {
            await session.send("Input.dispatchTouchEvent", { type: "touchMove", touchPoints: points(i / steps) });
        }
        await session.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
        await settled(touched, ["A1", "B1"]);
        return camera();
    };
    const first = await look(touched, "B1");
    const start = await camera();
    const orbited = await touch([[0, 0]], [[50, 20]]);
    assert.notEqual(orbited.azimuth, start.azimuth);
    assert.notEqual(orbited.elevation, start.elevation);
    assert.deepEqual([orbited.distance, orbited.target], [start.distance, start.target]);
    const second = await look(touched, "B1");
    assert.notEqual(second.hash, first.hash, "linked cells follow");

    const zoomed = await touch([[-25, 0], [25, 0]], [[-50, 0], [50, 0]]);
    assert.ok(Math.abs(zoomed.distance / orbited.distance - 0.5) < 0.1, `from ${orbited.distance} to ${zoomed.distance}`);
    assert.equal(zoomed.azimuth, orbited.azimuth, "two fingers do not turn");
    const third = await look(touched, "B1");
    assert.ok(third.covered > second.covered, `${third.covered} after ${second.covered} pixels`);

    const panned = await touch([[-25, 0], [25, 0]], [[-5, 15], [45, 15]]);
    assert.ok(Math.abs(panned.distance / zoomed.distance - 1) < 0.05, `from ${zoomed.distance} to ${panned.distance}`);
    assert.notDeepEqual(panned.target, zoomed.target);
    assert.notEqual((await look(touched, "B1")).hash, third.hash);
    assert.deepEqual(touched.problems, []);
    await touched.context().close();
    assert.deepEqual(page.problems, []);
});
