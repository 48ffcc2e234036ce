import assert from "node:assert/strict";
import { test } from "node:test";
import type { FileEntry } from "../src/api/types";
import { allChosen, countFiles, extendedTo, fileRows, nothingChosen, openRequests, suggestedAs, toggled } from "../src/model/file_choice";

const file = (name: string): FileEntry => ({ name, path: `/d/${name}`, kind: "file" });
const frames = ["f_1.tif", "f_2.tif", "f_10.tif"].map(file);
const series: FileEntry = { name: "f_[1-10].tif", path: "/d/f_1.tif", kind: "file", files: frames.map((each) => each.path) };
const entries: FileEntry[] = [{ name: "sub", path: "/d/sub", kind: "folder" }, file("a.nrrd"), series, ...frames, file("z.nrrd")];
const keys = (expanded: string[] = [], filter = ""): string[] => fileRows(entries, new Set(expanded), filter).map((row) => row.key);

test("a numbered series is one line, and its files come out when it is expanded", () => {
    assert.deepEqual(keys(), ["/d/sub", "/d/a.nrrd", "series /d/f_1.tif", "/d/z.nrrd"]);
    assert.deepEqual(keys(["/d/f_1.tif"]).slice(2, 6), ["series /d/f_1.tif", "/d/f_1.tif", "/d/f_2.tif", "/d/f_10.tif"]);
    // A filter that only a member fulfils shows it alone.
    assert.deepEqual(keys([], "f_10"), ["/d/f_10.tif"]);
    assert.deepEqual(keys([], "NRRD"), ["/d/a.nrrd", "/d/z.nrrd"]);
});

test("ranges begin at the anchor, leave folders out and can shrink again", () => {
    const rows = fileRows(entries, new Set(), "");
    let choice = toggled(nothingChosen, "/d/a.nrrd");
    choice = extendedTo(choice, rows, "/d/z.nrrd");
    assert.deepEqual([...choice.chosen], ["/d/a.nrrd", "series /d/f_1.tif", "/d/z.nrrd"]);
    choice = extendedTo(choice, rows, "series /d/f_1.tif");
    assert.deepEqual([...choice.chosen], ["/d/a.nrrd", "series /d/f_1.tif"]);
    choice = extendedTo(choice, rows, "/d/sub");
    assert.deepEqual([...choice.chosen], ["/d/a.nrrd"]);
    assert.deepEqual([...toggled(choice, "/d/a.nrrd").chosen], []);
    assert.equal(allChosen(rows).chosen.size, 3);
});

test("each series becomes one dataset, loose files another, and no file is opened twice", () => {
    const rows = fileRows(entries, new Set(["/d/f_1.tif"]), "");
    const choice = { chosen: new Set(["series /d/f_1.tif", "/d/f_2.tif", "/d/a.nrrd", "/d/z.nrrd"]), anchor: null };
    assert.deepEqual(openRequests(rows, choice, "stack"), [
        { files: ["/d/f_1.tif", "/d/f_2.tif", "/d/f_10.tif"], series: "stack", name: "f_[1-10].tif" },
        { files: ["/d/a.nrrd", "/d/z.nrrd"], series: "stack" },
    ]);
    const each = openRequests(rows, choice, "each");
    assert.equal(each.length, 1);
    assert.equal(countFiles(each), 5);
    assert.deepEqual(openRequests(rows, toggled(nothingChosen, "/d/a.nrrd"), "steps"), [{ files: ["/d/a.nrrd"] }]);
    assert.deepEqual(openRequests(rows, nothingChosen, "each"), []);
});

test("single slices suggest a stack, volumes a cell each", () => {
    assert.equal(suggestedAs([512, 512, 1]), "stack");
    assert.equal(suggestedAs([64, 64, 64]), "each");
    assert.equal(suggestedAs(undefined), "each");
});
