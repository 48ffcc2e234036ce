// Opening many files from the server's folders: previews, numbered series, choosing several by mouse and keyboard.
import assert from "node:assert/strict";
import { mkdir, writeFile } from "node:fs/promises";
import { after, before, test } from "node:test";
import { look, openBrowser, openPage, settled, waitUntil } from "./page.mjs";
import { makeFolder, removeFolder, startServer, stopServer } from "./server.mjs";
import { ball, discTiff, writeBalls } from "./volumes.mjs";

const slices = 12;
let folder, server, browser, page;

before(async () => {
    folder = await makeFolder();
    const files = await writeBalls(folder, 1, 32);
    for (let i = 1; i <= slices; ++i) {
        await writeFile(`${folder}/frame_${String(i).padStart(3, "0")}.tif`, discTiff(32, 255 * Math.sin((Math.PI * i) / (slices + 1))));
    }
    for (let i = 0; i < 3; ++i) await writeFile(`${folder}/step_${8 + i}.nrrd`, ball(32, [0.3 + 0.2 * i, 0.5, 0.5]));
    await mkdir(`${folder}/more`);
    for (const name of ["left", "middle", "right", "top"]) await writeFile(`${folder}/more/${name}.nrrd`, ball(32, [0.5, 0.4, 0.5]));
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

const line = (text) => page.locator(".file-entry", { hasText: text });
const facts = (text) => page.locator('[aria-label="Preview"]', { hasText: text });
const openAs = () => page.getByLabel("Open several files as");

async function openPanel() {
    await page.getByRole("button", { name: "open", exact: true }).click();
    await page.locator(".file-entry").first().waitFor();
}

/** The dataset of a name, once it is ready. */
async function dataset(pattern) {
    return waitUntil(
        page,
        (wanted) => window.voxsheet.store.get().book.datasets.find((each) => new RegExp(wanted).test(each.name) && each.state === "ready"),
        pattern,
    );
}

async function cellOf(name) {
    return waitUntil(
        page,
        (wanted) => window.voxsheet.store.get().book.book.sheets[0].cells.find((cell) => cell.source?.dataset === wanted)?.cell,
        name,
    );
}

test("numbered pictures are one entry, their header is shown, and they open as one volume", async () => {
    await openPanel();
    assert.equal(await line("frame_").count(), 1);
    await line("frame_").hover();
    await facts("32 × 32 × 1").waitFor();
    await facts(`${slices}, the first of which`).waitFor();
    await facts("tiff").waitFor();
    await line("frame_").locator("input").check();
    await openAs().waitFor();
    assert.equal(await openAs().inputValue(), "stack");
    await page.getByRole("button", { name: `open ${slices} files` }).click();
    const stack = await dataset("^frame_");
    assert.deepEqual(stack.dims, [32, 32, slices]);
    const cell = await cellOf(stack.name);
    await settled(page, [cell]);
    assert.ok((await look(page, cell)).colours > 30);
});

test("numbered volumes can be steps of time of one dataset", async () => {
    await openPanel();
    await line("step_").locator("input").check();
    await facts("32 × 32 × 32").waitFor();
    assert.equal(await openAs().inputValue(), "each");
    await openAs().selectOption({ label: "time steps" });
    await page.getByRole("button", { name: "open 3 files" }).click();
    const series = await dataset("^step_");
    assert.equal(series.steps, 3);
    await settled(page, [await cellOf(series.name)]);
});

test("a series shows its files when asked to, and one of them opens alone", async () => {
    await openPanel();
    assert.equal(await line("step_10.nrrd").count(), 0);
    await page.locator("li", { has: line("step_") }).getByLabel("Show its files").click();
    await line("step_10.nrrd").locator("input").check();
    await page.getByRole("button", { name: "open 1 file" }).click();
    assert.equal((await dataset("^step_10")).steps ?? 1, 1);
});

test("a range is chosen with Shift and the mouse, each file in a cell of its own", async () => {
    await openPanel();
    await line("more").click();
    await line("left.nrrd").click();
    await line("right.nrrd").click({ modifiers: ["Shift"] });
    await page.getByRole("button", { name: "open 3 files" }).waitFor();
    await line("middle.nrrd").click({ modifiers: ["Shift"] });
    assert.equal(await openAs().inputValue(), "each");
    await page.getByRole("button", { name: "open 2 files" }).click();
    for (const name of ["left", "middle"]) await settled(page, [await cellOf((await dataset(name)).name)]);
});

test("the keyboard alone walks the list, chooses a range and opens it", async () => {
    await openPanel();
    await line("more").focus();
    await page.keyboard.press("Enter");
    await line("left.nrrd").waitFor();
    await line("middle.nrrd").locator("input").focus();
    await page.keyboard.press("ArrowDown");
    await facts("32 × 32 × 32").waitFor();
    await page.keyboard.press("Space");
    await page.getByRole("button", { name: "open 1 file" }).waitFor();
    await page.keyboard.press("Shift+ArrowDown");
    await page.getByRole("button", { name: "open 2 files" }).waitFor();
    await page.keyboard.press("Control+a");
    await page.getByRole("button", { name: "open 4 files" }).waitFor();
    await page.keyboard.press("Shift+ArrowUp"); // from the first that Ctrl + A chose
    await page.getByRole("button", { name: "open 3 files" }).waitFor();
    await page.keyboard.press("Enter");
    await dataset("right");
    assert.deepEqual(page.problems, []);
});
