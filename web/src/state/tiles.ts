// What the stream says about each tile on show; the pictures themselves live in their canvases.

export interface TileInfo {
    painted: boolean;
    level: number;
    scale: number;
    final: boolean;
    /** What a user should know about the last final picture, e.g. why it is coarser than asked for; else empty. */
    note: string;
    state: "ok" | "importing" | "error" | "empty";
    code: string;
    message: string;
    progress: number;
}

export type TileSlice = Record<string, TileInfo>;

export const newTile: TileInfo = {
    painted: false,
    level: 0,
    scale: 1,
    final: false,
    note: "",
    state: "ok",
    code: "",
    message: "",
    progress: 1,
};

export type TileAction =
    | { type: "tiles/update"; tiles: Record<string, Partial<TileInfo>> }
    | { type: "tiles/forget" };

function differs(before: TileInfo, info: Partial<TileInfo>): boolean {
    return (Object.keys(info) as (keyof TileInfo)[]).some((key) => info[key] !== before[key]);
}

export function reduceTiles(state: TileSlice, action: TileAction): TileSlice {
    switch (action.type) {
        case "tiles/forget":
            return {};
        case "tiles/update": {
            let next = state;
            for (const [cell, info] of Object.entries(action.tiles)) {
                const before = state[cell] ?? newTile;
                // Most frames of a gesture change pictures alone: nothing that stands around them is drawn again.
                if (state[cell] && !differs(before, info)) continue;
                if (next === state) next = { ...state };
                next[cell] = { ...before, ...info };
            }
            return next;
        }
    }
}
