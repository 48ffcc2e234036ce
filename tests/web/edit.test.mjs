// Edits: transfer function, overrides and resets, formulas, undo.
import assert from "node:assert/strict";
import { test } from "node:test";
import {
    chooseMap,
    drag,
    look,
    originOf,
    select,
    setScope,
    settled,
    typeFormula,
    waitForOrigin,
    waitForState,
    waitUntil,
} from "./page.mjs";
import { withPage } from "./session.mjs";
import { writeBalls } from "./volumes.mjs";

const cells = ["A1", "B1", "A2"];
let page;

withPage(async (folder) => [...(await writeBalls(folder, 3, 40)), "--columns", "2"], (made) => ({ page } = made), { cells });

const looks = () => Promise.all(cells.map((cell) => look(page, cell)));

test("dragging a point of the opacity curve changes every picture and the workbook", async () => {
    await select(page, "A1");
    const before = await looks();
    const point = await page.locator(".transfer-editor .point").last().boundingBox();
    const editor = await page.locator(".transfer-editor > svg").boundingBox();
    await page.mouse.move(point.x + point.width / 2, point.y + point.height / 2);
    await page.mouse.down();
    // Far from where it is: up if it is low, down if it is high.
    const low = point.y > editor.y + editor.height / 2;
    await page.mouse.move(point.x - 30, low ? editor.y + 8 : editor.y + editor.height - 8, { steps: 6 });
    await page.mouse.up();
    await waitForOrigin(page, "transfer.opacity", "sheet");
    await settled(page, cells);
    const after = await looks();
    after.forEach(({ hash }, i) => assert.notEqual(hash, before[i].hash, cells[i]));
});

test("one drag is one undo step, and redo brings it back", async () => {
    const edited = await looks();
    await page.locator("body").click({ position: { x: 400, y: 795 } });
    await page.keyboard.press("Control+z");
    await waitForOrigin(page, "transfer.opacity", "default");
    await settled(page, cells);
    assert.notEqual((await look(page, "A1")).hash, edited[0].hash);
    await page.keyboard.press("Control+Shift+Z");
    await waitForOrigin(page, "transfer.opacity", "sheet");
    await settled(page, cells);
    assert.deepEqual(await looks(), edited);
});

test("points are numbers too, and keys move them", async () => {
    await page.getByRole("button", { name: "numbers" }).click();
    const opacity = page.getByLabel("Opacity of point 1");
    await opacity.fill("0.5");
    await opacity.press("Enter");
    await waitUntil(page, () => window.voxsheet.store.get().book.book.sheets[0].cells[0].style["transfer.opacity"].value[0][1] === 0.5);
    await page.locator(".transfer-editor .point").first().focus();
    await page.keyboard.press("ArrowDown");
    await waitUntil(page, () => window.voxsheet.store.get().book.book.sheets[0].cells[0].style["transfer.opacity"].value[0][1] < 0.5);
    await page.getByRole("button", { name: "hide numbers" }).click();
});

test("an override shows its origin and is reset to what it inherits", async () => {
    const maps = await page.evaluate(() => window.voxsheet.store.get().connection.maps.map((map) => map.name));
    await settled(page, cells);
    const before = await looks();
    const other = maps.find((name) => !["auto", "viridis"].includes(name));
    await select(page, "B1");
    await setScope(page, "cell");
    await chooseMap(page, other);
    await waitForOrigin(page, "transfer.map", "cell");
    await settled(page, cells);
    const overridden = await looks();
    assert.deepEqual(cells.map((_, i) => overridden[i].hash !== before[i].hash), [false, true, false]);
    await select(page, "A1");
    assert.notEqual(await originOf(page, "transfer.map"), "cell");
    await select(page, "B1");
    await page.locator('[data-key="transfer.map"] .reset').click();
    await waitForOrigin(page, "transfer.map", "default");
    await settled(page, cells);
    assert.deepEqual(await looks(), before);
});

test("an edit that a nearer value hides says so and offers to clear it", async () => {
    const maps = await page.evaluate(() => window.voxsheet.store.get().connection.maps.map((map) => map.name));
    const [first, second] = maps.filter((name) => !["auto", "viridis"].includes(name));
    await select(page, "B1");
    await setScope(page, "cell");
    await chooseMap(page, first);
    await waitForOrigin(page, "transfer.map", "cell");
    await setScope(page, "sheet");
    await chooseMap(page, second);
    const message = page.locator(".hidden-message");
    await message.waitFor();
    assert.match(await message.innerText(), /transfer\.map.*B1/s);
    await message.getByRole("button", { name: "clear the nearer values" }).click();
    await waitForOrigin(page, "transfer.map", "sheet");
    await message.waitFor({ state: "detached" });
});

test("a column takes an edit of its own", async () => {
    await page.locator('[data-header="B"]').click();
    assert.equal(await page.locator(".inspector h2").innerText(), "Column B");
    await page.locator("#key-technique").selectOption("mip");
    await waitUntil(page, () => {
        const style = (cell) => window.voxsheet.store.get().book.book.sheets[0].cells.find((entry) => entry.cell === cell).style.technique;
        return style("B1").origin === "column" && style("A1").origin === "default";
    });
    await settled(page, cells);
});

test("w + drag sets window and level", async () => {
    await select(page, "A1");
    await setScope(page, "sheet");
    const before = await look(page, "A1");
    await drag(page, "A1", { keys: ["w"], dx: -50, dy: 20, steps: 8 });
    await waitForOrigin(page, "range.min", "sheet");
    await settled(page, cells);
    assert.notEqual((await look(page, "A1")).hash, before.hash);
});

test("a formula gives a picture, and a wrong one an error that says what to do", async () => {
    await typeFormula(page, "B2", "=B1-A1");
    await settled(page, [...cells, "B2"]);
    const difference = await look(page, "B2");
    assert.ok(difference.colours > 10, `${difference.colours} colours`);
    await typeFormula(page, "B2", "=B1-Z99");
    await waitForState(page, "B2", "error");
    assert.match(await page.locator('[data-cell="B2"] .tile-error').innerText(), /#REF!.+Z99/s);
    await typeFormula(page, "B2", "=B2+1");
    await page.locator('[data-cell="B2"] .tile-error', { hasText: "#CYCLE!" }).waitFor();
});

test("while a formula is typed, a click on a cell puts its address in", async () => {
    await select(page, "B2");
    await page.keyboard.press("=");
    await page.locator('[data-picture-of="B1"]').click();
    await page.keyboard.type("-");
    await page.locator('[data-title-of="A1"]').click();
    assert.equal(await page.locator("#formula-input").inputValue(), "=B1-A1");
    await page.keyboard.press("Enter");
    await settled(page, [...cells, "B2"]);
});

test("Delete empties a cell, and the number of columns can be chosen", async () => {
    await select(page, "B2");
    await page.keyboard.press("Delete");
    await waitForState(page, "B2", "empty");
    await page.getByRole("button", { name: "One column more" }).click();
    await page.locator('[data-cell="C1"]').waitFor();
    assert.deepEqual(page.problems, []);
});
