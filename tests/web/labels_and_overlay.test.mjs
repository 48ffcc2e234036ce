// A label map: colours per label, legend, names in the probe, hiding; and as overlay over another volume's plane.
import assert from "node:assert/strict";
import { test } from "node:test";
import { writeFile } from "node:fs/promises";
import { look, middleOf, select, setScope, settled, waitForOrigin, waitForStyle } from "./page.mjs";
import { withPage } from "./session.mjs";
import { ball } from "./volumes.mjs";

const size = 24;
let page;

/** Four slabs along x with the labels 0 to 3, 8 bits. */
function slabs() {
    const header = `NRRD0004\ntype: uint8\ndimension: 3\nsizes: ${size} ${size} ${size}\nspacings: 1 1 1\nencoding: raw\n\n`;
    return Buffer.concat([Buffer.from(header, "latin1"), Buffer.alloc(size ** 3, 0).map((_, at) => Math.floor(((at % size) * 4) / size))]);
}

withPage(
    async (folder) => {
        await writeFile(`${folder}/a_labels.nrrd`, slabs());
        await writeFile(`${folder}/b_scan.nrrd`, ball(size, [0.5, 0.5, 0.5]));
        return [`${folder}/a_labels.nrrd`, `${folder}/b_scan.nrrd`, "--columns", "2", "--set", "technique=plane"];
    },
    (made) => ({ page } = made),
    { cells: ["A1", "B1"] },
);

const picture = (cell) => page.locator(`[data-picture-of="${cell}"]`);

async function type(key, text) {
    const field = page.locator(`#key-${key.replaceAll(".", "-")}`);
    await field.fill(text);
    await field.press("Enter");
}

test("a label map has one colour for each label, a legend, and names under the pointer", async () => {
    await select(page, "A1");
    await setScope(page, "cell");
    await page.locator("#key-labels-show").selectOption("on");
    await waitForOrigin(page, "labels.show", "cell");
    await settled(page, ["A1"]);
    assert.equal((await look(page, "A1")).colours, 4, "the background and three labels, nothing between them");
    const legend = picture("A1").locator(".label-legend li");
    await legend.nth(2).waitFor();
    assert.deepEqual(await legend.allInnerTexts(), ["1", "2", "3"]);
    await type("labels.names", "1: liver; 3: spleen #ff0000");
    await legend.filter({ hasText: "spleen" }).waitFor();
    assert.deepEqual(await legend.allInnerTexts(), ["liver", "2", "spleen"]);
    const at = await middleOf(picture("A1"));
    await page.mouse.move(at.x + 50, at.y);
    await page.locator('[data-cell="A1"] .probe-chip', { hasText: /spleen \(3\)|2/ }).waitFor();
    await page.mouse.move(5, 5);
});

test("a label map is painted over another volume's plane, with its own names", async () => {
    await settled(page, ["A1", "B1"]);
    const alone = await look(page, "B1");
    await select(page, "B1");
    await setScope(page, "cell");
    await type("overlay.dataset", "A1");
    await waitForStyle(page, "B1", "overlay.dataset", "none");
    await settled(page, ["B1"]);
    assert.notEqual((await look(page, "B1")).hash, alone.hash);
    const bars = picture("B1").locator(".layer-bars");
    await bars.waitFor();
    assert.match(await bars.innerText(), /overlay\s+A1[\s\S]*liver/);
    const { x, y } = await middleOf(picture("B1"));
    await page.mouse.move(x + 30, y);
    await page.locator('[data-cell="B1"] .probe-chip', { hasText: /A1: (spleen|2|liver)/ }).waitFor();
    await page.mouse.move(5, 5);
});

test("threshold and opacity change the overlay, and its reset takes it off", async () => {
    await settled(page, ["B1"]);
    const whole = await look(page, "B1");
    await type("overlay.threshold", "3");
    await waitForStyle(page, "B1", "overlay.threshold", "none");
    await settled(page, ["B1"]);
    const part = await look(page, "B1");
    assert.notEqual(part.hash, whole.hash);
    await page.locator('[data-key="overlay.dataset"] .reset').click();
    await waitForOrigin(page, "overlay.dataset", "default");
    await picture("B1").locator(".layer-bars").waitFor({ state: "detached" });
});

test("names that are none are refused and named", async () => {
    const answer = await page.evaluate(async () => {
        const init = { method: "PATCH", headers: { "Content-Type": "application/json" }, body: '{"labels.names": "liver"}' };
        const response = await fetch("api/v1/sheets/Sheet1/cells/A1", init);
        return { status: response.status, field: (await response.json()).field };
    });
    assert.deepEqual(answer, { status: 400, field: "labels.names" });
});
