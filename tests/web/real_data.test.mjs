// Two rows of real data, as people would put them together: perfect CdTe, a vacancy and their difference with atoms and one symmetric
// range; three heads with matching planes. From the page, and by one line of `voxsheet render` each.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { existsSync, mkdirSync, readFileSync } from "node:fs";
import path from "node:path";
import { describe, test } from "node:test";
import { fileURLToPath } from "node:url";
import { look, select, setScope, settled, styleOf, typeFormula, waitForOrigin, waitForStyle, waitUntil } from "./page.mjs";
import { withPage } from "./session.mjs";

const data = process.env.VOXSHEET_DATA_DIR ?? path.join(path.dirname(fileURLToPath(import.meta.url)), "../../../shared/data");
const crystals = ["bulk_vasp_gam", "v_Cd_-2_vasp_gam"].map((name) => path.join(data, "chg_CdTe_vacancy", name, "LOCPOT.gz"));
const heads = ["vol_FullHead/FullHead.mhd", "vol_HeadMR/HeadMRVolume.mhd", "vol_headsq_quarter/quarter.nhdr"].map((name) => path.join(data, name));
const missing = [...crystals, ...heads].find((file) => !existsSync(file));
const skip = missing ? `the real data are not beside the project: no ${missing}` : false;
/** For people: where pictures of the rows go, if anywhere. */
const gallery = process.env.VOXSHEET_PAGE_PICTURES;
if (gallery) mkdirSync(gallery, { recursive: true });

const row = ["A1", "B1", "C1"];
// Of the files' sides nothing is said; one has a flag in the highest bit.
const howHeadsAreRead = ["FullHead.mhd:orientation=LPI", "FullHead.mhd:bit_mask=0x7fff", "HeadMRVolume.mhd:orientation=LPS", "quarter.nhdr:orientation=LPI"].flatMap((text) => ["--import", text]);

async function screenshot(page, name) {
    if (gallery) await page.screenshot({ path: path.join(gallery, `${name}.png`) });
}

/** One picture from the command line: its size. */
function rendered(folder, name, words) {
    const file = path.join(gallery ?? folder, name);
    const { status, stderr } = spawnSync(process.env.VOXSHEET_BINARY, ["render", ...words, "-o", file, "--store", path.join(folder, "render-store")], { encoding: "utf8" });
    assert.equal(status, 0, stderr);
    const bytes = readFileSync(file);
    assert.equal(bytes.toString("latin1", 1, 4), "PNG");
    assert.ok(bytes.length > 30_000, `${bytes.length} bytes of picture`);
    return [bytes.readUInt32BE(16), bytes.readUInt32BE(20)];
}

/** How alike two cells' pictures are: the correlation of their brightness on a coarse grid; `mirrored`: with one of them turned over. */
async function likeness(page, first, second, mirrored = false) {
    return page.evaluate(
        ([one, other, flip]) => {
            const n = 48;
            const small = (name, turned) => {
                const canvas = document.createElement("canvas");
                canvas.width = canvas.height = n;
                const context = canvas.getContext("2d");
                if (turned) {
                    context.translate(n, 0);
                    context.scale(-1, 1);
                }
                context.drawImage(document.querySelector(`[data-picture-of="${name}"] canvas`), 0, 0, n, n);
                const { data } = context.getImageData(0, 0, n, n);
                return Array.from({ length: n * n }, (_, i) => data[4 * i] + data[4 * i + 1] + data[4 * i + 2]);
            };
            const centred = (values) => {
                const mean = values.reduce((a, b) => a + b, 0) / values.length;
                return values.map((value) => value - mean);
            };
            const a = centred(small(one, false));
            const b = centred(small(other, flip));
            const dot = (u, v) => u.reduce((sum, value, i) => sum + value * v[i], 0);
            return dot(a, b) / Math.sqrt(dot(a, a) * dot(b, b));
        },
        [first, second, mirrored],
    );
}

