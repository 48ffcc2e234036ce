// What the tests do with the page: open it, wait for pictures, look at them.
import { createRequire } from "node:module";
import path from "node:path";
import { fileURLToPath } from "node:url";

const here = path.dirname(fileURLToPath(import.meta.url));
const packages = process.env.VOXSHEET_PAGE_PACKAGES ?? here;
const { chromium } = createRequire(path.join(packages, "package.json"))("playwright-core");

/** Pictures may take long where the machine is busy; a hang is still found. */
export const patienceMs = Number(process.env.VOXSHEET_PATIENCE_MS ?? 45_000);

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

/** Every given cell shows its final picture of the newest view and workbook: the server has said that it has nothing more to send. */
export async function settled(page, cells) {
    await waitUntil(
        page,
        (wanted) => {
            const { app, store } = window.voxsheet;
            const { tiles, page: view, connection, book } = store.get();
            const { phase, rest } = connection;
            if (phase !== "live" || !rest || view.moving || Object.keys(view.live).length > 0) return false;
            if (rest.view !== app.sender.viewTaken() || rest.version !== book.book.version) return false;
            return wanted.every((cell) => tiles[cell]?.painted && tiles[cell].final);
        },
        cells,
    );
}

/**
 * A cell's picture as it is on the canvas: size, a hash of its bytes, how many different colours it has, and how many of its
 * pixels differ from the background (that of the upper left corner).
 */
export async function look(page, cell) {
    return page.evaluate((name) => {
        const canvas = document.querySelector(`[data-picture-of="${name}"] canvas`);
        const { width, height } = canvas;
        const { data } = canvas.getContext("2d").getImageData(0, 0, width, height);
        let hash = 2166136261;
        const colours = new Set();
        let covered = 0;
        for (let i = 0; i < data.length; i += 4) {
            const colour = (data[i] << 16) | (data[i + 1] << 8) | data[i + 2];
            colours.add(colour);
            if (data[i] !== data[0] || data[i + 1] !== data[1] || data[i + 2] !== data[2]) ++covered;
            hash = Math.imul(hash ^ colour, 16777619) >>> 0;
        }
        return { width, height, hash, colours: colours.size, covered };
    }, cell);
}

/** Drags on a cell's picture in small steps, as a hand does. Returns how long it took and how many frames came meanwhile. */
export async function drag(page, cell, how = {}) {
    return dragFrom(page, await middleOf(page.locator(`[data-picture-of="${cell}"]`)), how);
}

/** In the window's coordinates; brought into sight first. */
export async function middleOf(locator) {
    await locator.scrollIntoViewIfNeeded();
    const box = await locator.boundingBox();
    return { x: box.x + box.width / 2, y: box.y + box.height / 2 };
}

/** As drag(), from a place of the page. */
export async function dragFrom(page, start, { dx = 120, dy = 40, steps = 40, stepMs = 25, button = "left", keys = [] } = {}) {
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

/** What a style key says in a cell, and which layer it comes from. */
export async function styleOf(page, cell, key) {
    return page.evaluate(
        ([name, wanted]) => {
            const { book } = window.voxsheet.store.get().book;
            return book.sheets[0].cells.find((each) => each.cell === name).style[wanted];
        },
        [cell, key],
    );
}

/** Until a style key says something else in a cell than before (as JSON). Returns what it says then. */
export async function waitForStyle(page, cell, key, before) {
    const old = JSON.stringify(before);
    await waitUntil(
        page,
        ([name, wanted, text]) => {
            const { book } = window.voxsheet.store.get().book;
            return JSON.stringify(book.sheets[0].cells.find((each) => each.cell === name).style[wanted].value) !== text;
        },
        [cell, key, old],
    );
    return (await styleOf(page, cell, key)).value;
}

/** A number that the server counts (GET /metrics). */
export async function metric(page, name) {
    return page.evaluate(async (wanted) => {
        const text = await (await fetch("metrics")).text();
        const line = text.split("\n").find((each) => each.startsWith(`${wanted} `));
        return Number(line.slice(wanted.length + 1));
    }, name);
}
