// What is selected: cells (a rectangle from the anchor to the active cell, plus single cells added with Ctrl), whole columns,
// whole rows, or the sheet. Pure: every function gives a new selection.
import { columnName, formatAddress, parseAddress, type Address } from "./address";

export interface Extent {
    columns: number;
    rows: number;
}

export type SelectionKind = "cells" | "columns" | "rows" | "sheet";

export interface Selection {
    kind: SelectionKind;
    anchor: Address;
    active: Address;
    /** Cells added with Ctrl, as "B2". */
    extra: readonly string[];
}

export const firstCell: Selection = { kind: "cells", anchor: { column: 0, row: 0 }, active: { column: 0, row: 0 }, extra: [] };

function clampTo(extent: Extent, address: Address): Address {
    return {
        column: Math.max(0, Math.min(extent.columns - 1, address.column)),
        row: Math.max(0, Math.min(extent.rows - 1, address.row)),
    };
}

export interface Modifiers {
    extend: boolean;
    toggle: boolean;
}

export const noModifiers: Modifiers = { extend: false, toggle: false };

export function selectCell(current: Selection, address: Address, modifiers: Modifiers = noModifiers): Selection {
    if (modifiers.extend && current.kind === "cells") return { ...current, active: address };
    if (modifiers.toggle && current.kind === "cells") {
        const name = formatAddress(address);
        const before = new Set([...current.extra, formatAddress(current.active)]);
        if (before.has(name) && before.size > 1) before.delete(name);
        else before.add(name);
        const active = before.has(name) ? address : (parseAddress([...before].pop() ?? "A1") ?? address);
        return { kind: "cells", anchor: active, active, extra: [...before].filter((cell) => cell !== formatAddress(active)) };
    }
    return { kind: "cells", anchor: address, active: address, extra: [] };
}

export function selectColumn(current: Selection, column: number, modifiers: Modifiers = noModifiers): Selection {
    const active = { column, row: 0 };
    if (modifiers.extend && current.kind === "columns") return { ...current, active };
    return { kind: "columns", anchor: active, active, extra: [] };
}

export function selectRow(current: Selection, row: number, modifiers: Modifiers = noModifiers): Selection {
    const active = { column: 0, row };
    if (modifiers.extend && current.kind === "rows") return { ...current, active };
    return { kind: "rows", anchor: active, active, extra: [] };
}

export function selectSheet(current: Selection): Selection {
    return { ...current, kind: "sheet", extra: [] };
}

/** Arrow keys on titles and headers. */
export function moveSelection(current: Selection, columns: number, rows: number, extend: boolean, extent: Extent): Selection {
    const active = clampTo(extent, { column: current.active.column + columns, row: current.active.row + rows });
    if (current.kind === "columns") return selectColumn(current, active.column, { extend, toggle: false });
    if (current.kind === "rows") return selectRow(current, active.row, { extend, toggle: false });
    return selectCell(current.kind === "cells" ? current : { ...current, kind: "cells" }, active, { extend, toggle: false });
}

function span(a: number, b: number): number[] {
    const low = Math.min(a, b);
    return Array.from({ length: Math.abs(a - b) + 1 }, (_, i) => low + i);
}

export function selectedColumns(selection: Selection): string[] {
    return selection.kind === "columns" ? span(selection.anchor.column, selection.active.column).map(columnName) : [];
}

export function selectedRows(selection: Selection): string[] {
    return selection.kind === "rows" ? span(selection.anchor.row, selection.active.row).map((row) => String(row + 1)) : [];
}

/** Every selected cell of the sheet, in reading order. */
export function selectedCells(selection: Selection, extent: Extent): string[] {
    const all = span(0, Math.max(0, extent.rows - 1)).flatMap((row) =>
        span(0, Math.max(0, extent.columns - 1)).map((column) => ({ column, row })),
    );
    return all.filter((address) => isSelected(selection, address)).map(formatAddress);
}

export function isSelected(selection: Selection, address: Address): boolean {
    const between = (value: number, a: number, b: number): boolean => value >= Math.min(a, b) && value <= Math.max(a, b);
    const { anchor, active } = selection;
    switch (selection.kind) {
        case "sheet":
            return true;
        case "columns":
            return between(address.column, anchor.column, active.column);
        case "rows":
            return between(address.row, anchor.row, active.row);
        case "cells":
            return (
                (between(address.column, anchor.column, active.column) && between(address.row, anchor.row, active.row)) ||
                selection.extra.includes(formatAddress(address))
            );
    }
}

export function describeSelection(selection: Selection): string {
    const range = (names: string[], one: string, many: string): string =>
        names.length === 1 ? `${one} ${names[0]}` : `${many} ${names[0]} to ${names[names.length - 1]}`;
    switch (selection.kind) {
        case "sheet":
            return "Sheet";
        case "columns":
            return range(selectedColumns(selection), "Column", "Columns");
        case "rows":
            return range(selectedRows(selection), "Row", "Rows");
        case "cells": {
            const from = formatAddress(selection.anchor);
            const to = formatAddress(selection.active);
            const rectangle = from === to ? to : `${from}:${to}`;
            return selection.extra.length ? `${rectangle} +${selection.extra.length}` : rectangle;
        }
    }
}
