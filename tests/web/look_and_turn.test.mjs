// The page shows the sheet, and turning it changes the pictures.
import assert from "node:assert/strict";
import { test } from "node:test";
import { drag, look, settled, waitUntil } from "./page.mjs";
import { withPage } from "./session.mjs";
import { writeBalls } from "./volumes.mjs";

const cells = ["A1", "B1", "A2", "B2"];
let page;

withPage(async (folder) => await writeBalls(folder, 4, 48), (made) => ({ page } = made));

test("every cell shows a picture of its own, at full level and in device pixels", async () => {
    await settled(page, cells);
    const looks = await Promise.all(cells.map((cell) => look(page, cell)));
    for (const [i, { width, height, colours }] of looks.entries()) {
        const box = await page.locator(`[data-picture-of="${cells[i]}"]`).boundingBox();
        assert.ok(Math.abs(width - box.width) <= 1 && Math.abs(height - box.height) <= 1, `${width}x${height} for ${box.width}x${box.height}`);
        assert.ok(colours > 30, `${cells[i]} has only ${colours} colours`);
    }
    assert.equal(new Set(looks.map(({ hash }) => hash)).size, cells.length);
    assert.match(await page.locator(".status-bar").innerText(), /4 of 4 cells final/);
    assert.equal(new URL(page.url()).searchParams.has("token"), false, "the token stays in the address bar");
});

test("a drag turns all linked cells, many times a second, and ends in final pictures", async () => {
    const before = await Promise.all(cells.map((cell) => look(page, cell)));
    const { frames, ms } = await drag(page, "A1");
    console.log(`${frames} distinct frames in ${Math.round(ms)} ms while dragging`);
    // Loose on purpose: the machine may be busy with other tests.
    assert.ok(frames >= 4, `${frames} frames in ${ms} ms`);
    await settled(page, cells);
    const later = await Promise.all(cells.map((cell) => look(page, cell)));
    later.forEach(({ hash }, i) => assert.notEqual(hash, before[i].hash, cells[i]));
    const { outOfOrder, last } = await page.evaluate(() => ({ outOfOrder: window.voxsheet.stats.outOfOrder, last: window.voxsheet.stats.recent.at(-1) }));
    assert.equal(outOfOrder, 0);
    assert.equal(last.final, true);
});

test("Alt turns one cell alone; r brings all back to where they began", async () => {
    await page.keyboard.press("r");
    await settled(page, cells);
    const begin = await Promise.all(cells.map((cell) => look(page, cell)));
    await drag(page, "B1", { keys: ["Alt"], steps: 10 });
    await settled(page, cells);
    const turned = await Promise.all(cells.map((cell) => look(page, cell)));
    cells.forEach((cell, i) => assert.equal(turned[i].hash !== begin[i].hash, cell === "B1", cell));
    await page.getByLabel("Link the camera of B1 again").waitFor();
    await page.keyboard.press("r");
    await settled(page, cells);
    const back = await Promise.all(cells.map((cell) => look(page, cell)));
    assert.deepEqual(back, begin);
});

test("keys, wheel, roll and pan all move the camera", async () => {
    const moves = {
        arrow: () => page.keyboard.press("ArrowRight"),
        pan: () => page.keyboard.press("Shift+ArrowUp"),
        plus: () => page.keyboard.press("+"),
        wheel: () => page.mouse.wheel(0, -200),
        roll: () => drag(page, "A1", { keys: ["Control"], dx: 60, dy: 60, steps: 6 }),
        rightDrag: () => drag(page, "A1", { button: "right", steps: 6 }),
    };
    await page.locator('[data-picture-of="A1"]').click();
    await page.locator('[data-picture-of="A1"]').focus();
    let before = await look(page, "B2");
    for (const [name, move] of Object.entries(moves)) {
        await move();
        await page.waitForTimeout(300);
        await settled(page, cells);
        const now = await look(page, "B2");
        assert.notEqual(now.hash, before.hash, name);
        before = now;
    }
    await page.keyboard.press("r");
    await settled(page, cells);
});

test("Enter enlarges a cell and Esc comes back", async () => {
    const small = await look(page, "B1");
    await page.locator('[data-picture-of="B1"]').dblclick();
    await waitUntil(page, (width) => document.querySelector('[data-picture-of="B1"] canvas').width > 1.5 * width, small.width);
    await settled(page, ["B1"]);
    await page.keyboard.press("Escape");
    await settled(page, cells);
    assert.deepEqual(await look(page, "B1"), small);
});

test("hovering shows the value in every cell", async () => {
    const box = await page.locator('[data-picture-of="A1"]').boundingBox();
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.mouse.move(box.x + box.width / 2 + 2, box.y + box.height / 2);
    await page.locator(".probe-chip").nth(cells.length - 1).waitFor();
    assert.match(await page.locator('[data-cell="A1"] .probe-chip').innerText(), /\d/);
    await page.mouse.move(4, 4);
    await page.locator(".probe-chip").first().waitFor({ state: "detached" });
});

test("help opens on ? and nothing went wrong on the way", async () => {
    await page.keyboard.press("?");
    await page.getByRole("complementary", { name: "Help" }).waitFor();
    await page.keyboard.press("Escape");
    await page.getByRole("complementary", { name: "Help" }).waitFor({ state: "detached" });
    assert.deepEqual(page.problems, []);
});

test("every choice of the inspector shows what it is", async () => {
    const blank = await page.evaluate(() => [...document.querySelectorAll(".inspector select")].filter((select) => select.value === "").map(({ id }) => id));
    assert.deepEqual(blank, []);
    assert.equal(await page.locator("#key-shading-model").inputValue(), "auto");
});

test("every control has a name and is at least 24 pixels high and wide", async () => {
    const wrong = await page.evaluate(() =>
        [...document.querySelectorAll("button, select, a[href], [role=slider]")]
            .filter((element) => element.getClientRects().length > 0)
            .map((element) => {
                const { width, height } = element.getBoundingClientRect();
                const name = element.getAttribute("aria-label") ?? element.textContent ?? "";
                const labelled = name.trim() !== "" || element.labels?.length > 0;
                return width < 23.5 || height < 23.5 || !labelled ? `${element.className} "${name}" ${width}x${height}` : null;
            })
            .filter(Boolean),
    );
    assert.deepEqual(wrong, []);
});
