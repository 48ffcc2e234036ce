// The point that planes beside a volume have in common (server/engine/crosshair.h), in a cell's world and as style values.
import type { StyleValue } from "../api/types";
import { isFinite3 } from "./camera";
import { unitMatrix, type Vector } from "./vector";
import { extentAlong, type Extent, type VolumeBox } from "./volume_box";

/** Fractions of the drawn box along the world's axes, or world coordinates. */
export type CrosshairUnits = "fraction" | "world";

export function unitsOf(value: StyleValue | undefined): CrosshairUnits {
    return value === "world" ? "world" : "fraction";
}

function extentsOf(box: VolumeBox): [Extent, Extent, Extent] {
    return [extentAlong(box, unitMatrix[0]), extentAlong(box, unitMatrix[1]), extentAlong(box, unitMatrix[2])];
}

function each(extents: [Extent, Extent, Extent], of: (extent: Extent, axis: 0 | 1 | 2) => number): Vector {
    return [of(extents[0], 0), of(extents[1], 1), of(extents[2], 2)];
}

/** null: there is none. */
export function crosshairPoint(box: VolumeBox, value: StyleValue | undefined, units: CrosshairUnits): Vector | null {
    if (!isFinite3(value)) return null;
    if (units === "world") return value;
    return each(extentsOf(box), ({ low, high }, axis) => low + value[axis] * (high - low));
}

/** Held inside the box. */
export function crosshairValue(box: VolumeBox, point: Vector, units: CrosshairUnits): number[] {
    const rounded = (value: number): number => Number(value.toPrecision(10));
    const value = each(extentsOf(box), ({ low, high }, axis) => {
        const inside = Math.min(high, Math.max(low, point[axis]));
        if (units === "world") return rounded(inside);
        return high > low ? rounded((inside - low) / (high - low)) : 0.5;
    });
    return [...value];
}

/** The world's axes through the point, as far as the box reaches. */
export function crosshairAxes(box: VolumeBox, point: Vector): [Vector, Vector][] {
    const extents = extentsOf(box);
    return ([0, 1, 2] as const).map((axis) => {
        const end = (at: number): Vector => each(extents, (_, other) => (other === axis ? at : point[other]));
        return [end(extents[axis].low), end(extents[axis].high)];
    });
}
