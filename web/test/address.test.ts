import assert from "node:assert/strict";
import { test } from "node:test";
import { columnIndex, columnName, formatAddress, parseAddress, shiftFormula } from "../src/model/address";

test("columns count like a spreadsheet's", () => {
    assert.deepEqual([0, 25, 26, 51, 52, 701, 702].map(columnName), ["A", "Z", "AA", "AZ", "BA", "ZZ", "AAA"]);
    for (let column = 0; column < 1000; ++column) assert.equal(columnIndex(columnName(column)), column);
});

test("addresses are read strictly and written back", () => {
    assert.deepEqual(parseAddress(" b12 "), { column: 1, row: 11 });
    assert.equal(formatAddress({ column: 27, row: 0 }), "AB1");
    for (const wrong of ["", "A", "1", "A0", "1A", "A1:B2", "A-1", "AAAA1"]) assert.equal(parseAddress(wrong), null, wrong);
});

test("a copied formula moves its relative references only", () => {
    assert.equal(shiftFormula("=B1-A1", 1, 2), "=C3-B3");
    assert.equal(shiftFormula("=$B1-A$1", 1, 2), "=$B3-B$1");
    assert.equal(shiftFormula("=abs(B1)*2+max3(A1)", 0, 1), "=abs(B2)*2+max3(A2)");
    assert.equal(shiftFormula("=A1-B1", -1, 0), "=#REF!-A1");
});
