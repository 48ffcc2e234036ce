// Words and plot geometry for levels of detail.
import type { TimingPoint } from "../api/levels";

export const policyWords: Record<string, { label: string; doc: string }> = {
    focus: {
        label: "Per cell (focus)",
        doc: "Each cell as fine as its picture can show; when the sheet is above its frame time or texture memory, the cell that is looked at stays sharp longest.",
    },
    slope: {
        label: "All cells: slope rule",
        doc: "All cells go one level coarser when the slope of the time-N curve grows by more than R = 1.5 (Khanduja & Karki 2007).",
    },
    "slope-first": { label: "All cells: slope, first bend", doc: "As the slope rule, with a limit of 1.2, so that the first transition counts as well." },
    time: { label: "All cells: frame time", doc: "Coarser when a picture of the whole sheet takes longer than the limit." },
    rate: { label: "All cells: frame rate", doc: "Coarser when there are fewer frames per second than the limit." },
    count: { label: "All cells: number", doc: "Coarser when more cells are on show than the limit; each level takes eight times as many." },
    bytes: { label: "All cells: bytes", doc: "Coarser when the volumes take more bytes than the limit." },
    off: { label: "Full level", doc: "Every cell at level 0, whatever it takes." },
};

/** The member of the settings that is the policy's limit, and how the page shows it. */
export const policyLimits: Record<string, { member: "frame_ms" | "frames_per_second" | "datasets" | "bytes"; unit: string; scale: number }> = {
    focus: { member: "frame_ms", unit: "ms per frame", scale: 1 },
    time: { member: "frame_ms", unit: "ms per frame", scale: 1 },
    rate: { member: "frames_per_second", unit: "frames per s", scale: 1 },
    count: { member: "datasets", unit: "cells at level 0", scale: 1 },
    bytes: { member: "bytes", unit: "MB", scale: 1e6 },
};

/** Round steps that make at most `most` intervals over [0, high]. */
export function axisSteps(high: number, most: number): number[] {
    if (!(high > 0)) return [0];
    const rough = high / most;
    const power = 10 ** Math.floor(Math.log10(rough));
    const step = [1, 2, 5, 10].map((factor) => factor * power).find((candidate) => candidate >= rough * (1 - 1e-9))!;
    const steps: number[] = [];
    for (let i = 0; i * step <= high * (1 + 1e-9); ++i) steps.push(Number((i * step).toPrecision(6)));
    return steps;
}

/** Points in the order in which they are walked through: by N, then from fine to coarse. */
export function inOrder(points: readonly TimingPoint[]): TimingPoint[] {
    return [...points].sort((a, b) => a.n - b.n || a.level - b.level);
}

/** One line per level, in ascending N. */
export function lines(points: readonly TimingPoint[]): TimingPoint[][] {
    const byLevel = new Map<number, TimingPoint[]>();
    for (const point of inOrder(points)) byLevel.set(point.level, [...(byLevel.get(point.level) ?? []), point]);
    return [...byLevel.values()];
}

function interval(low: number | null, high: number | null, digits: number): string {
    return low === null ? "" : ` (${low.toFixed(digits)} to ${high === null ? "∞" : high.toFixed(digits)})`;
}

export function pointText(point: TimingPoint): string {
    const source = point.partly ? "redraws of some cells" : `${point.frames} ${point.frames === 1 ? "frame" : "frames"}`;
    const parts = [
        `N = ${point.n}`,
        `T_N ${point.ms.toFixed(1)} ms${interval(point.ms_low, point.ms_high, 1)} from ${source}`,
        point.r === null ? "R not known yet" : `R ${point.r.toFixed(2)}${interval(point.r_low, point.r_high, 2)}`,
    ];
    if (point.r_raw !== null) parts.push(`raw R ${point.r_raw.toFixed(2)}`);
    parts.push(`level ${point.level}`, `textures ${Math.round(point.resident_bytes / 1e6)} MB`);
    return parts.join(", ");
}
