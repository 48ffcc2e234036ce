// Levels of detail on the page: rules that fire as datasets are added, badges, pins, and the panel with the time-N curve.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { drag, openBrowser, openPage, settled, waitUntil } from "./page.mjs";
import { makeFolder, removeFolder, startServer, stopServer } from "./server.mjs";
import { writeBalls } from "./volumes.mjs";

let folder, server, browser, page, files;

before(async () => {
    folder = await makeFolder();
    files = await writeBalls(folder, 6, 64);
    server = await startServer(folder, files.slice(0, 2));
    browser = await openBrowser();
    page = await openPage(browser, server.url);
});

after(async () => {
    await browser?.close();
    if (server) await stopServer(server);
    await removeFolder(folder);
});

const api = (path, method, body) =>
    page.evaluate(
        async ([where, how, what]) => {
            const answer = await fetch(where, { method: how, body: what && JSON.stringify(what), headers: { "Content-Type": "application/json" } });
            return { status: answer.status, json: await answer.json().catch(() => null) };
        },
        [path, method, body],
    );

async function addDataset(file) {
    const { status } = await api("api/v1/datasets", "POST", { files: [file] });
    assert.ok(status < 300, `status ${status}`);
}

/** Levels of the pictures on show, once all of them are final. */
async function levels(cells) {
    await settled(page, cells);
    return page.evaluate((names) => names.map((name) => window.voxsheet.store.get().tiles[name].level), cells);
}

async function choosePolicy(policy, limit) {
    await page.locator("#level-policy").selectOption(policy);
    await page.locator(`[data-policy="${policy}"]`).waitFor();
    if (limit === undefined) return;
    await page.locator("#level-limit").fill(String(limit));
    await page.locator("#level-limit").press("Enter");
}

const badge = (cell) => page.locator(`[data-cell="${cell}"] [data-level]`);

test("at full level there is no badge; the status bar opens the panel", async () => {
    assert.deepEqual(await levels(["A1", "B1"]), [0, 0]);
    assert.equal(await page.locator("[data-level]").count(), 0);
    await page.locator(".status-button").click();
    await page.locator("#level-policy").waitFor();
    assert.equal(await page.locator("#level-policy").inputValue(), "focus");
});

test("adding datasets breaks the rule of their number: all badges change, and change back with fewer", async () => {
    await choosePolicy("count", 3);
    await addDataset(files[2]);
    await waitUntil(page, () => Object.values(window.voxsheet.store.get().tiles).filter((tile) => tile.painted).length >= 3);
    const three = await page.evaluate(() => Object.keys(window.voxsheet.store.get().tiles).filter((name) => window.voxsheet.store.get().tiles[name].painted));
    assert.deepEqual(await levels(three), [0, 0, 0]);
    await addDataset(files[3]);
    await waitUntil(page, () => Object.values(window.voxsheet.store.get().tiles).filter((tile) => tile.painted && tile.level === 1).length === 4);
    assert.equal(await page.locator('[data-level="1"]').count(), 4);
    await page.locator(".levels-reason", { hasText: /4 cells on show, coarsest level 1: .*4 datasets/ }).waitFor();
    await choosePolicy("count", 30);
    await waitUntil(page, () => Object.values(window.voxsheet.store.get().tiles).every((tile) => !tile.painted || (tile.level === 0 && tile.final)));
    assert.equal(await page.locator("[data-level]").count(), 0);
});

test("a frame time that no machine keeps makes all cells coarse; one click goes to the slope rule and back", async () => {
    await choosePolicy("time", 0.001);
    await drag(page, "A1", { steps: 6 });
    await waitUntil(page, () => Object.values(window.voxsheet.store.get().tiles).filter((tile) => tile.painted && tile.final && tile.level === 2).length === 4);
    await page.getByRole("button", { name: "Use the slope rule for all cells" }).click();
    await page.locator('[data-policy="slope"]').waitFor();
    assert.equal(await page.locator("#level-policy").inputValue(), "slope");
    await page.getByRole("button", { name: "Back to a level per cell" }).click();
    // The frame time is the budget of this policy, too.
    await choosePolicy("focus", 60_000);
    await waitUntil(page, () => Object.values(window.voxsheet.store.get().tiles).every((tile) => !tile.painted || (tile.level === 0 && tile.final)));
});

