// Measures how many scans open at once: COUNT volumes of DIM^3 on disk, named on the command line of a fresh server with an
// empty store, with the page open in Chromium from the first moment. Prints one JSON object; all times in ms.
//   ready, firstImport, lastImport, allFinal: since the program's start
//   firstPicture: from the end of the first import until the page has painted a picture
//   pageGap: longest time in which the page's event loop did not turn while files came in; api, image: latency of requests meanwhile
import { createWriteStream } from "node:fs";
import { once } from "node:events";
import { openBrowser, openPage } from "./page.mjs";
import { makeFolder, removeFolder, startServer, stopServer } from "./server.mjs";

const count = Number(process.env.COUNT ?? 40);
const dim = Number(process.env.DIM ?? 256);

/** A ball with a little noise in slabs, so that no two files, bricks or bytes are alike. */
async function writeScan(file, seed) {
    const out = createWriteStream(file);
    out.write(`NRRD0004\ntype: uint8\ndimension: 3\nsizes: ${dim} ${dim} ${dim}\nspacings: 1 1 1\nencoding: raw\n\n`);
    const bell = (centre) => Float64Array.from({ length: dim }, (_, i) => Math.exp(-(((i / dim - centre) / 0.22) ** 2)));
    const [x, y, z] = [bell(0.5 + 0.1 * Math.cos(seed)), bell(0.5 + 0.1 * Math.sin(seed)), bell(0.5)];
    let noise = seed + 1;
    for (let k = 0; k < dim; ++k) {
        const slice = Buffer.allocUnsafe(dim * dim);
        let at = 0;
        for (let j = 0; j < dim; ++j) {
            const peak = 230 * y[j] * z[k];
            for (let i = 0; i < dim; ++i) {
                noise = (Math.imul(noise, 1664525) + 1013904223) >>> 0;
                slice[at++] = peak * x[i] + (noise >>> 28);
            }
        }
        if (!out.write(slice)) await once(out, "drain");
    }
    out.end();
    await once(out, "finish");
}

const sleep = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
const quantile = (values, part) => Math.round([...values].sort((a, b) => a - b)[Math.min(values.length - 1, Math.floor(part * values.length))] ?? 0);

/** Latencies of a request that is repeated until told to stop. */
function repeat(url, everyMs) {
    const times = [];
    let running = true;
    const done = (async () => {
        while (running) {
            const start = performance.now();
            await (await fetch(url())).arrayBuffer();
            times.push(performance.now() - start);
            await sleep(everyMs);
        }
    })();
    return { times, stop: () => ((running = false), done) };
}

const folder = await makeFolder();
let server, browser;
try {
    const files = [];
    for (let i = 0; i < count; ++i) {
        files.push(`${folder}/scan${i + 1}.nrrd`);
        await writeScan(files[i], i);
        process.stderr.write(`\rwritten ${i + 1} of ${count}`);
    }
    process.stderr.write("\n");
    browser = await openBrowser();
    const start = performance.now();
    const since = () => Math.round(performance.now() - start);
    server = await startServer(folder, files);
    const ready = since();
    const { origin, search } = new URL(server.url);
    const state = async () => (await (await fetch(`${origin}/api/v1/datasets${search}`)).json()).datasets;
    let [firstImport, lastImport] = [0, 0];
    const imports = (async () => {
        while (!lastImport) {
            const all = await state();
            const ended = all.filter((each) => each.state === "ready" || each.state === "failed").length;
            if (all.some((each) => each.state === "failed")) throw new Error(all.find((each) => each.error).error.message);
            if (ended > 0 && !firstImport) firstImport = since();
            if (ended === count) lastImport = since();
            await sleep(10);
        }
    })();
    const api = repeat(() => `${origin}/api/v1/state${search}&styles=own`, 50);
    const page = await openPage(browser, server.url);
    const pageOpen = since();
    await page.evaluate(() => {
        window.gaps = [];
        let last = performance.now();
        const turn = () => {
            const now = performance.now();
            window.gaps.push(now - last);
            last = now;
            setTimeout(turn, 0);
        };
        turn();
    });
    let firstPainted = 0;
    while (!firstPainted) {
        const painted = await page.evaluate(() => Object.values(window.voxsheet?.store.get().tiles ?? {}).some((tile) => tile.painted));
        if (painted) firstPainted = since();
        else await sleep(10);
    }
    let turn = 0;
    const image = repeat(() => `${origin}/api/v1/sheets/Sheet1/cells/A1/image.jpg${search}&width=128&height=128&camera.azimuth=${(turn += 7)}`, 100);
    await imports;
    const gaps = await page.evaluate(() => window.gaps);
    await Promise.all([api.stop(), image.stop()]);
    for (;;) {
        const settled = await page.evaluate(() => {
            const { connection, tiles } = window.voxsheet.store.get();
            return connection.rest && Object.values(tiles).every((tile) => !tile.painted || tile.final);
        });
        if (settled) break;
        await sleep(50);
    }
    console.log(
        JSON.stringify({
            count, dim, ready, pageOpen, firstImport, lastImport,
            firstPicture: firstPainted - firstImport,
            allFinal: since(),
            pageGap: Math.round(Math.max(...gaps)),
            api: { p50: quantile(api.times, 0.5), p95: quantile(api.times, 0.95), max: quantile(api.times, 1) },
            image: { p50: quantile(image.times, 0.5), p95: quantile(image.times, 0.95), max: quantile(image.times, 1) },
        }),
    );
} finally {
    await browser?.close();
    if (server) await stopServer(server);
    await removeFolder(folder);
}
