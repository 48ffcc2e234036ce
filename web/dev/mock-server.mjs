// A stand-in for the server while working on the page: node dev/mock-server.mjs [--port 8090] [--cells 9] [--empty]
// Speaks the API as far as the page uses it; its pictures are made up.
import { createServer } from "node:http";
import { readFile } from "node:fs/promises";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { Book, columnName, keys, maps } from "./mock_book.mjs";
import { Levels } from "./mock_levels.mjs";
import { picture } from "./mock_pictures.mjs";

const here = path.dirname(fileURLToPath(import.meta.url));
const option = (name, fallback) => {
    const at = process.argv.indexOf(`--${name}`);
    return at >= 0 ? process.argv[at + 1] : fallback;
};
const cellCount = process.argv.includes("--empty") ? 0 : Number(option("cells", "9"));

const datasetOf = (name, i) => ({
    name, state: "ready", progress: 1, error: null, files: [`/data/${name}`], dims: [128, 128, 96 + i], spacing: [0.9, 0.9, 1.5],
    type: "i16", range: [-1024, 3071], units: { length: "mm", value: "HU" }, fields: [{ name: "density", unit: "HU", quantity: "density" }],
    steps: 1, levels: 5, format: "NRRD", notes: [], bytes: 12_345_678,
});
const datasets = Array.from({ length: cellCount }, (_, i) => datasetOf(`run${i + 1}.nrrd`, i));
const book = new Book(datasets.map((dataset) => dataset.name), Math.max(1, Math.ceil(Math.sqrt(cellCount))));
const levels = new Levels();
if (cellCount > 4) {
    book.doc.sources.C1 = "=B1-A1";
    book.doc.sources.B2 = "=B1-Z9";
}

function cellState(cell) {
    const source = book.doc.sources[cell];
    const style = book.resolve(cell);
    if (!source) return { cell, title: "", source: null, state: "empty", dataset: null, style };
    if (source.startsWith("=")) {
        const broken = source.includes("Z9");
        return { cell, title: source, source: { formula: source }, state: broken ? "error" : "ok", code: broken ? "#REF!" : "", message: broken ? "Z9 is not on this sheet. Use an address between A1 and C3." : "", dataset: null, style };
    }
    const dataset = datasets.find((entry) => entry.name === source);
    if (!dataset) return { cell, title: source, source: { dataset: source }, state: "error", code: "#REF!", message: `There is no dataset ${source}; open it, or choose another.`, dataset: null, style };
    if (dataset.state === "failed") return { cell, title: source, source: { dataset: source }, state: "error", code: "#IMPORT!", message: dataset.error.message, dataset: source, style };
    const busy = dataset.state !== "ready";
    return { cell, title: source, source: { dataset: source }, state: busy ? "importing" : "ok", progress: dataset.progress, dataset: source, orientation: cell === "A1", style };
}

const state = () => ({
    version: book.doc.version, canUndo: book.past.length > 0, canRedo: book.future.length > 0, workbook: { title: "mock" },
    sheets: [{ name: "Sheet1", rows: book.doc.rows, columns: book.doc.columns, cells: book.cells().map(cellState) }],
});

function mapOf(style) {
    return maps.find((map) => map.name === style["transfer.map"]) ?? maps[0];
}

function colourBar(cell) {
    const style = book.resolve(cell);
    const map = mapOf({ "transfer.map": style["transfer.map"].value });
    const points = Array.isArray(style["transfer.opacity"].value) ? style["transfer.opacity"].value : [[0, 0], [0.3, 0], [1, 0.4]];
    const fixed = style["range.mode"].value === "fixed";
    const low = fixed ? style["range.min"].value : -1000;
    const high = fixed ? style["range.max"].value : 2000;
    return {
        stops: map.stops.map((stop) => [...stop, 0.3]), opacity: points, low, high, scale: style["range.scale"].value, unit: "HU", quantity: "density",
        shared: style["range.mode"].value === "shared", ticks: [0, 0.5, 1].map((pos) => ({ pos, label: String(Math.round(low + pos * (high - low))) })),
    };
}

