// Crystals on the page: a perfect one, one with a vacancy and their difference under one symmetric range; atoms; hkl planes;
// pictures of one cell with all that stands on it.
import assert from "node:assert/strict";
import { test } from "node:test";
import { writeFile } from "node:fs/promises";
import { look, middleOf, settled, styleOf, waitForOrigin, waitForStyle, waitUntil } from "./page.mjs";
import { withPage } from "./session.mjs";

const cells = ["A1", "B1", "C1"];
let page;

/** A LOCPOT of 16^3 samples in a cube of 4 Å: a well at each atom. */
function potential(sites) {
    const n = 16;
    const list = sites.map(({ at }) => at.join(" ")).join("\n");
    const count = (name) => sites.filter(({ element }) => element === name).length;
    const kinds = ["Cd", "Te"].filter((name) => count(name) > 0);
    const values = [];
    const near = (a, b) => Math.min(Math.abs(a - b), 1 - Math.abs(a - b));
    for (let z = 0; z < n; ++z)
        for (let y = 0; y < n; ++y)
            for (let x = 0; x < n; ++x) {
                const place = [x / n, y / n, z / n];
                const depth = sites.map(({ at }) => Math.exp(-place.reduce((sum, part, i) => sum + near(part, at[i]) ** 2, 0) / 0.15 ** 2));
                values.push((-50 * depth.reduce((a, b) => a + b, 0)).toFixed(5));
            }
    return `test\n1.0\n4 0 0\n0 4 0\n0 0 4\n${kinds.join(" ")}\n${kinds.map(count).join(" ")}\nDirect\n${list}\n\n${n} ${n} ${n}\n${values.join("\n")}\n`;
}

const cadmium = { element: "Cd", at: [0, 0, 0] };
const tellurium = { element: "Te", at: [0.5, 0.5, 0.25] };

withPage(
    async (folder) => {
        await writeFile(`${folder}/LOCPOT_bulk`, potential([cadmium, tellurium]));
        await writeFile(`${folder}/LOCPOT_vacancy`, potential([tellurium]));
        return [`${folder}/LOCPOT_bulk`, `${folder}/LOCPOT_vacancy`, "=B1-A1", "--columns", "3", "--set", "periodic.shift=.5,.5,.5"];
    },
    (made) => ({ page } = made),
    { cells, scope: "sheet" },
);

const valueOf = async (cell, key) => (await styleOf(page, cell, key)).value;
const bars = () => page.evaluate((names) => names.map((name) => window.voxsheet.store.get().book.bars[name]), cells);

async function type(label, text) {
    const field = page.getByLabel(label, { exact: true });
    await field.fill(text);
    await field.press("Enter");
}

test("a difference has its parents' quantity and unit, and shares a symmetric range with them", async () => {
    await page.locator('[data-rescale="linked, symmetric"]').click();
    assert.equal(await waitForStyle(page, "A1", "range.mode", "auto"), "shared");
    assert.equal(await valueOf("A1", "range.symmetric"), "on");
    await waitUntil(page, () => ["A1", "B1", "C1"].every((cell) => window.voxsheet.store.get().book.bars[cell]?.shared));
    for (const bar of await bars()) {
        assert.equal(bar.quantity, "local potential");
        assert.equal(bar.unit, "eV");
        assert.equal(bar.low, -bar.high);
        // Of -50 eV at the wells, without a few extreme samples.
        assert.ok(bar.high > 40 && bar.high <= 51, `${bar.high}`);
        assert.equal(bar.high, (await bars())[0].high);
    }
    await page.locator('[data-rescale="data"]').click();
    assert.equal(await waitForStyle(page, "A1", "range.mode", "shared"), "own");
    assert.equal(await valueOf("A1", "range.symmetric"), "off");
});

test("the crystal group shows atoms and the cell in every picture of a crystal", async () => {
    await settled(page, cells);
    const before = await Promise.all(cells.map((cell) => look(page, cell)));
    const group = page.locator(".key-group", { has: page.locator("#key-crystal-atoms") });
    await group.locator("#key-crystal-atoms").selectOption("on");
    await waitForOrigin(page, "crystal.atoms", "sheet");
    await settled(page, cells);
    const atoms = await Promise.all(cells.map((cell) => look(page, cell)));
    atoms.forEach(({ hash }, i) => assert.notEqual(hash, before[i].hash, `${cells[i]} shows atoms`));
    await group.locator("#key-crystal-cell").selectOption("on");
    await waitForOrigin(page, "crystal.cell", "sheet");
    await settled(page, cells);
    for (const [i, cell] of cells.entries()) assert.notEqual((await look(page, cell)).hash, atoms[i].hash, `${cell} shows the unit cell`);
});

