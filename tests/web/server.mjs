// Starts and stops the real server: VOXSHEET_BINARY, one process per call, on a port of its own.
import { spawn } from "node:child_process";
import { mkdtemp, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import path from "node:path";

const readyMs = 60_000;
export const token = "page-tests-token";

export async function makeFolder() {
    return mkdtemp(path.join(tmpdir(), "voxsheet-page-"));
}

export async function removeFolder(folder) {
    await rm(folder, { recursive: true, force: true });
}

/** Resolves when the server has printed its ready line. folder: store, uploads and root. */
export function startServer(folder, files, port = 0) {
    const stateFolder = path.join(folder, ".server");
    const args = [
        "serve", ...files, "--port", String(port), "--token", token, "--root", folder,
        "--store", path.join(stateFolder, "store"), "--upload-dir", path.join(stateFolder, "uploads"),
    ];
    const [program, ...before] = (process.env.VOXSHEET_SERVER_COMMAND ?? process.env.VOXSHEET_BINARY).split(" ");
    const child = spawn(program, [...before, ...args], { stdio: ["ignore", "pipe", "pipe"] });
    const log = [];
    child.stderr.on("data", (data) => log.push(String(data)));
    return new Promise((resolve, reject) => {
        let out = "";
        const fail = (why) => {
            clearTimeout(timer);
            child.kill("SIGKILL");
            reject(new Error(`${why}\n${log.join("")}`));
        };
        const timer = setTimeout(() => fail("the server printed no ready line"), readyMs);
        child.once("error", (error) => fail(String(error)));
        child.once("exit", (code, signal) => fail(`the server ended with ${code ?? signal} before it was ready`));
        child.stdout.on("data", (data) => {
            out += data;
            const found = /^ready (\S+)/m.exec(out);
            if (!found) return;
            clearTimeout(timer);
            child.removeAllListeners("exit");
            resolve({ child, url: found[1], port: Number(new URL(found[1]).port), log });
        });
    });
}

/** SIGTERM, as a user would; the server promises to end within 2 s. */
export async function stopServer(server) {
    const { child } = server;
    if (child.exitCode !== null || child.signalCode !== null) return;
    const ended = new Promise((resolve) => child.once("exit", resolve));
    child.kill("SIGTERM");
    const timer = setTimeout(() => child.kill("SIGKILL"), 5_000);
    await ended;
    clearTimeout(timer);
}
