// What the page knows about levels of detail: the panel, the last timings, and the cell under the pointer.
import type { Timings } from "../api/levels";

export interface LevelSlice {
    open: boolean;
    timings: Timings | null;
    measuring: boolean;
    /** The pointer is over its picture: it stays sharp longest. */
    hovered: string | null;
}

export const noLevels: LevelSlice = { open: false, timings: null, measuring: false, hovered: null };

export type LevelAction =
    | { type: "levels/open"; open: boolean }
    | { type: "levels/timings"; timings: Timings | null }
    | { type: "levels/measuring"; measuring: boolean }
    | { type: "levels/hovered"; cell: string | null };

export function reduceLevels(state: LevelSlice, action: LevelAction): LevelSlice {
    switch (action.type) {
        case "levels/open":
            return { ...state, open: action.open };
        case "levels/timings":
            return { ...state, timings: action.timings };
        case "levels/measuring":
            return { ...state, measuring: action.measuring };
        case "levels/hovered":
            return state.hovered === action.cell ? state : { ...state, hovered: action.cell };
    }
}
