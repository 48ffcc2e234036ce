// To which layer an edit goes, and which cells it shows in. Nearer wins: cell, row, column, sheet, default.
import type { CellState, LayerTarget, Origin, SheetState } from "../api/types";
import { columnName, parseAddress } from "./address";
import { selectedCells, selectedColumns, selectedRows, type Selection } from "./selection";

export type Scope = "sheet" | "column" | "row" | "cell";

const nearness: Record<Origin, number> = { default: 0, sheet: 1, column: 2, row: 3, cell: 4 };

/** Scopes that make sense for a selection, from far to near. */
export function scopesOf(selection: Selection): Scope[] {
    switch (selection.kind) {
        case "sheet":
            return ["sheet"];
        case "columns":
            return ["sheet", "column"];
        case "rows":
            return ["sheet", "row"];
        case "cells":
            return ["sheet", "column", "row", "cell"];
    }
}

function unique(names: string[]): string[] {
    return [...new Set(names)];
}

/** One target for each selected column, row or cell. */
export function targetsOf(scope: Scope, selection: Selection, sheet: SheetState): LayerTarget[] {
    const cells = (): string[] => selectedCells(selection, sheet);
    switch (scope) {
        case "sheet":
            return [{ layer: "sheet" }];
        case "column": {
            const columns = selectedColumns(selection);
            const names = columns.length ? columns : unique(cells().map((cell) => columnName(parseAddress(cell)!.column)));
            return names.map((column) => ({ layer: "column", column }));
        }
        case "row": {
            const rows = selectedRows(selection);
            const names = rows.length ? rows : unique(cells().map((cell) => String(parseAddress(cell)!.row + 1)));
            return names.map((row) => ({ layer: "row", row }));
        }
        case "cell":
            return cells().map((cell) => ({ layer: "cell", cell }));
    }
}

function covers(target: LayerTarget, cell: string): boolean {
    const address = parseAddress(cell);
    if (!address) return false;
    switch (target.layer) {
        case "sheet":
            return true;
        case "column":
            return columnName(address.column) === target.column;
        case "row":
            return String(address.row + 1) === target.row;
        case "cell":
            return cell === target.cell;
    }
}

/** Cells in which an edit of `key` at this layer is visible, because no nearer layer sets it. */
export function cellsShowing(sheet: SheetState, target: LayerTarget, key: string): CellState[] {
    return sheet.cells.filter((cell) => {
        const origin = cell.style[key]?.origin ?? "default";
        return covers(target, cell.cell) && nearness[origin] <= nearness[target.layer];
    });
}

export function originLabel(origin: Origin, cell: string): string {
    const address = parseAddress(cell);
    switch (origin) {
        case "default":
            return "default";
        case "sheet":
            return "sheet";
        case "column":
            return address ? `column ${columnName(address.column)}` : "column";
        case "row":
            return address ? `row ${address.row + 1}` : "row";
        case "cell":
            return `cell ${cell}`;
    }
}

export function targetLabel(target: LayerTarget): string {
    switch (target.layer) {
        case "sheet":
            return "sheet";
        case "column":
            return `column ${target.column}`;
        case "row":
            return `row ${target.row}`;
        case "cell":
            return `cell ${target.cell}`;
    }
}

/** The layer that a value comes from, for resetting it there; null for defaults. */
export function targetOfOrigin(origin: Origin, cell: string): LayerTarget | null {
    const address = parseAddress(cell);
    if (!address) return null;
    switch (origin) {
        case "default":
            return null;
        case "sheet":
            return { layer: "sheet" };
        case "column":
            return { layer: "column", column: columnName(address.column) };
        case "row":
            return { layer: "row", row: String(address.row + 1) };
        case "cell":
            return { layer: "cell", cell };
    }
}
