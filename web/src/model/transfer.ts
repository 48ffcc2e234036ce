// Opacity curves as lists of [position, opacity], both in [0, 1], positions not falling.

export type OpacityPoint = readonly [number, number];

function clamp01(value: number): number {
    return Math.min(1, Math.max(0, value));
}

/** null when the value is not a list of points (for example "auto"). */
export function opacityPointsOf(value: unknown): OpacityPoint[] | null {
    if (!Array.isArray(value) || value.length === 0) return null;
    const points: OpacityPoint[] = [];
    for (const entry of value) {
        if (!Array.isArray(entry) || entry.length < 2) return null;
        const [position, opacity] = entry as unknown[];
        if (typeof position !== "number" || typeof opacity !== "number") return null;
        points.push([position, opacity]);
    }
    return points;
}

/** Opacity at a position: straight lines between the points, the end values beyond them. */
export function opacityAt(points: readonly OpacityPoint[], position: number): number {
    const first = points[0];
    if (!first) return 0;
    if (position <= first[0]) return first[1];
    for (let i = 1; i < points.length; ++i) {
        const [leftAt, left] = points[i - 1]!;
        const [rightAt, right] = points[i]!;
        if (position <= rightAt) {
            const width = rightAt - leftAt;
            return width > 0 ? left + ((right - left) * (position - leftAt)) / width : right;
        }
    }
    return points[points.length - 1]![1];
}

function rounded(value: number): number {
    return Math.round(clamp01(value) * 1e4) / 1e4;
}

/** The point moves as far as its neighbours allow, so that the list stays sorted. */
export function movedPoint(
    points: readonly OpacityPoint[],
    index: number,
    position: number,
    opacity: number,
): OpacityPoint[] {
    const low = index > 0 ? points[index - 1]![0] : 0;
    const high = index < points.length - 1 ? points[index + 1]![0] : 1;
    const at = Math.min(high, Math.max(low, clamp01(position)));
    return points.map((point, i) => (i === index ? ([rounded(at), rounded(opacity)] as const) : point));
}

/** Returns the new list and the new point's index. */
export function addedPoint(
    points: readonly OpacityPoint[],
    position: number,
    opacity: number,
): { points: OpacityPoint[]; index: number } {
    const at = rounded(position);
    const found = points.findIndex((point) => point[0] > at);
    const index = found < 0 ? points.length : found;
    return { points: [...points.slice(0, index), [at, rounded(opacity)], ...points.slice(index)], index };
}

/** A curve keeps at least two points. */
export function removedPoint(points: readonly OpacityPoint[], index: number): OpacityPoint[] {
    return points.length <= 2 ? [...points] : points.filter((_, i) => i !== index);
}

/**
 * The fewest points whose curve stays within `tolerance` of a finely sampled one (Douglas and Peucker 1973, with vertical
 * distance): what the editor starts from when the curve was chosen by the server.
 */
export function simplifiedCurve(samples: readonly OpacityPoint[], tolerance = 0.01): OpacityPoint[] {
    if (samples.length <= 2) return [...samples];
    const keep = new Set([0, samples.length - 1]);
    const spans: [number, number][] = [[0, samples.length - 1]];
    for (let span = spans.pop(); span; span = spans.pop()) {
        const [from, to] = span;
        let worst = tolerance;
        let at = -1;
        for (let i = from + 1; i < to; ++i) {
            const line = opacityAt([samples[from]!, samples[to]!], samples[i]![0]);
            const distance = Math.abs(samples[i]![1] - line);
            if (distance > worst) {
                worst = distance;
                at = i;
            }
        }
        if (at >= 0) {
            keep.add(at);
            spans.push([from, at], [at, to]);
        }
    }
    return [...keep].sort((a, b) => a - b).map((i) => [rounded(samples[i]![0]), rounded(samples[i]![1])]);
}

export interface ValueRange {
    low: number;
    high: number;
}

/** A value to four digits of the range's width: as fine as a hand can aim. */
export function roundedValue(value: number, range: ValueRange): number {
    const width = Math.abs(range.high - range.low);
    if (!(width > 0)) return value;
    const digits = Math.min(100, Math.max(0, 3 - Math.floor(Math.log10(width))));
    return Number(value.toFixed(digits)) + 0;
}

/**
 * Window/level by dragging: to the right widens the window, upwards raises the level; a drag across the picture doubles or
 * shifts by the whole window. dx, dy in parts of the picture's size, y downwards.
 */
export function windowLevel(range: ValueRange, dx: number, dy: number): ValueRange {
    const width = range.high - range.low;
    const newWidth = Math.max(width * Math.pow(4, dx), Math.abs(width) * 1e-6);
    const centre = (range.high + range.low) / 2 - dy * width;
    return { low: centre - newWidth / 2, high: centre + newWidth / 2 };
}

export type Scale = "linear" | "log" | "symlog";

/** Position in [0, 1] of a value in the range, as the renderer places it. */
export function positionOf(value: number, range: ValueRange, scale: Scale): number {
    const warp = warpFor(range, scale);
    const low = warp(range.low);
    const high = warp(range.high);
    return high > low ? (warp(value) - low) / (high - low) : 0;
}

/** Inverse of positionOf for values inside the range, by bisection: every scale is monotonic. */
export function valueAt(position: number, range: ValueRange, scale: Scale): number {
    if (scale === "linear") return range.low + position * (range.high - range.low);
    let low = range.low;
    let high = range.high;
    for (let step = 0; step < 60; ++step) {
        const middle = (low + high) / 2;
        if (positionOf(middle, range, scale) < position) low = middle;
        else high = middle;
    }
    return (low + high) / 2;
}

function warpFor(range: ValueRange, scale: Scale): (value: number) => number {
    if (scale === "log") {
        const smallest = Math.max(range.low, range.high * 1e-6);
        return (value) => Math.log(Math.max(value, smallest));
    }
    if (scale === "symlog") {
        const threshold = 1e-3 * Math.max(Math.abs(range.low), Math.abs(range.high)) || 1;
        return (value) => Math.sign(value) * Math.log1p(Math.abs(value) / threshold);
    }
    return (value) => value;
}
