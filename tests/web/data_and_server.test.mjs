// Data comes and goes, and so does the server.
import assert from "node:assert/strict";
import { writeFile } from "node:fs/promises";
import { after, before, test } from "node:test";
import { look, openBrowser, openPage, settled, waitUntil } from "./page.mjs";
import { makeFolder, removeFolder, startServer, stopServer } from "./server.mjs";
import { ball, truncated, writeBalls } from "./volumes.mjs";

let folder, server, browser, page, files;

before(async () => {
    folder = await makeFolder();
    files = await writeBalls(folder, 1, 32);
    await writeFile(`${folder}/later.nrrd`, ball(32, [0.5, 0.5, 0.5], 0.2));
    server = await startServer(folder, files);
    browser = await openBrowser();
    page = await openPage(browser, server.url);
    await settled(page, ["A1"]);
});

after(async () => {
    await browser?.close();
    if (server) await stopServer(server);
    await removeFolder(folder);
});

/** The cell that shows a dataset. */
async function cellWith(dataset) {
    return waitUntil(
        page,
        (name) => window.voxsheet.store.get().book.book.sheets[0].cells.find((cell) => cell.source?.dataset === name)?.cell,
        dataset,
    );
}

test("an upload becomes a dataset and a picture", async () => {
    await page.locator('input[type="file"]').first().setInputFiles({ name: "sent.nrrd", mimeType: "application/octet-stream", buffer: ball(32, [0.4, 0.6, 0.5]) });
    await page.locator('[data-dataset="sent.nrrd"][data-state="ready"]').waitFor();
    const cell = await cellWith("sent.nrrd");
    await settled(page, [cell]);
    assert.ok((await look(page, cell)).colours > 30);
});

test("a file that cannot be read says why, in the list and in its cell, and the others go on", async () => {
    await page.locator('input[type="file"]').first().setInputFiles({ name: "broken.nrrd", mimeType: "application/octet-stream", buffer: truncated() });
    const row = page.locator('[data-dataset="broken.nrrd"][data-state="failed"]');
    await row.waitFor();
    assert.ok((await row.locator(".dataset-error").innerText()).length > 20);
    const cell = await cellWith("broken.nrrd");
    await page.locator(`[data-cell="${cell}"][data-state="error"]`).waitFor();
    assert.match(await page.locator(`[data-cell="${cell}"] .tile-error`).innerText(), /#IMPORT!/);
    await settled(page, ["A1"]);
});

test("files are opened from the server's folders, with a look at the header first", async () => {
    await page.getByRole("button", { name: "open", exact: true }).click();
    const entry = page.locator(".file-entry", { hasText: "later.nrrd" });
    await entry.hover();
    await page.locator('[aria-label="Preview"]', { hasText: "32 × 32 × 32" }).waitFor();
    await entry.locator("input").check();
    await page.getByRole("button", { name: "open 1 file" }).click();
    await page.locator('[data-dataset="later.nrrd"][data-state="ready"]').waitFor();
    await settled(page, [await cellWith("later.nrrd")]);
});

test("a page that is opened while the workbook is edited shows the edited one", async () => {
    const late = await openPage(browser, "about:blank");
    let answered = false;
    await late.route("**/api/v1/state*", async (route) => {
        const response = await route.fetch();
        if (!answered) {
            answered = true;
            await page.evaluate(async () => {
                await window.voxsheet.app.undo();
                await window.voxsheet.app.redo();
            });
        }
        await route.fulfill({ response });
    });
    await late.goto(server.url);
    await settled(late, ["A1"]);
    const version = (of) => of.evaluate(() => window.voxsheet.store.get().book.book.version);
    assert.equal(await version(late), await version(page));
    await late.context().close();
});

test("a removed dataset leaves the list", async () => {
    await page.locator('[data-dataset="broken.nrrd"]').hover();
    await page.getByLabel("Remove broken.nrrd").click();
    await page.locator('[data-dataset="broken.nrrd"]').waitFor({ state: "detached" });
});

test("a hidden page closes its stream, and opens it again when it is seen", async () => {
    const setHidden = (hidden) =>
        page.evaluate((value) => {
            Object.defineProperty(document, "hidden", { configurable: true, get: () => value });
            document.dispatchEvent(new Event("visibilitychange"));
        }, hidden);
    await setHidden(true);
    await page.locator('.connection[data-phase="paused"]').waitFor();
    await setHidden(false);
    await page.locator('.connection[data-phase="live"]').waitFor();
    await settled(page, ["A1"]);
});

test("when the server goes away the page says so, and comes back by itself", async () => {
    await stopServer(server);
    await page.locator('.connection[data-phase="lost"]').waitFor();
    assert.match(await page.locator(".connection").innerText(), /lost/);
    const paintedBefore = await page.evaluate(() => window.voxsheet.stats.tilesPainted);
    server = await startServer(folder, files, server.port);
    await page.locator('.connection[data-phase="live"]').waitFor();
    await waitUntil(page, (count) => window.voxsheet.stats.tilesPainted > count, paintedBefore);
    await settled(page, ["A1"]);
    assert.deepEqual(page.problems, []);
});

test("a server that comes back with another workbook shows that one", async () => {
    const document = await page.evaluate(async () => (await fetch("api/v1/workbook")).json());
    document.sheets[0].name = "Other";
    await writeFile(`${folder}/other.json`, JSON.stringify(document));
    await stopServer(server);
    await page.locator('.connection[data-phase="lost"]').waitFor();
    server = await startServer(folder, [`${folder}/other.json`], server.port);
    await page.locator('.connection[data-phase="live"]').waitFor();
    await page.getByRole("tab", { name: "Other" }).waitFor();
    await settled(page, ["A1"]);
    assert.deepEqual(page.problems, []);
});

test("a page without the token is told what to do", async () => {
    const stranger = await openPage(browser, new URL("/", server.url).href);
    // Either the server refuses the page itself, or the page says that it may not talk to the server.
    const text = await stranger.locator("body").innerText();
    assert.match(text, /token/i);
    await stranger.context().close();
});
