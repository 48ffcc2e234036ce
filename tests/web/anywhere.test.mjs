// The page below a prefix and behind a proxy on another port, as JupyterHub, Open OnDemand or `ssh -L` show it.
import assert from "node:assert/strict";
import http from "node:http";
import { after, before, test } from "node:test";
import { drag, look, openBrowser, openPage, settled } from "./page.mjs";
import { makeFolder, removeFolder, startServer, stopServer } from "./server.mjs";
import { writeBalls } from "./volumes.mjs";

const prefix = "/user/me/voxsheet";
let folder, server, browser;

before(async () => {
    folder = await makeFolder();
    server = await startServer(folder, [...(await writeBalls(folder, 2, 32)), "--base-path", prefix]);
    browser = await openBrowser();
});

after(async () => {
    await browser?.close();
    if (server) await stopServer(server);
    await removeFolder(folder);
});

/** Hands on what comes below the prefix, answers 404 to all else and remembers that. Host stays as the browser says it. */
async function startProxy(takesPrefixOff) {
    const strays = [];
    const proxy = http.createServer((request, response) => {
        if (!request.url.startsWith(`${prefix}/`)) {
            if (request.url !== "/favicon.ico") strays.push(request.url);
            response.writeHead(404).end();
            return;
        }
        const path = takesPrefixOff ? request.url.slice(prefix.length) : request.url;
        const onward = http.request({ port: server.port, host: "127.0.0.1", method: request.method, path, headers: request.headers }, (answer) => {
            response.writeHead(answer.statusCode, answer.headers);
            answer.pipe(response);
        });
        onward.on("error", () => response.destroy());
        response.on("close", () => onward.destroy());
        request.pipe(onward);
    });
    await new Promise((resolve) => proxy.listen(0, "127.0.0.1", resolve));
    return { port: proxy.address().port, strays, close: () => (proxy.closeAllConnections(), proxy.close()) };
}

for (const takesPrefixOff of [false, true]) {
    test(`a page behind a proxy that ${takesPrefixOff ? "takes the prefix off" : "keeps the prefix"} works whole`, async () => {
        const proxy = await startProxy(takesPrefixOff);
        try {
            assert.notEqual(proxy.port, server.port);
            const url = new URL(server.url);
            assert.equal(url.pathname, `${prefix}/`);
            url.port = String(proxy.port);
            const page = await openPage(browser, url.href);
            await settled(page, ["A1", "B1"]);
            const before = await look(page, "A1");
            assert.ok(before.colours > 30);
            await drag(page, "A1"); // views go out and pictures come back
            await settled(page, ["A1", "B1"]);
            assert.notEqual((await look(page, "A1")).hash, before.hash);
            // What the page offers as links lies below the prefix, too.
            await page.getByRole("button", { name: /^export/i }).click();
            const links = await page.locator("a[download]").evaluateAll((all) => all.map((each) => each.href));
            assert.ok(links.length > 0);
            for (const link of links) {
                assert.ok(link.startsWith(`http://127.0.0.1:${proxy.port}${prefix}/`), link);
                assert.equal(await page.evaluate(async (address) => (await fetch(address)).status, link), 200, link);
            }
            assert.deepEqual(page.problems, []);
            assert.deepEqual(proxy.strays, []);
            await page.context().close();
        } finally {
            proxy.close();
        }
    });
}

test("without the slash at its end the address leads to the page, token and all", async () => {
    const url = new URL(server.url);
    const page = await openPage(browser, `${url.origin}${prefix}${url.search}`);
    await settled(page, ["A1"]);
    assert.equal(new URL(page.url()).pathname, `${prefix}/`);
    await page.context().close();
});
