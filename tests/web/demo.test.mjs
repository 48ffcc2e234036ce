// Somebody starts the server with nothing: the page says what to do, and the demo is one press away.
import assert from "node:assert/strict";
import { test } from "node:test";
import { look, settled, waitUntil } from "./page.mjs";
import { withPage } from "./session.mjs";

let server, page;

withPage(() => [], (made) => ({ server, page } = made));

test("an empty sheet offers files from the server, an upload, and the demo", async () => {
    const empty = page.locator(".empty-state");
    await empty.waitFor();
    await empty.getByRole("button", { name: "open from the server" }).click();
    await page.getByRole("heading", { name: /open/i }).waitFor();
    assert.ok(await empty.locator('input[type="file"]').count());
});

test("the demo opens with pictures in every cell", async () => {
    await page.getByRole("button", { name: "look at the demo" }).click();
    await page.locator(".empty-state").waitFor({ state: "detached" });
    const cells = await waitUntil(page, () => {
        const all = window.voxsheet.store.get().book.book.sheets[0].cells.filter(({ state }) => state !== "empty");
        return all.length >= 9 && all.every(({ state }) => state === "ok") && all.map(({ cell }) => cell);
    });
    await settled(page, cells);
    const looks = await Promise.all(cells.map((cell) => look(page, cell)));
    looks.forEach(({ colours }, i) => assert.ok(colours > 30, `${cells[i]} has only ${colours} colours`));
    assert.ok(new Set(looks.map(({ hash }) => hash)).size > cells.length / 2);
    assert.match(await page.locator(".status-bar").innerText(), new RegExp(`${cells.length} of ${cells.length} cells final`));
    assert.deepEqual(page.problems, []);
});
