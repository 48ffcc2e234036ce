// Which files of a folder are chosen, and what is to become of them. Pure: every function gives a new value.
import type { FileEntry } from "../api/types";

/** Of several files: a cell each, slices of one volume, or steps of time. */
export type OpenAs = "each" | "stack" | "steps";

export const openAsLabels: Record<OpenAs, string> = {
    each: "each file in a cell",
    stack: "one volume (stack)",
    steps: "time steps",
};

/** A line of the list: folders and files; `series` stands for its files. */
export interface FileRow {
    key: string;
    entry: FileEntry;
    /** Paths that the line stands for; none for folders. */
    files: readonly string[];
    /** Of a file below its series. */
    member: boolean;
}

function isSeries(entry: FileEntry): boolean {
    return (entry.files?.length ?? 0) > 1;
}

/** The lines to show: files of a series only below one that is expanded, or where they alone match the filter. */
export function fileRows(entries: readonly FileEntry[], expanded: ReadonlySet<string>, filter: string): FileRow[] {
    const wanted = filter.trim().toLowerCase();
    const matches = (entry: FileEntry): boolean => entry.name.toLowerCase().includes(wanted);
    const shownSeries = entries.filter((entry) => isSeries(entry) && matches(entry));
    const inside = new Map<string, FileEntry>();
    for (const series of shownSeries) for (const file of series.files!) inside.set(file, series);
    const rows: FileRow[] = [];
    for (const entry of entries) {
        if (!matches(entry)) continue;
        if (isSeries(entry)) {
            rows.push({ key: `series ${entry.path}`, entry, files: entry.files!, member: false });
            if (!expanded.has(entry.path)) continue;
            for (const file of entries) {
                if (!isSeries(file) && inside.get(file.path) === entry) rows.push({ key: file.path, entry: file, files: [file.path], member: true });
            }
        } else if (!inside.has(entry.path)) {
            rows.push({ key: entry.path, entry, files: entry.kind === "file" ? [entry.path] : [], member: false });
        }
    }
    return rows;
}

export interface Choice {
    /** Keys of rows. */
    chosen: ReadonlySet<string>;
    /** Where a range begins. */
    anchor: string | null;
}

export const nothingChosen: Choice = { chosen: new Set(), anchor: null };

export function toggled(choice: Choice, key: string): Choice {
    const chosen = new Set(choice.chosen);
    if (!chosen.delete(key)) chosen.add(key);
    return { chosen, anchor: key };
}

/** All files from the anchor to `key`, instead of what was chosen; folders between them stay out. */
export function extendedTo(choice: Choice, rows: readonly FileRow[], key: string): Choice {
    const end = rows.findIndex((row) => row.key === key);
    const start = rows.findIndex((row) => row.key === choice.anchor);
    if (end < 0) return choice;
    const from = start < 0 ? end : start;
    const range = rows.slice(Math.min(from, end), Math.max(from, end) + 1);
    return { chosen: new Set(range.filter((row) => row.files.length > 0).map((row) => row.key)), anchor: rows[from]!.key };
}

export function allChosen(rows: readonly FileRow[]): Choice {
    const files = rows.filter((row) => row.files.length > 0 && !row.member);
    return { chosen: new Set(files.map((row) => row.key)), anchor: files[0]?.key ?? null };
}

/** What one request to the server opens. */
export interface OpenRequest {
    files: string[];
    series?: "stack" | "steps";
    /** Of the one dataset that a series becomes. */
    name?: string;
}

/** Each chosen series is a group; all other chosen files are one together. No file is opened twice. */
export function openRequests(rows: readonly FileRow[], choice: Choice, as: OpenAs): OpenRequest[] {
    const groups: { files: string[]; name?: string }[] = [];
    const single: string[] = [];
    const taken = new Set<string>();
    const fresh = (files: readonly string[]): string[] => files.filter((file) => !taken.has(file) && taken.add(file));
    const chosen = rows.filter((row) => choice.chosen.has(row.key));
    for (const row of chosen) if (row.files.length > 1) groups.push({ files: fresh(row.files), name: row.entry.name });
    for (const row of chosen) if (row.files.length === 1) single.push(...fresh(row.files));
    if (single.length > 0) groups.push({ files: single });
    if (as === "each") {
        const files = groups.flatMap((group) => group.files);
        return files.length > 0 ? [{ files }] : [];
    }
    return groups.map((group) => {
        if (group.files.length < 2) return { files: group.files };
        return group.name === undefined ? { files: group.files, series: as } : { files: group.files, series: as, name: group.name };
    });
}

export function countFiles(requests: readonly OpenRequest[]): number {
    return requests.reduce((sum, request) => sum + request.files.length, 0);
}

/** Single slices make a volume; volumes are compared, a cell each. */
export function suggestedAs(dims: unknown): OpenAs {
    return Array.isArray(dims) && dims[2] === 1 ? "stack" : "each";
}