const histogram = () => ({ low: -1024, high: 3071, counts: Array.from({ length: 256 }, (_, i) => Math.round(1e5 * Math.exp(-(((i - 20) / 9) ** 2)) + 2e4 * Math.exp(-(((i - 110) / 25) ** 2)) + 300)), nan: 0 });

// --- streams ---
const streams = new Map();
let nextStream = 1;

function message(header, payload = Buffer.alloc(0)) {
    const text = Buffer.from(JSON.stringify(header));
    const prefix = Buffer.alloc(8);
    prefix.writeUInt32LE(text.length, 0);
    prefix.writeUInt32LE(payload.length, 4);
    return Buffer.concat([prefix, text, payload]);
}

const tellAll = (header) => streams.forEach((stream) => stream.response.write(message(header)));

function workbookChanged() {
    tellAll({ type: "workbook", version: book.doc.version });
    streams.forEach((stream) => {
        stream.dirty = true;
        pump(stream);
    });
}

/** At most two unacknowledged frames; while moving at half size. */
function pump(stream) {
    if (!stream.view || !stream.dirty || stream.frame - stream.acked >= 2 || stream.scheduled) return;
    stream.scheduled = setTimeout(() => {
        stream.scheduled = null;
        drawFrame(stream);
    }, 10);
}

function drawFrame(stream) {
    const { view } = stream;
    stream.dirty = false;
    const frame = ++stream.frame;
    const scale = view.moving ? 0.5 : 1;
    view.tiles.forEach((tile, i) => {
        const frameEnd = i === view.tiles.length - 1;
        const cell = cellState(tile.cell);
        if (cell.state !== "ok") {
            stream.response.write(message({ type: "cell", seq: ++stream.seq, frame, cell: tile.cell, state: cell.state, code: cell.code, message: cell.message, progress: cell.progress, frameEnd }));
            return;
        }
        const plain = Object.fromEntries(Object.entries(cell.style).map(([key, { value }]) => [key, value]));
        const style = { ...plain, ...view.style, ...view.cells?.[tile.cell] };
        const width = Math.max(1, Math.round(tile.width * scale));
        const height = Math.max(1, Math.round(tile.height * scale));
        const opacity = Array.isArray(style["transfer.opacity"]) ? style["transfer.opacity"] : [[0, 1]];
        const gain = opacity.reduce((sum, point) => sum + point[1], 0) / opacity.length;
        const image = picture(width, height, style, tile.cell.charCodeAt(0) - 65 + Number(tile.cell.slice(1)), mapOf(style).stops, gain);
        stream.response.write(message({ type: "tile", seq: ++stream.seq, frame, view: view.id, cell: tile.cell, width, height, format: "png", level: view.moving ? 1 : 0, scale, renderMs: 5, encodeMs: 1, final: !view.moving, frameEnd }, image));
    });
    stream.response.write(message({ type: "status", frameMs: 12.5, finalCells: view.moving ? 0 : view.tiles.length, cells: view.tiles.length, level: view.moving ? 1 : 0, residentBytes: 312e6, budgetBytes: 1024e6 }));
    if (stream.dirty) pump(stream);
}

function openStream(request, response) {
    const id = `s${nextStream++}`;
    const stream = { id, response, seq: 0, frame: 0, acked: 0, view: null, dirty: false, scheduled: null };
    streams.set(id, stream);
    response.writeHead(200, { "Content-Type": "application/vnd.voxsheet.stream", "Cache-Control": "no-store" });
    response.write(message({ type: "hello", stream: id, version: book.doc.version }));
    const ping = setInterval(() => response.write(message({ type: "ping" })), 5000);
    request.on("close", () => {
        clearInterval(ping);
        streams.delete(id);
    });
}

function postStream(id, body, response) {
    const stream = streams.get(id);
    if (!stream) return problem(response, 404, "There is no such stream.");
    if (body.ack !== undefined) stream.acked = Math.max(stream.acked, body.ack);
    if (body.view && (!stream.view || body.view.id > stream.view.id)) {
        stream.view = body.view;
        stream.dirty = true;
    }
    pump(stream);
    response.writeHead(204).end();
}

