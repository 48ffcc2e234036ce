// A sheet of 256 cells: only what is in view has elements and is drawn, scrolling brings the rest, keys reach every cell.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { look, openBrowser, openPage, settled, waitUntil } from "./page.mjs";
import { makeFolder, removeFolder, startServer, stopServer } from "./server.mjs";
import { writeBalls } from "./volumes.mjs";

let folder, server, browser, page;

before(async () => {
    folder = await makeFolder();
    const [file] = await writeBalls(folder, 1, 32);
    server = await startServer(folder, [file]);
    browser = await openBrowser();
    page = await openPage(browser, server.url);
    await settled(page, ["A1"]);
    // One volume in 256 cells: what is large here is the sheet.
    await page.evaluate(async () => {
        const workbook = await (await fetch("api/v1/workbook")).json();
        const sheet = workbook.sheets[0];
        const { source } = sheet.cells.A1;
        sheet.columns = 16;
        sheet.rows = 16;
        for (let row = 1; row <= 16; ++row)
            for (let column = 0; column < 16; ++column)
                sheet.cells[String.fromCharCode(65 + column) + row] = { source, style: { "camera.azimuth": 20 * column + row } };
        const answer = await fetch("api/v1/workbook", { method: "PUT", body: JSON.stringify(workbook), headers: { "Content-Type": "application/json" } });
        if (!answer.ok) throw new Error(await answer.text());
    });
});

after(async () => {
    await browser?.close();
    if (server) await stopServer(server);
    await removeFolder(folder);
});

const state = () =>
    page.evaluate(() => ({
        elements: document.querySelectorAll("[data-cell]").length,
        shown: window.voxsheet.app.sizes.visibleTiles("").map(({ cell }) => cell),
        status: window.voxsheet.store.get().connection.status,
    }));

async function scrollTo(left, top) {
    await page.evaluate(([x, y]) => document.querySelector(".grid-scroll").scrollTo(x, y), [left, top]);
}

test("only the cells in view have elements and are drawn", async () => {
    await waitUntil(page, () => window.voxsheet.store.get().tiles.B2?.final);
    const { elements, shown, status } = await state();
    assert.ok(elements < 80, `${elements} elements`);
    assert.ok(shown.length >= 12 && shown.length < 60, shown.join(" "));
    assert.ok(shown.includes("A1") && !shown.includes("P16"));
    assert.ok(status.cells <= shown.length);
});

test("scrolling brings other pictures, and back again costs no rendering", async () => {
    await scrollTo(99999, 99999);
    await waitUntil(page, () => window.voxsheet.store.get().tiles.P16?.final);
    assert.ok((await look(page, "P16")).colours > 10);
    assert.ok((await state()).elements < 80);
    // What came into view last is drawn last, a little beyond the edge as well.
    await waitUntil(page, () => window.voxsheet.app.sizes.visibleTiles("").every(({ cell }) => window.voxsheet.store.get().tiles[cell]?.final));
    await page.waitForTimeout(300);
    const frames = await page.evaluate(() => window.voxsheet.stats.recent.length && window.voxsheet.stats.recent.at(-1).seq);
    await scrollTo(0, 0);
    // A canvas begins with one pixel.
    await waitUntil(page, () => ["A1", "B1", "A2", "B2"].every((cell) => document.querySelector(`[data-picture-of="${cell}"] canvas`)?.width > 1));
    await settled(page, ["A1", "B1", "A2", "B2"]);
    assert.ok((await look(page, "B2")).colours > 10, "what was on show is painted from what is here");
    const again = await page.evaluate(() => window.voxsheet.stats.recent.at(-1).seq);
    assert.equal(again, frames, "pictures that the page had already were sent again");
});

