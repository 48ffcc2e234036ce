// Not a test: counts the distinct frames that the page paints in a drag over nine volumes of 128^3 at 1280x800, and how long
// after the drag the last final picture comes. Prints one JSON object per drag.
import { drag, openBrowser, openPage, settled } from "./page.mjs";
import { makeFolder, removeFolder, startServer, stopServer } from "./server.mjs";
import { writeBalls } from "./volumes.mjs";
const folder = await makeFolder();
const cells=["A1","B1","C1","A2","B2","C2","A3","B3","C3"];
const server = await startServer(folder, [...(await writeBalls(folder, 9, 128)),"--columns","3"]);
const b = await openBrowser(); const page = await openPage(b, server.url);
await settled(page, cells);
for (let k=0;k<3;++k){
 const r = await drag(page, "A1", {steps:80, stepMs:16, dx:150});
 const t0=await page.evaluate(()=>performance.now());
 await settled(page, cells);
 const last = await page.evaluate(()=>window.voxsheet.stats.recent.at(-1).at);
 console.log(JSON.stringify({fps: 1000*r.frames/r.ms, ...r, finalAfterMs:last-t0}));
}
await b.close(); await stopServer(server); await removeFolder(folder);
