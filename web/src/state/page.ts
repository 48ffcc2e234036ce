// What belongs to this page alone: selection, view, panels, what is being typed or dragged.
import type { HiddenEdit, ProbeAnswer, StylePatch } from "../api/types";
import { noLook, type Look } from "../model/look";
import type { Scope } from "../model/scope";
import { firstCell, type Selection } from "../model/selection";

export type Theme = "dark" | "light";
export type LeftPanel = "datasets" | "open" | "save";

export interface Notice {
    id: number;
    tone: "info" | "error";
    text: string;
}

export interface PageSlice {
    selection: Selection;
    /** The layer that the inspector edits, as far as the selection allows it. */
    scope: Scope;
    look: Look;
    /** Edits under way, per cell: in the pictures already, not yet in the workbook. */
    live: Record<string, StylePatch>;
    /** A gesture is under way: the server draws for speed. */
    moving: boolean;
    enlarged: string | null;
    /** Of the tiles' size; 1: what fits the window. */
    gridZoom: number;
    leftPanel: LeftPanel | null;
    /** Why the save panel asks for a file. */
    saveReason: string;
    inspector: boolean;
    help: boolean;
    /** Handles of what is clipped stand on the pictures. */
    clipHandles: boolean;
    theme: Theme;
    /** Text in the formula bar while it is edited. */
    formula: string | null;
    formulaError: string;
    notices: Notice[];
    hidden: HiddenEdit[];
    probe: ProbeAnswer | null;
    playing: boolean;
}

/** Something follows the pointer: the camera, or a value that is being dragged. */
export function isMoving(page: PageSlice): boolean {
    return page.moving || Object.keys(page.live).length > 0;
}

export const newPage: PageSlice = {
    selection: firstCell,
    scope: "sheet",
    look: noLook,
    live: {},
    moving: false,
    enlarged: null,
    gridZoom: 1,
    leftPanel: "datasets",
    saveReason: "",
    inspector: true,
    help: false,
    clipHandles: false,
    theme: "dark",
    formula: null,
    formulaError: "",
    notices: [],
    hidden: [],
    probe: null,
    playing: false,
};

export type PageAction =
    | { type: "page/select"; selection: Selection }
    | { type: "page/scope"; scope: Scope }
    | { type: "page/look"; look: Look }
    | { type: "page/live"; live: Record<string, StylePatch> }
    | { type: "page/moving"; moving: boolean }
    | { type: "page/enlarge"; cell: string | null }
    | { type: "page/gridZoom"; zoom: number }
    | { type: "page/leftPanel"; panel: LeftPanel | null; reason?: string }
    | { type: "page/inspector"; open: boolean }
    | { type: "page/help"; open: boolean }
    | { type: "page/clipHandles"; shown: boolean }
    | { type: "page/theme"; theme: Theme }
    | { type: "page/formula"; text: string | null; error?: string }
    | { type: "page/notice"; notice: Notice }
    | { type: "page/noticeGone"; id: number }
    | { type: "page/hidden"; hidden: HiddenEdit[] }
    | { type: "page/probe"; probe: ProbeAnswer | null }
    | { type: "page/playing"; playing: boolean };

const mostNotices = 4;

export function reducePage(state: PageSlice, action: PageAction): PageSlice {
    switch (action.type) {
        case "page/select": {
            // Selecting headers means editing there; selecting cells leaves the chosen layer as it is.
            const kind = action.selection.kind;
            const scope: Scope =
                kind === "columns" ? "column" : kind === "rows" ? "row" : kind === "sheet" ? "sheet" : state.scope;
            const left = kind === "cells" && state.selection.kind !== "cells" ? "sheet" : scope;
            return { ...state, selection: action.selection, scope: left, formula: null, formulaError: "" };
        }
        case "page/scope":
            return { ...state, scope: action.scope };
        case "page/look":
            return { ...state, look: action.look };
        case "page/live":
            return { ...state, live: action.live };
        case "page/moving":
            return state.moving === action.moving ? state : { ...state, moving: action.moving };
        case "page/enlarge":
            return { ...state, enlarged: action.cell };
        case "page/gridZoom":
            return { ...state, gridZoom: action.zoom };
        case "page/leftPanel":
            return { ...state, leftPanel: action.panel, saveReason: action.reason ?? "" };
        case "page/inspector":
            return { ...state, inspector: action.open };
        case "page/help":
            return { ...state, help: action.open };
        case "page/clipHandles":
            return { ...state, clipHandles: action.shown };
        case "page/theme":
            return { ...state, theme: action.theme };
        case "page/formula":
            return { ...state, formula: action.text, formulaError: action.error ?? "" };
        case "page/notice":
            return { ...state, notices: [...state.notices, action.notice].slice(-mostNotices) };
        case "page/noticeGone":
            return { ...state, notices: state.notices.filter((notice) => notice.id !== action.id) };
        case "page/hidden":
            return { ...state, hidden: action.hidden };
        case "page/probe":
            return { ...state, probe: action.probe };
        case "page/playing":
            return { ...state, playing: action.playing };
    }
}
