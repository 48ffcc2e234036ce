// The workbook as a whole: state after a change, undo and redo, saving.
import { getJson, sendJson } from "./http";
import type { BookState, EditAnswer } from "./types";

export function getState(): Promise<BookState> {
    return getJson<BookState>("api/v1/state");
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
