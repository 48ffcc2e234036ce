// Runs the page's tests, or says why they cannot run (exit code 77: skipped).
import { spawnSync } from "node:child_process";
import { existsSync, readdirSync } from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";

const here = path.dirname(fileURLToPath(import.meta.url));
const skipCode = 77;

function skip(why) {
    console.log(`skipped: ${why}`);
    process.exit(skipCode);
}

const binary = process.env.VOXSHEET_BINARY ?? "";
if (!process.env.VOXSHEET_SERVER_COMMAND && !existsSync(binary)) skip(`there is no server to test (${binary || "VOXSHEET_BINARY is not set"})`);

const chromiums = [process.env.VOXSHEET_CHROMIUM, "/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"];
const chromium = chromiums.find((program) => program && existsSync(program));
if (!chromium) skip("there is no Chromium; install it (Debian: apt-get install chromium) or set VOXSHEET_CHROMIUM");

const packages = process.env.VOXSHEET_PAGE_PACKAGES ?? here;
if (!existsSync(path.join(packages, "node_modules/playwright-core"))) skip("playwright-core is not installed; npm ci in tests/web installs it");

const data = process.env.VOXSHEET_NEEDED_DATA;
if (data && !existsSync(data)) skip(`the real data are not beside the project: no ${data}`);

const tests = process.argv.slice(2).length
    ? process.argv.slice(2)
    : readdirSync(here).filter((name) => name.endsWith(".test.mjs")).sort().map((name) => path.join(here, name));
const { status } = spawnSync(process.execPath, ["--test", "--test-concurrency=1", ...tests], {
    stdio: "inherit",
    env: { ...process.env, VOXSHEET_CHROMIUM: chromium },
});
process.exit(status ?? 1);
