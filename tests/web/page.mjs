// What the tests do with the page: open it, wait for pictures, look at them.
import { createRequire } from "node:module";
import path from "node:path";
import { fileURLToPath } from "node:url";

const here = path.dirname(fileURLToPath(import.meta.url));
const packages = process.env.VOXSHEET_PAGE_PACKAGES ?? here;
const { chromium } = createRequire(path.join(packages, "package.json"))("playwright-core");

/** Pictures may take long where the machine is busy; a hang is still found. */
export const patienceMs = 45_000;

export async function openBrowser() {
    return chromium.launch({
        executablePath: process.env.VOXSHEET_CHROMIUM,
        args: ["--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage"],
    });
}

/** A page with its problems collected in page.problems: exceptions, and requests that the content policy refused. */
export async function openPage(browser, url, options = {}) {
    const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, ...options });
    const page = await context.newPage();
    page.setDefaultTimeout(patienceMs);
    page.problems = [];
    page.on("pageerror", (error) => page.problems.push(String(error)));
    page.on("console", (message) => {
        if (/Content Security Policy|is not defined|Uncaught/.test(message.text())) page.problems.push(message.text());
    });
    await page.goto(url);
    return page;
}

/** Polls from outside: the page's content policy forbids what playwright's own waitForFunction does. Returns the first true value. */
export async function waitUntil(page, condition, argument) {
    const end = Date.now() + patienceMs;
    for (;;) {
        const value = await page.evaluate(condition, argument);
        if (value) return value;
        if (Date.now() > end) {
            const state = await page.evaluate(() => JSON.stringify({ tiles: window.voxsheet.store.get().tiles, connection: window.voxsheet.store.get().connection.phase }));
            throw new Error(`waited ${patienceMs} ms in vain for ${condition} of ${JSON.stringify(argument)}; the page has ${state}`);
        }
        await page.waitForTimeout(50);
    }
}

/** Every given cell shows its final picture, the server knows the newest view, and nothing has come for a while. */
export async function settled(page, cells) {
    await waitUntil(
        page,
        (wanted) => {
            const { stats, app, store } = window.voxsheet;
            const { tiles, page: view, connection } = store.get();
            const said = app.sender.idleSince();
            if (connection.phase !== "live" || view.moving || said === null) return false;
            // Longer than the server waits before it draws final pictures, with room for a busy machine.
            const quietMs = performance.now() - Math.max(said, stats.recent.at(-1)?.at ?? 0);
            return quietMs > 700 && wanted.every((cell) => tiles[cell]?.painted && tiles[cell].final);
        },
        cells,
    );
}

/** A cell's picture as it is on the canvas: size, a hash of its bytes, and how many different colours it has. */
export async function look(page, cell) {
    return page.evaluate((name) => {
        const canvas = document.querySelector(`[data-picture-of="${name}"] canvas`);
        const { width, height } = canvas;
        const { data } = canvas.getContext("2d").getImageData(0, 0, width, height);
        let hash = 2166136261;
        const colours = new Set();
        for (let i = 0; i < data.length; i += 4) {
            const colour = (data[i] << 16) | (data[i + 1] << 8) | data[i + 2];
            colours.add(colour);
            hash = Math.imul(hash ^ colour, 16777619) >>> 0;
        }
        return { width, height, hash, colours: colours.size };
    }, cell);
}

/** Drags on a cell's picture in small steps, as a hand does. Returns how long it took and how many frames came meanwhile. */
export async function drag(page, cell, { dx = 120, dy = 40, steps = 40, stepMs = 25, button = "left", keys = [] } = {}) {
    const box = await page.locator(`[data-picture-of="${cell}"]`).boundingBox();
    const start = { x: box.x + box.width / 2, y: box.y + box.height / 2 };
    await page.mouse.move(start.x, start.y);
    for (const key of keys) await page.keyboard.down(key);
    const began = await page.evaluate(() => performance.now());
    await page.mouse.down({ button });
    for (let i = 1; i <= steps; ++i) {
        await page.mouse.move(start.x + (dx * i) / steps, start.y + (dy * i) / steps);
        await page.waitForTimeout(stepMs);
    }
    const during = await page.evaluate(
        (time) => ({ frames: window.voxsheet.stats.framesSince(time), ms: performance.now() - time }),
        began,
    );
    await page.mouse.up({ button });
    for (const key of keys) await page.keyboard.up(key);
    return during;
}

export async function select(page, cell) {
    await page.locator(`[data-title-of="${cell}"]`).click();
}

export async function setScope(page, scope) {
    await page.locator(`[data-scope="${scope}"]`).click();
}

export async function chooseMap(page, name) {
    await page.locator(".map-button").click();
    await page.locator(`[data-map="${name}"]`).click();
}

/** The origin chip of a key in the inspector. */
export async function originOf(page, key) {
    return page.locator(`[data-key="${key}"]`).getAttribute("data-origin");
}

export async function waitForOrigin(page, key, origin) {
    await page.locator(`[data-key="${key}"][data-origin="${origin}"]`).waitFor();
}

export async function waitForState(page, cell, state) {
    await page.locator(`[data-cell="${cell}"][data-state="${state}"]`).waitFor();
}

export async function typeFormula(page, cell, text) {
    await select(page, cell);
    await page.keyboard.press("F2");
    await page.locator("#formula-input").fill(text);
    await page.keyboard.press("Enter");
}
