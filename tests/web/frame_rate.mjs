// Not a test: counts the distinct frames that the page paints in a drag at 1280x800, and how long after the drag the last
// final picture comes. Prints one JSON object per drag.
// Environment: CELLS (9) and DIM (128): the sheet, as square as can be; DRAGS (3); KEEP: a folder that keeps volumes and store for
// the next run; PROFILE: a file that gets the page's CPU profile of all drags; PICTURE: a file that gets a screenshot at rest.
import { existsSync } from "node:fs";
import { mkdir, writeFile } from "node:fs/promises";
import { drag, openBrowser, openPage, settled, waitUntil } from "./page.mjs";
import { makeFolder, removeFolder, startServer, stopServer } from "./server.mjs";
import { writeBalls } from "./volumes.mjs";

const { CELLS = "9", DIM = "128", DRAGS = "3", KEEP, PROFILE, PICTURE } = process.env;
const count = Number(CELLS);
const columns = Math.ceil(Math.sqrt(count));
const cells = Array.from({ length: count }, (_, i) => String.fromCharCode(65 + (i % columns)) + (1 + Math.floor(i / columns)));

async function volumes(folder) {
    const files = cells.map((_, i) => `${folder}/ball${i + 1}.nrrd`);
    return files.every((file) => existsSync(file)) ? files : writeBalls(folder, count, Number(DIM));
}

function inView(page) {
    return page.evaluate((names) => {
        const area = document.querySelector(`[data-cell="${names[0]}"]`)?.closest(".grid-scroll");
        const { bottom, right } = area?.getBoundingClientRect() ?? { bottom: 0, right: 0 };
        const boxes = names.map((name) => document.querySelector(`[data-cell="${name}"]`)?.getBoundingClientRect());
        return boxes.filter((box) => box && box.bottom <= bottom + 1 && box.right <= right + 1).length;
    }, cells);
}

/** The whole sheet is in view, every cell as fine as it gets. */
async function ready(page) {
    await waitUntil(page, () => window.voxsheet.store.get().book.book?.sheets[0].cells.length);
    for (let step = 0; step < 8 && (await inView(page)) < count; ++step) {
        await page.keyboard.press("Shift+Z");
        await page.waitForTimeout(300);
    }
    if ((await inView(page)) < count) throw new Error(`the window does not hold ${count} cells`);
    for (;;) {
        try {
            await settled(page, cells);
            return;
        } catch (error) {
            if (!String(error).includes("importing")) throw error;
        }
    }
}

const folder = KEEP ?? (await makeFolder());
await mkdir(folder, { recursive: true });
const budgets = count > 9 ? ["--texture-budget", "1G", "--memory-budget", "2G"] : [];
const server = await startServer(folder, [...(await volumes(folder)), "--columns", String(columns), ...budgets]);
const browser = await openBrowser();
try {
    const page = await openPage(browser, server.url);
    await ready(page);
    const session = await page.context().newCDPSession(page);
    if (PROFILE) {
        await session.send("Profiler.enable");
        await session.send("Profiler.start");
    }
    for (let k = 0; k < Number(DRAGS); ++k) {
        const during = await drag(page, "A1", { steps: 80, stepMs: 16, dx: 150 });
        const released = await page.evaluate(() => performance.now());
        await settled(page, cells);
        const { last, scale, level } = await page.evaluate((time) => {
            const { recent } = window.voxsheet.stats;
            const moving = recent.filter((each) => !each.final).slice(-64);
            const middle = (values) => values.sort((a, b) => a - b)[values.length >> 1];
            return { last: recent.at(-1).at, scale: middle(moving.map((each) => each.scale)), level: middle(moving.map((each) => each.level)) };
        }, released);
        console.log(JSON.stringify({ fps: (1000 * during.frames) / during.ms, ...during, scale, level, finalAfterMs: last - released }));
    }
    if (PROFILE) await writeFile(PROFILE, JSON.stringify((await session.send("Profiler.stop")).profile));
    if (PICTURE) await page.screenshot({ path: PICTURE });
} finally {
    await browser.close();
    await stopServer(server);
    if (!KEEP) await removeFolder(folder);
}
