// Builds the page: node build.mjs [--out DIR] [--watch] [--tests]
// File names are fixed, because the server's build lists the files that it embeds before they exist; the server gives each
// an ETag, so that a new build reaches browsers that hold the old one.
import { build, context } from "esbuild";
import { cp, mkdir, readdir, rm } from "node:fs/promises";
import path from "node:path";
import { fileURLToPath } from "node:url";

const here = path.dirname(fileURLToPath(import.meta.url));
const args = process.argv.slice(2);
const outAt = args.indexOf("--out");
const out = outAt >= 0 ? path.resolve(args[outAt + 1]) : path.join(here, "dist");

const page = {
    entryPoints: { app: path.join(here, "src/main.tsx") },
    bundle: true,
    outdir: out,
    format: "esm",
    target: ["es2021"],
    jsx: "automatic",
    jsxImportSource: "preact",
    minify: !args.includes("--watch"),
    sourcemap: args.includes("--watch") ? "inline" : false,
    legalComments: "none",
    logLevel: "warning",
};

async function copyStatic() {
    await mkdir(out, { recursive: true });
    await cp(path.join(here, "static"), out, { recursive: true });
}

if (args.includes("--tests")) {
    const folder = path.join(here, "dist/tests");
    await rm(folder, { recursive: true, force: true });
    const tests = (await readdir(path.join(here, "test"))).filter((name) => name.endsWith(".test.ts"));
    await build({
        entryPoints: tests.map((name) => path.join(here, "test", name)),
        bundle: true,
        outdir: folder,
        outExtension: { ".js": ".mjs" },
        platform: "node",
        format: "esm",
        target: ["node18"],
        logLevel: "warning",
    });
} else if (args.includes("--watch")) {
    await copyStatic();
    await (await context(page)).watch();
} else {
    await rm(out, { recursive: true, force: true });
    await copyStatic();
    await build(page);
}