test("the grid zooms out to more cells and in to fewer, and keeps the active one in view", async () => {
    await page.locator('[data-title-of="B2"]').click();
    const fitting = (await state()).shown.length;
    const widthOf = (cell) => page.evaluate((name) => document.querySelector(`[data-cell="${name}"]`).getBoundingClientRect().width, cell);
    const before = await widthOf("B2");
    for (let i = 0; i < 4; ++i) await page.keyboard.press("Shift+Z");
    await waitUntil(page, () => document.querySelector('[data-cell="B2"]').getBoundingClientRect().width < 100);
    await waitUntil(page, (count) => window.voxsheet.app.sizes.visibleTiles("").length > 2 * count, fitting);
    await settled(page, (await state()).shown);
    // Nothing stands on the small pictures, and all of it does on the large one.
    await page.locator('[data-cell="B2"] .axes-cross').waitFor({ state: "hidden" });
    assert.ok((await look(page, "B2")).colours > 10);
    for (let i = 0; i < 8; ++i) await page.getByRole("button", { name: "Larger tiles, fewer cells" }).click();
    await waitUntil(page, (width) => document.querySelector('[data-cell="B2"]').getBoundingClientRect().width > 2 * width, before);
    await waitUntil(page, (count) => window.voxsheet.app.sizes.visibleTiles("").length < count, fitting);
    await page.locator('[data-cell="B2"] .axes-cross').waitFor({ state: "visible" });
    await page.locator('[data-header="B"]').hover();
    await page.keyboard.down("Control");
    await page.mouse.wheel(0, 100);
    await page.keyboard.up("Control");
    await page.locator('[data-title-of="B2"]').click();
    await page.keyboard.press("0");
    await waitUntil(page, (width) => document.querySelector('[data-cell="B2"]').getBoundingClientRect().width === width, before);
    assert.deepEqual(page.problems, []);
});

test("arrow keys reach cells that were out of view", async () => {
    await page.locator('[data-title-of="A1"]').click();
    for (let i = 0; i < 15; ++i) await page.keyboard.press("ArrowDown");
    await waitUntil(page, () => document.activeElement?.getAttribute("data-title-of") === "A16");
    await waitUntil(page, () => {
        const tile = document.querySelector('[data-cell="A16"]').getBoundingClientRect();
        return tile.top >= 0 && tile.bottom <= window.innerHeight;
    });
    assert.deepEqual(page.problems, []);
});

test("in small tiles no badge covers a cell's name, and bars make room for handles", async () => {
    await page.evaluate(async () => {
        const body = JSON.stringify({ level: 1, "clip.planes": [[0, -1, 0, 0.5]] });
        await fetch("api/v1/sheets/Sheet1/style", { method: "PATCH", body, headers: { "Content-Type": "application/json" } });
    });
    await waitUntil(page, () => Object.values(window.voxsheet.store.get().tiles).some(({ level, final }) => level === 1 && final));
    const places = () =>
        page.evaluate(() =>
            [...document.querySelectorAll(".tile")].map((tile) => {
                const box = (found) => found?.getBoundingClientRect().toJSON();
                const shown = (selector) => [...tile.querySelectorAll(selector)].some((each) => getComputedStyle(each).display !== "none");
                return {
                    name: box(tile.querySelector(".title-button b")),
                    title: box(tile.querySelector(".title-button")),
                    badge: box(tile.querySelector(".level-badge")),
                    bar: shown(".colour-bar"),
                    handles: shown(".clip-handles"),
                };
            }),
        );
    const cover = ({ name, title, badge }) => badge && (name.right > title.right + 0.5 || name.right > badge.left + 0.5);
    await waitUntil(page, () => document.querySelectorAll(".level-badge").length > 3);
    const before = await places();
    assert.deepEqual(before.filter(cover), []);
    await page.getByRole("button", { name: /clip handles/i }).first().click();
    await waitUntil(page, () => document.querySelectorAll(".clip-handles").length > 3);
    const after = await places();
    assert.ok(after.some(({ handles }) => handles));
    assert.deepEqual(after.filter(({ bar, handles }) => bar && handles), []);
    // Small enough that the pictures stand alone.
    for (let i = 0; i < 3; ++i) await page.keyboard.press("Shift+Z");
    await page.waitForTimeout(300);
    assert.deepEqual((await places()).filter(cover), []);
});
