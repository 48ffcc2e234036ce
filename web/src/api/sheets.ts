// One sheet: styles at each layer, cells, layout, the saved view, colour bars, probes and picture addresses.
import { getJson, pathPart, sendJson, withQuery, type Query } from "./http";
import type { ColourBarInfo, EditAnswer, LayerTarget, ProbeAnswer, StylePatch } from "./types";

function sheetPath(sheet: string): string {
    return `api/v1/sheets/${pathPart(sheet)}`;
}

export function layerPath(sheet: string, target: LayerTarget): string {
    switch (target.layer) {
        case "sheet":
            return `${sheetPath(sheet)}/style`;
        case "column":
            return `${sheetPath(sheet)}/columns/${pathPart(target.column)}/style`;
        case "row":
            return `${sheetPath(sheet)}/rows/${pathPart(target.row)}/style`;
        case "cell":
            return `${sheetPath(sheet)}/cells/${pathPart(target.cell)}`;
    }
}

export async function patchStyle(
    sheet: string,
    target: LayerTarget,
    patch: StylePatch,
    gesture?: string,
): Promise<EditAnswer> {
    return (await sendJson<EditAnswer>("PATCH", withQuery(layerPath(sheet, target), { gesture }), patch)) ?? {};
}

export interface CellPatch {
    source?: string | null;
    title?: string | null;
}

export async function patchCell(sheet: string, cell: string, patch: CellPatch, gesture?: string): Promise<void> {
    await sendJson("PATCH", withQuery(layerPath(sheet, { layer: "cell", cell }), { gesture }), patch);
}

export async function patchSheet(sheet: string, patch: { columns?: number; rows?: number; name?: string }): Promise<void> {
    await sendJson("PATCH", sheetPath(sheet), patch);
}

export async function clearOverrides(sheet: string, keys: string[], cells: string[]): Promise<void> {
    await sendJson("POST", `${sheetPath(sheet)}/clear-overrides`, { keys, cells });
}

/** Axial, coronal and sagittal planes beside each of the cells. */
export async function makePlanes(sheet: string, cells: string[]): Promise<void> {
    await sendJson("POST", `${sheetPath(sheet)}/planes`, { cells });
}

export async function saveView(
    sheet: string,
    view: { style: StylePatch; cells: Record<string, StylePatch> },
): Promise<void> {
    await sendJson("POST", `${sheetPath(sheet)}/view`, view);
}

export function getColourBar(sheet: string, cell: string): Promise<ColourBarInfo> {
    return getJson<ColourBarInfo>(`${sheetPath(sheet)}/cells/${pathPart(cell)}/colourbar`);
}

/** All values of the time step on show, those of all steps, or those within the picture. */
export type RangeOver = "data" | "time" | "visible";

export interface ValueRangeAnswer {
    /** null: no value is finite. */
    min: number | null;
    max: number | null;
}

export function getValueRange(
    sheet: string,
    cell: string,
    query: { over: RangeOver; width: number; height: number; stream: string | null },
): Promise<ValueRangeAnswer> {
    return getJson<ValueRangeAnswer>(`${sheetPath(sheet)}/cells/${pathPart(cell)}/range`, { ...query });
}

export interface PixelProbe {
    cell: string;
    px: number;
    py: number;
    width: number;
    height: number;
    stream: string | null;
}

export function probePixel(sheet: string, probe: PixelProbe, signal: AbortSignal): Promise<ProbeAnswer> {
    return getJson<ProbeAnswer>(`${sheetPath(sheet)}/probe`, { ...probe }, signal);
}

export function sheetImageUrl(sheet: string, format: string, query: Query): string {
    return withQuery(`${sheetPath(sheet)}/image.${format}`, query);
}

export function cellImageUrl(sheet: string, cell: string, format: string, query: Query): string {
    return withQuery(`${sheetPath(sheet)}/cells/${pathPart(cell)}/image.${format}`, query);
}

export function streamUrl(sheet: string, width: number, height: number, dpr: number): string {
    return withQuery(`${sheetPath(sheet)}/stream`, { width, height, dpr, atlas: 1 });
}