// --- answers ---
const types = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml" };
const csp = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src 'self'; base-uri 'none'; form-action 'none'";

function json(response, body, status = 200) {
    response.writeHead(status, { "Content-Type": "application/json", "Cache-Control": "no-store" });
    response.end(JSON.stringify(body));
}

function problem(response, status, detail, field) {
    response.writeHead(status, { "Content-Type": "application/problem+json" });
    response.end(JSON.stringify({ title: "Problem", status, detail, field }));
}

async function bodyOf(request) {
    const chunks = [];
    for await (const chunk of request) chunks.push(chunk);
    return Buffer.concat(chunks);
}

function placeDataset(name) {
    book.edit("", (doc) => {
        let free = book.cells().find((cell) => !doc.sources[cell]);
        if (!free) {
            ++doc.rows;
            free = `A${doc.rows}`;
        }
        doc.sources[free] = name;
    });
}

function importOne(name, ok) {
    const dataset = { ...datasetOf(name, 0), state: "importing", progress: 0 };
    datasets.push(dataset);
    placeDataset(name);
    workbookChanged();
    const timer = setInterval(() => {
        dataset.progress = Math.min(1, dataset.progress + 0.2);
        if (dataset.progress >= 1) {
            clearInterval(timer);
            dataset.state = ok ? "ready" : "failed";
            if (!ok) dataset.error = { kind: "ImportError", message: `${name} holds no known volume format: its first bytes are not those of any. Give a NRRD, MetaImage, NIfTI or VTK file.` };
            workbookChanged();
        }
        tellAll({ type: "datasets" });
        streams.forEach((stream) => ((stream.dirty = true), pump(stream)));
    }, 200);
}

const entries = (folder) => [
    { name: "scans", path: `${folder}/scans`, kind: "folder" },
    ...Array.from({ length: 12 }, (_, i) => ({ name: `step${i}.nrrd`, path: `${folder}/step${i}.nrrd`, kind: "file", bytes: 4e6 * (i + 1), format: "NRRD" })),
    { name: "notes.txt", path: `${folder}/notes.txt`, kind: "file", bytes: 812, format: null },
];

