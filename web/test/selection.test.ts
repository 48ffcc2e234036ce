import assert from "node:assert/strict";
import { test } from "node:test";
import type { SheetState } from "../src/api/types";
import { cellsShowing, scopesOf, targetsOf } from "../src/model/scope";
import {
    describeSelection,
    firstCell,
    moveSelection,
    selectCell,
    selectColumn,
    selectedCells,
    selectRow,
    selectSheet,
} from "../src/model/selection";

const extent = { columns: 3, rows: 2 };
const at = (column: number, row: number) => ({ column, row });

test("Shift extends to a rectangle, Ctrl adds and takes away single cells", () => {
    const rectangle = selectCell(selectCell(firstCell, at(0, 0)), at(1, 1), { extend: true, toggle: false });
    assert.deepEqual(selectedCells(rectangle, extent), ["A1", "B1", "A2", "B2"]);
    assert.equal(describeSelection(rectangle), "A1:B2");
    const two = selectCell(selectCell(firstCell, at(0, 0)), at(2, 1), { extend: false, toggle: true });
    assert.deepEqual(selectedCells(two, extent), ["A1", "C2"]);
    const one = selectCell(two, at(0, 0), { extend: false, toggle: true });
    assert.deepEqual(selectedCells(one, extent), ["C2"]);
});

test("headers select whole lines, arrows stay on the sheet", () => {
    assert.deepEqual(selectedCells(selectColumn(firstCell, 1), extent), ["B1", "B2"]);
    assert.deepEqual(selectedCells(selectRow(firstCell, 1), extent), ["A2", "B2", "C2"]);
    assert.equal(selectedCells(selectSheet(firstCell), extent).length, 6);
    const columns = moveSelection(selectColumn(firstCell, 1), 5, 0, true, extent);
    assert.equal(describeSelection(columns), "Columns B to C");
    assert.deepEqual(moveSelection(firstCell, -1, -1, false, extent).active, at(0, 0));
});

const style = (origin: "default" | "sheet" | "column" | "row" | "cell") => ({ "range.mode": { value: "own", origin } });
const sheet: SheetState = {
    name: "S",
    ...extent,
    cells: [
        { cell: "A1", state: "ok", style: style("default") },
        { cell: "B1", state: "ok", style: style("cell") },
        { cell: "A2", state: "ok", style: style("row") },
        { cell: "B2", state: "ok", style: style("column") },
    ],
};

test("an edit shows where no nearer layer sets the key", () => {
    const names = (target: Parameters<typeof cellsShowing>[1]) => cellsShowing(sheet, target, "range.mode").map((cell) => cell.cell);
    assert.deepEqual(names({ layer: "sheet" }), ["A1"]);
    assert.deepEqual(names({ layer: "column", column: "B" }), ["B2"]);
    assert.deepEqual(names({ layer: "row", row: "2" }), ["A2", "B2"]);
    assert.deepEqual(names({ layer: "cell", cell: "B1" }), ["B1"]);
});

test("edits go to one target for each selected line or cell", () => {
    const cells = selectCell(firstCell, at(1, 1), { extend: true, toggle: false });
    assert.deepEqual(scopesOf(cells), ["sheet", "column", "row", "cell"]);
    assert.deepEqual(targetsOf("column", cells, sheet), [
        { layer: "column", column: "A" },
        { layer: "column", column: "B" },
    ]);
    assert.equal(targetsOf("cell", cells, sheet).length, 4);
    assert.deepEqual(targetsOf("row", selectRow(firstCell, 1), sheet), [{ layer: "row", row: "2" }]);
});
