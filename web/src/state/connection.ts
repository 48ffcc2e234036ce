// The server as seen from here: reachable or not, what it is, and its stream's running figures.
import type { ColourMap, Preset, ServerInfo, StyleKey } from "../api/types";

/** paused: the page is hidden and has closed its stream. refused: the server wants a token that this page does not have. */
export type ConnectionPhase = "connecting" | "live" | "lost" | "paused" | "refused";

export interface StreamStatus {
    frameMs: number;
    finalCells: number;
    cells: number;
    level: number;
    policy: string;
    residentBytes: number;
    budgetBytes: number;
}

/** The server has nothing more to send for a view of the page and a version of the workbook. */
export interface StreamRest {
    view: number;
    version: number;
}

export interface ConnectionState {
    phase: ConnectionPhase;
    message: string;
    /** How often the stream was opened: the second time and later mean "restored". */
    openings: number;
    info: ServerInfo | null;
    keys: StyleKey[];
    maps: ColourMap[];
    presets: Preset[];
    latencyMs: number | null;
    status: StreamStatus | null;
    /** The last time that everything was on show; null in a stream that has not come so far. */
    rest: StreamRest | null;
}

export const noConnection: ConnectionState = {
    phase: "connecting",
    message: "",
    openings: 0,
    info: null,
    keys: [],
    maps: [],
    presets: [],
    latencyMs: null,
    status: null,
    rest: null,
};

export type ConnectionAction =
    | { type: "connection/phase"; phase: ConnectionPhase; message?: string }
    | { type: "connection/about"; info: ServerInfo; keys: StyleKey[]; maps: ColourMap[]; presets: Preset[] }
    | { type: "connection/latency"; ms: number }
    | { type: "connection/status"; status: StreamStatus }
    | { type: "connection/rest"; rest: StreamRest };

/** Smooths over about eight answers: a figure that people can read. */
const latencyWeight = 1 / 8;

export function reduceConnection(state: ConnectionState, action: ConnectionAction): ConnectionState {
    switch (action.type) {
        case "connection/phase": {
            if (state.phase === action.phase && state.message === (action.message ?? "")) return state;
            const opened = action.phase === "live" && state.phase !== "live" ? 1 : 0;
            const rest = opened ? null : state.rest;
            return { ...state, phase: action.phase, message: action.message ?? "", openings: state.openings + opened, rest };
        }
        case "connection/about":
            return { ...state, info: action.info, keys: action.keys, maps: action.maps, presets: action.presets };
        case "connection/latency": {
            const before = state.latencyMs ?? action.ms;
            return { ...state, latencyMs: before + latencyWeight * (action.ms - before) };
        }
        case "connection/status":
            return { ...state, status: action.status };
        case "connection/rest":
            return { ...state, rest: action.rest };
    }
}
