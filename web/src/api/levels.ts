// Levels of detail and the time-N curve of a sheet.
import { getJson, pathPart, sendJson } from "./http";

export interface TimingPoint {
    n: number;
    level: number;
    ms: number;
    ms_low: number;
    ms_high: number;
    frames: number;
    /** No redraw of all n cells yet: put together from redraws of some. */
    partly: boolean;
    r_raw: number | null;
    r: number | null;
    r_low: number | null;
    r_high: number | null;
    resident_bytes: number;
}

export interface LevelSettings {
    policy: string;
    frame_ms: number;
    frames_per_second: number;
    datasets: number;
    bytes: number;
    up_fraction: number;
    policies: string[];
    /** Set in the workbook, or what the server was started with. */
    from: "workbook" | "server";
}

export type LevelPatch = Partial<Omit<LevelSettings, "policy" | "policies" | "from">> & { policy?: string | null };

export interface Timings {
    n: number;
    shown: number;
    t_n: number | null;
    t_n_low: number | null;
    t_n_high: number | null;
    r_raw: number | null;
    r: number | null;
    r_low: number | null;
    r_high: number | null;
    level: number;
    policy: string;
    settings: LevelSettings;
    reason: string;
    resident_bytes: number;
    budget_bytes: number;
    points: TimingPoint[];
    measured?: { n: number; frames: number; stopped_early: boolean; warning: string | null };
}

function path(sheet: string, resource: string): string {
    return `api/v1/sheets/${pathPart(sheet)}/${resource}`;
}

export function getTimings(sheet: string): Promise<Timings> {
    return getJson<Timings>(path(sheet, "timings"));
}

export async function measureTimings(sheet: string): Promise<Timings> {
    return (await sendJson<Timings>("POST", path(sheet, "timings"), {}))!;
}

/** `{ policy: null }` goes back to the server's own settings. */
export async function setResolution(sheet: string, patch: LevelPatch): Promise<LevelSettings> {
    return (await sendJson<LevelSettings>("PATCH", path(sheet, "resolution"), patch))!;
}