test("undo takes a policy back, and the panel goes back to the server's own", async () => {
    await choosePolicy("slope");
    const reset = page.getByRole("button", { name: "Reset to the server's policy" });
    await reset.waitFor();
    await page.locator('[data-title-of="A1"]').click();
    await page.keyboard.press("Control+z");
    await page.locator('[data-policy="focus"]').waitFor();
    await reset.click();
    await reset.waitFor({ state: "detached" });
    const { json } = await api("api/v1/workbook", "GET");
    assert.equal(json.sheets[0].levels, undefined);
    await choosePolicy("focus", 60_000);
});

test("a level is pinned in the inspector, shows on the badge, and is released by the badge's menu", async () => {
    await page.locator('[data-title-of="B1"]').click();
    await page.locator('[data-scope="cell"]').click();
    await page.locator('[data-key="level"] input:not([type="range"])').fill("2");
    await page.locator('[data-key="level"] input:not([type="range"])').press("Enter");
    await waitUntil(page, () => window.voxsheet.store.get().tiles.B1.level === 2 && window.voxsheet.store.get().tiles.B1.final);
    assert.equal((await badge("B1").innerText()).trim(), "level 2");
    assert.equal(await badge("A1").count(), 0);
    const exported = await page.evaluate(async () => (await fetch("api/v1/sheets/Sheet1/cells/B1/image.png?width=32&height=32")).headers.get("X-Voxsheet-Level"));
    assert.equal(exported, "0");
    await page.getByRole("button", { name: /^Level of detail of B1/ }).click();
    await page.getByRole("menuitem", { name: "By policy" }).click();
    await waitUntil(page, () => window.voxsheet.store.get().tiles.B1.level === 0 && window.voxsheet.store.get().tiles.B1.final);
    // The pin goes with the workbook's answer, which may come after the picture.
    await badge("B1").waitFor({ state: "detached" });
});

test("the panel measures T_N on request and reads its points out to the keyboard", async () => {
    await page.getByRole("button", { name: "Measure T_N now" }).click();
    await waitUntil(page, () => (window.voxsheet.store.get().levels.timings?.points.length ?? 0) >= 4);
    const plot = page.locator(".time-plot svg");
    assert.ok(Number(await plot.getAttribute("data-points")) >= 4);
    await plot.focus();
    await page.keyboard.press("Home");
    await page.locator(".plot-text", { hasText: /^N = 1, T_N [0-9.]+ ms \([0-9.]+ to [0-9.]+\) from/ }).waitFor();
    await page.keyboard.press("ArrowRight");
    await page.locator(".plot-text", { hasText: /^N = 2,/ }).waitFor();
    await page.keyboard.press("Escape");
    await page.locator(".levels-panel").waitFor({ state: "detached" });
});

test("bad settings are refused with the field at fault, and the old ones stay", async () => {
    for (const [body, field] of [
        [{ policy: "nonsense" }, "policy"],
        [{ policy: "time", frame_ms: 0 }, "frame_ms"],
        [{ datasets: -1 }, "datasets"],
        [{ bytes: 0 }, "bytes"],
        [{ up_fraction: 2 }, "up_fraction"],
        [{ colour: "red" }, "colour"],
    ]) {
        const { status, json } = await api("api/v1/sheets/Sheet1/resolution", "PATCH", body);
        assert.equal(status, 400, JSON.stringify(json));
        assert.equal(json.field, field);
    }
    const { json } = await api("api/v1/sheets/Sheet1/resolution", "GET");
    assert.equal(json.policy, "focus");
    assert.deepEqual(page.problems, []);
});
