// What this page looks at, apart from the workbook: cameras (and the time step while playing) for all cells, and for cells
// that were turned alone. The workbook's own view is the starting point; "save view" writes this back.
import type { CellState, SheetState, StylePatch } from "../api/types";
import { cameraFromStyle, defaultCamera, styleFromCamera, type Camera, type StyleValue } from "./camera";

export interface Look {
    /** For all cells. */
    style: StylePatch;
    /** For single cells; nearer than `style`. */
    cells: Record<string, StylePatch>;
}

export const noLook: Look = { style: {}, cells: {} };

const cameraKeys = ["camera.azimuth", "camera.elevation", "camera.roll", "camera.distance", "camera.target"];

/** The workbook's values of the camera keys, whose own origin is nearer than the sheet when `own`. */
function workbookCamera(cell: CellState | undefined): { style: StylePatch; own: boolean } {
    const style: StylePatch = {};
    let own = false;
    for (const key of [...cameraKeys, "camera.fov", "camera.projection"]) {
        const resolved = cell?.style[key];
        if (!resolved) continue;
        style[key] = resolved.value;
        if (cameraKeys.includes(key) && resolved.origin !== "default" && resolved.origin !== "sheet") own = true;
    }
    return { style, own };
}

/** A cell with a camera of its own does not follow the linked one. */
export function hasOwnCamera(look: Look, cell: CellState): boolean {
    return look.cells[cell.cell] !== undefined || workbookCamera(cell).own;
}

/** The camera that a cell shows now. */
export function cameraOf(look: Look, cell: CellState | undefined): Camera {
    const { style, own } = workbookCamera(cell);
    const base = cameraFromStyle(style, defaultCamera);
    const single = cell ? look.cells[cell.cell] : undefined;
    if (single) return cameraFromStyle(single, base);
    return own ? base : cameraFromStyle(look.style, base);
}

/** The look after a gesture turned `cell` to `camera`: alone, or with every linked cell. */
export function withCamera(look: Look, cell: CellState, camera: Camera, alone: boolean): Look {
    const style = styleFromCamera(camera);
    if (alone || hasOwnCamera(look, cell)) return { ...look, cells: { ...look.cells, [cell.cell]: style } };
    return { ...look, style: { ...look.style, ...style } };
}

/** Back to the workbook's view; `cell`: only that one, which also links it again. */
export function withoutCamera(look: Look, cell: string | null): Look {
    const without = (style: StylePatch): StylePatch =>
        Object.fromEntries(Object.entries(style).filter(([key]) => !key.startsWith("camera.")));
    if (cell === null) return { style: without(look.style), cells: {} };
    const cells = { ...look.cells };
    delete cells[cell];
    return { ...look, cells };
}

export function withKey(look: Look, key: string, value: StyleValue | undefined): Look {
    const style = { ...look.style };
    if (value === undefined) delete style[key];
    else style[key] = value;
    return { ...look, style };
}

/**
 * What the stream is told: cells whose workbook camera is their own keep it against the linked one, and edits that are being
 * dragged (`live`) stand above everything.
 */
export function viewOverrides(look: Look, sheet: SheetState | undefined, live: Record<string, StylePatch>): Look {
    const cells: Record<string, StylePatch> = {};
    const linkedCamera = Object.keys(look.style).some((key) => key.startsWith("camera."));
    for (const cell of sheet?.cells ?? []) {
        const { style, own } = workbookCamera(cell);
        const single = look.cells[cell.cell];
        const camera = single ?? (own && linkedCamera ? styleFromCamera(cameraFromStyle(style)) : undefined);
        const edits = live[cell.cell];
        if (camera || edits) cells[cell.cell] = { ...camera, ...edits };
    }
    return { style: look.style, cells };
}

/** For links: compact text that survives in a URL's fragment. */
export function lookToText(look: Look): string {
    return encodeURIComponent(JSON.stringify([look.style, look.cells]));
}

export function lookFromText(text: string): Look | null {
    try {
        const parsed: unknown = JSON.parse(decodeURIComponent(text));
        if (!Array.isArray(parsed) || parsed.length !== 2) return null;
        const [style, cells] = parsed as unknown[];
        const isObject = (value: unknown): value is Record<string, unknown> =>
            typeof value === "object" && value !== null && !Array.isArray(value);
        if (!isObject(style) || !isObject(cells) || !Object.values(cells).every(isObject)) return null;
        return { style: style as StylePatch, cells: cells as Record<string, StylePatch> };
    } catch {
        return null;
    }
}
