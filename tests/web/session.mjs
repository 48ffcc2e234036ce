// What the files of tests have in common: a server, a browser and a page on it.
import { after, before } from "node:test";
import { openBrowser, openPage, select, setScope, settled } from "./page.mjs";
import { makeFolder, removeFolder, startServer, stopServer } from "./server.mjs";

/**
 * Before the first test of a file: starts a server in a folder of its own with the words that `prepare(folder)` gives, opens its page,
 * and waits for the cells' pictures. After the last one all of it goes again.
 * \param take  gets { folder, server, browser, page }
 * \param options  cells: to wait for; scope: to edit in from the first cell on; context: of the browser; skip: nothing is started
 */
export function withPage(prepare, take, { cells = [], scope = null, context = {}, skip = false } = {}) {
    if (skip) return;
    let folder, server, browser;
    before(async () => {
        folder = await makeFolder();
        server = await startServer(folder, await prepare(folder));
        browser = await openBrowser();
        const page = await openPage(browser, server.url, context);
        take({ folder, server, browser, page });
        if (cells.length > 0) await settled(page, cells);
        if (!scope) return;
        await select(page, cells[0]);
        await setScope(page, scope);
    });
    after(async () => {
        await browser?.close();
        if (server) await stopServer(server);
        if (folder) await removeFolder(folder);
    });
}