describe("CdTe, its vacancy and their difference", { skip }, () => {
    let page, folder;
    withPage(() => [...crystals, "--root", data, "--columns", "3"], (made) => ({ page, folder } = made), { cells: ["A1", "B1"], skip });

    test("the page puts them side by side, with the vacancy in the middle, atoms, and one symmetric range", async () => {
        await typeFormula(page, "C1", "=B1-A1");
        await settled(page, row);
        await select(page, "A1");
        await setScope(page, "sheet");
        const corner = await look(page, "B1");
        for (const axis of ["x", "y", "z"]) {
            const { value } = await styleOf(page, "A1", "periodic.shift");
            const field = page.getByLabel(`periodic.shift ${axis}`, { exact: true });
            await field.fill("0.5");
            await field.press("Enter");
            await waitForStyle(page, "A1", "periodic.shift", value);
        }
        await settled(page, row);
        assert.deepEqual((await styleOf(page, "C1", "periodic.shift")).value, [0.5, 0.5, 0.5]);
        const bare = await Promise.all(row.map((cell) => look(page, cell)));
        assert.notEqual(bare[1].hash, corner.hash, "the vacancy left its corner");
        await page.locator("#key-crystal-atoms").selectOption("on");
        await waitForOrigin(page, "crystal.atoms", "sheet");
        await page.locator('[data-rescale="linked, symmetric"]').click();
        await waitUntil(page, (cells) => cells.every((cell) => window.voxsheet.store.get().book.bars[cell]?.shared), row);
        await settled(page, row);
        const bars = await page.evaluate((cells) => cells.map((cell) => window.voxsheet.store.get().book.bars[cell]), row);
        for (const bar of bars) {
            assert.deepEqual([bar.quantity, bar.unit, bar.low, bar.high], ["local potential", "eV", -bars[0].high, bars[0].high]);
            assert.ok(bar.high > 50 && bar.high < 150, `${bar.high} eV`);
        }
        const shown = await Promise.all(row.map((cell) => look(page, cell)));
        shown.forEach((each, i) => assert.ok(each.covered > bare[i].covered, `${row[i]} shows atoms`));
        assert.notEqual(shown[0].hash, shown[1].hash);
        assert.deepEqual(page.problems, []);
        await screenshot(page, "cdte_page");
    });

    test("one line of render does, too", () => {
        const style = ["periodic.shift=.5,.5,.5", "crystal.atoms=on", "range.mode=shared", "range.symmetric=on"].flatMap((text) => ["--set", text]);
        assert.deepEqual(rendered(folder, "cdte_line.png", [...crystals, "=B1-A1", "--columns", "3", "--size", "1500x560", ...style]), [1500, 560]);
    });
});

describe("Three heads", { skip }, () => {
    let page, folder;
    const grey = ["transfer.map=grey", "range.mode=percentile", "range.min=3", "range.max=99.7"].flatMap((text) => ["--set", text]);
    withPage(() => [...heads, "--root", data, "--columns", "3", ...howHeadsAreRead, ...grey], (made) => ({ page, folder } = made), { cells: row, skip });
    const planes = [2, 3, 4].flatMap((line) => ["A", "B", "C"].map((column) => `${column}${line}`));

    test("planes of all three stand below their volumes, and match", async () => {
        await select(page, "A1");
        await page.locator('[data-title-of="C1"]').click({ modifiers: ["Shift"] });
        await page.keyboard.press("p");
        await page.locator('[data-cell="C4"][data-state="ok"]').waitFor();
        await settled(page, [...row, ...planes]);
        for (const [line, axis] of [[2, "axial"], [3, "coronal"], [4, "sagittal"]]) {
            for (const column of ["A", "B", "C"]) assert.equal((await styleOf(page, `${column}${line}`, "plane.axis")).value, axis);
            // The CT heads are one person, at all samples and at a quarter (whose header has another aspect): no mirror images.
            const same = await likeness(page, `A${line}`, `C${line}`);
            const mirrored = await likeness(page, `A${line}`, `C${line}`, true);
            assert.ok(same > 0.7, `${axis}: ${same}`);
            assert.ok(same > mirrored + 0.02, `${axis}: ${same}, mirrored ${mirrored}`);
        }
        assert.ok((await likeness(page, "A1", "C1")) > 0.85, "and so are the volumes");
        await screenshot(page, "heads_page");
    });

    test("a click on one plane moves the others of all heads", async () => {
        const before = await Promise.all(planes.map((cell) => look(page, cell)));
        const { value } = await styleOf(page, "A1", "plane.crosshair");
        const picture = page.locator('[data-picture-of="A2"]');
        await picture.scrollIntoViewIfNeeded();
        const box = await picture.boundingBox();
        await picture.click({ position: { x: 0.5 * box.width, y: 0.4 * box.height } });
        await waitForStyle(page, "A1", "plane.crosshair", value);
        await settled(page, [...row, ...planes]);
        const after = await Promise.all(planes.map((cell) => look(page, cell)));
        const moved = planes.filter((_, i) => after[i].hash !== before[i].hash);
        assert.deepEqual(moved, ["A3", "B3", "C3"], "the coronal ones");
        assert.ok((await likeness(page, "A3", "C3")) > 0.7, "to the same place");
        assert.deepEqual(page.problems, []);
    });

    test("one line of render does, too", () => {
        const words = [...heads, "--columns", "3", "--planes", "--size", "1200x1500", ...howHeadsAreRead, ...grey];
        assert.deepEqual(rendered(folder, "heads_line.png", words), [1200, 1500]);
    });
});