async function api(request, response, url) {
    const parts = url.pathname.split("/").slice(3).map(decodeURIComponent);
    const body = async () => JSON.parse((await bodyOf(request)).toString() || "{}");
    const gesture = url.searchParams.get("gesture") ?? "";
    const route = `${request.method} ${parts[0] ?? ""}`;
    const done = (answer = {}) => {
        workbookChanged();
        json(response, answer);
    };
    switch (route) {
        case "GET ": return json(response, { name: "Voxsheet", version: "mock", device: { renderer: "mock renderer", reason: "no server" }, roots: ["/data"] });
        case "GET keys": return json(response, { keys });
        case "GET colourmaps": return json(response, { maps });
        case "GET state": return json(response, state());
        case "GET workbook": return json(response, book.doc);
        case "POST workbook": return json(response, {});
        case "POST undo": return book.travel(book.past, book.future), done();
        case "POST redo": return book.travel(book.future, book.past), done();
        case "GET files":
            if (parts[1] === "preview") return json(response, { format: "NRRD", dims: [128, 128, 64], spacing: [1, 1, 2], type: "i16", bytes: 2097152 });
            return json(response, url.searchParams.get("path") ? { path: url.searchParams.get("path"), parent: "", roots: ["/data"], entries: entries(url.searchParams.get("path")) } : { path: "", parent: null, roots: ["/data"], entries: [{ name: "/data", path: "/data", kind: "folder" }] });
        case "GET datasets": return json(response, parts[2] === "histogram" ? histogram() : { datasets });
        case "POST datasets": {
            const { files } = await body();
            files.forEach((file) => importOne(path.basename(file), !file.endsWith(".txt")));
            return json(response, { datasets: files.map((file) => path.basename(file)), jobs: [] }, 202);
        }
        case "PUT datasets": {
            const bytes = await bodyOf(request);
            importOne(parts[1], bytes.subarray(0, 4).toString() === "NRRD");
            return json(response, { name: parts[1] }, 202);
        }
        case "DELETE datasets":
            datasets.splice(datasets.findIndex((dataset) => dataset.name === parts[1]), 1);
            tellAll({ type: "datasets" });
            return done();
        case "DELETE streams": return response.writeHead(204).end();
        case "POST streams": return postStream(parts[1], await body(), response);
    }
    if (parts[0] !== "sheets") return problem(response, 404, `There is no ${request.method} ${url.pathname}.`);
    const [, , what, name, leaf] = parts;
    if (what === "stream") return openStream(request, response);
    if (what === "probe") return json(response, { world: [1, 2, 3], values: book.cells().map((cell, i) => ({ cell, value: 12.5 * i, unit: "HU" })) });
    if (what === "timings") {
        const timings = levels.timings(book.cells().length);
        return json(response, request.method === "POST" ? { ...timings, measured: { n: timings.n, frames: 5 * timings.n, stopped_early: false, warning: null } } : timings);
    }
    if (what === "resolution") {
        const refused = request.method === "PATCH" ? levels.change(await body()) : null;
        return refused ? problem(response, 400, refused.detail, refused.field) : json(response, levels.settings);
    }
    if (leaf === "colourbar") return json(response, colourBar(name));
    if (request.method === "PATCH" && what === undefined) {
        const { columns } = await body();
        book.edit("", (doc) => {
            const sources = book.cells().map((cell) => doc.sources[cell]).filter(Boolean);
            doc.columns = columns;
            doc.rows = Math.max(1, Math.ceil(sources.length / columns));
            doc.sources = Object.fromEntries(sources.map((source, i) => [columnName(i % columns) + (Math.floor(i / columns) + 1), source]));
        });
        return done();
    }
    if (request.method === "PATCH") {
        const { source, title, ...style } = await body();
        if (title !== undefined) return done();
        if (source !== undefined) {
            if (source?.startsWith("=") && /[+\-*/(]$/.test(source)) return problem(response, 400, "The formula ends where a value is expected; add a cell such as A1.", "source");
            book.edit(gesture, (doc) => (source ? (doc.sources[name] = source) : delete doc.sources[name]));
            return done();
        }
        const layer = { style: "sheet", columns: "column", rows: "row", cells: "cell" }[what];
        return done(book.patch(layer, layer === "sheet" ? "" : name, style, gesture));
    }
    if (what === "clear-overrides") {
        const { keys: names, cells } = await body();
        book.edit("", (doc) => cells.forEach((cell) => [`cell ${cell}`, `row ${cell.slice(1)}`, `column ${cell[0]}`].forEach((layer) => names.forEach((key) => delete doc.styles[layer]?.[key]))));
        return done();
    }
    if (what === "view") {
        const view = await body();
        book.patch("sheet", "", view.style, "");
        return done();
    }
    return problem(response, 404, `There is no ${request.method} ${url.pathname}.`);
}

async function page(response, pathname) {
    const name = pathname === "/" ? "index.html" : path.basename(pathname);
    const file = path.join(process.env.VOXSHEET_DIST ?? path.join(here, "../dist"), name);
    try {
        const bytes = await readFile(file);
        response.writeHead(200, { "Content-Type": types[path.extname(name)] ?? "text/plain", "Content-Security-Policy": csp });
        response.end(bytes);
    } catch {
        response.writeHead(404).end();
    }
}

const server = createServer((request, response) => {
    const url = new URL(request.url, "http://mock");
    const answer = url.pathname.startsWith("/api/v1") ? api(request, response, url) : page(response, url.pathname);
    answer?.catch?.((error) => {
        console.error(error);
        if (!response.headersSent) problem(response, 500, String(error));
    });
});
server.listen(Number(option("port", "8090")), "127.0.0.1", () => console.log(`ready http://127.0.0.1:${server.address().port}/`));