test("the pointer names the atom under it", async () => {
    // Tellurium alone is left in the middle of the vacancy's cell, which the shift moved there from its corner in z.
    const picture = page.locator('[data-picture-of="B1"]');
    const box = await picture.boundingBox();
    let seen = "";
    for (let y = 0.2; y < 0.9 && !/^Te/.test(seen); y += 0.04) {
        for (let x = 0.3; x < 0.75 && !/^Te/.test(seen); x += 0.04) {
            const found = await page.evaluate(
                async ([px, py, width, height]) =>
                    (await (await fetch(`api/v1/sheets/Sheet1/probe?cell=B1&px=${px}&py=${py}&width=${width}&height=${height}`)).json()).values,
                [x * box.width, y * box.height, Math.round(box.width), Math.round(box.height)],
            );
            if (found.find(({ cell, atom }) => cell === "B1" && atom === "Te")) {
                await page.mouse.move(box.x + x * box.width, box.y + y * box.height);
                await page.mouse.move(box.x + x * box.width + 1, box.y + y * box.height);
                await picture.locator(".probe-chip").waitFor();
                seen = await picture.locator(".probe-chip").textContent();
            }
        }
    }
    assert.match(seen, /^Te · -?[−\d]/);
});

test("planes of Miller indices face their normal, and the wheel steps from lattice plane to lattice plane", async () => {
    await page.locator("#key-technique").selectOption("plane");
    await page.locator("#key-plane-axis").selectOption("hkl");
    await waitForOrigin(page, "plane.axis", "sheet");
    await settled(page, cells);
    const first = await look(page, "A1");
    assert.deepEqual(await valueOf("A1", "plane.hkl"), [1, 1, 1]);
    await type("plane.hkl z", "0");
    await waitForOrigin(page, "plane.hkl", "sheet");
    await settled(page, cells);
    const oblique = await look(page, "A1");
    assert.notEqual(oblique.hash, first.hash);
    const start = await valueOf("A1", "plane.position");
    const at = await middleOf(page.locator('[data-picture-of="A1"]'));
    await page.mouse.move(at.x, at.y);
    await page.mouse.wheel(0, -100);
    const stepped = await waitForStyle(page, "A1", "plane.position", start);
    assert.ok(stepped > start && stepped < start + 0.2, `${start} to ${stepped}`);
    assert.equal(await valueOf("B1", "plane.position"), stepped, "linked");
    await settled(page, cells);
    assert.notEqual((await look(page, "A1")).hash, oblique.hash);
});

/** What a picture's pixels say: its size, a hash, and how many are the crosshair's yellow. */
async function fetched(query) {
    return page.evaluate(async (text) => {
        const answer = await fetch(`api/v1/sheets/Sheet1/cells/A1/image.png?width=400&height=300&${text}`);
        if (!answer.ok) return { status: answer.status };
        const bitmap = await createImageBitmap(await answer.blob());
        const canvas = document.createElement("canvas");
        canvas.width = bitmap.width;
        canvas.height = bitmap.height;
        const context = canvas.getContext("2d");
        context.drawImage(bitmap, 0, 0);
        const { data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
        let yellow = 0;
        let hash = 0;
        for (let i = 0; i < data.length; i += 4) {
            if (data[i] > 150 && data[i + 1] > 120 && data[i + 2] < 110 && data[i] - data[i + 2] > 80) ++yellow;
            hash = (Math.imul(hash, 31) + data[i] * 65536 + data[i + 1] * 256 + data[i + 2]) | 0;
        }
        return { status: answer.status, width: bitmap.width, height: bitmap.height, yellow, hash };
    }, query);
}

test("a picture of one cell comes bare, or with its crosshair, colour bar, orientation and name", async () => {
    const plane = "technique=plane&plane.axis=axial&transfer.map=grey&crystal.atoms=off&plane.crosshair=.4,.4,.4";
    const bare = await fetched(plane);
    const annotated = await fetched(`${plane}&annotate=true`);
    assert.equal(bare.status, 200);
    assert.deepEqual([annotated.width, annotated.height], [400, 300]);
    assert.equal(bare.yellow, 0);
    assert.ok(annotated.yellow > 300, `${annotated.yellow} pixels of the crosshair's lines`);
    // Without a crosshair, what is left is bar, axes and name.
    const named = await fetched(`${plane.replace(/&plane.crosshair.*/, "")}&annotate=true&plane.crosshair=none`);
    assert.ok(named.yellow < 100, `${named.yellow}`);
    const none = await fetched(`${plane}&annotate=true&annotations=none`);
    assert.equal(none.yellow, 0);
    const volume = await fetched("technique=raycast&transfer.map=grey&crystal.atoms=off&plane.crosshair=.5,.5,.5&annotate=true");
    assert.ok(volume.yellow > 50, `${volume.yellow} pixels of the crosshair's three lines in a volume`);
    assert.equal((await fetched("annotate=maybe")).status, 400);
    assert.deepEqual(page.problems, []);
});
