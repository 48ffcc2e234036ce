// The workbook as a whole: state after a change, undo and redo, saving.
import { getJson, sendJson } from "./http";
import type { BookState, CellState, EditAnswer, SheetState } from "./types";

/** Cells come with what they do not share with their sheet; a cell that has nothing of its own shares the sheet's object. */
function withWholeStyles(sheet: SheetState): SheetState {
    const shared = sheet.style ?? {};
    const whole = (own: CellState["style"]): CellState["style"] => (Object.keys(own).length === 0 ? shared : { ...shared, ...own });
    return { ...sheet, cells: sheet.cells.map((cell) => ({ ...cell, style: whole(cell.style) })) };
}

export async function getState(): Promise<BookState> {
    const book = await getJson<BookState>("api/v1/state?styles=own");
    return { ...book, sheets: book.sheets.map(withWholeStyles) };
}

export function getWorkbook(): Promise<unknown> {
    return getJson<unknown>("api/v1/workbook");
}

export async function undo(): Promise<void> {
    await sendJson<EditAnswer>("POST", "api/v1/undo");
}

export async function redo(): Promise<void> {
    await sendJson<EditAnswer>("POST", "api/v1/redo");
}

export async function saveWorkbook(path?: string): Promise<void> {
    await sendJson("POST", "api/v1/workbook/save", path ? { path } : {});
}

export async function putWorkbook(document: unknown): Promise<void> {
    await sendJson("PUT", "api/v1/workbook", document);
}

/** Opens the demo workbook; offered only by servers whose info says `demo`. */
export async function openDemo(): Promise<void> {
    await sendJson("POST", "api/v1/demo");
}
