// What is cut away, as the style keys say it (server/sheet/typed_style.h, ClipStyle).
import type { StyleValue } from "../camera";
import { rowsOf } from "../number_rows";

export type ClipUnits = "fraction" | "world";

/** nx, ny, nz, position: what lies beyond the plane, along its normal, is kept. */
export type PlaneRow = readonly [number, number, number, number];
/** x0, x1, y0, y1, z0, z1: the inside is kept. */
export type BoxRow = readonly [number, number, number, number, number, number];
/** tx, ty, tz, rx, ry, rz (degrees), sx, sy, sz: scale, then rotation about x, y, z, then translation. */
export type TransformRow = readonly number[];

export const noTransform: TransformRow = [0, 0, 0, 0, 0, 0, 1, 1, 1];
export const mostPlanes = 8;

export interface Clip {
    units: ClipUnits;
    planes: PlaneRow[];
    box: BoxRow | null;
    /** Empty: none. */
    shape: string;
    transform: TransformRow;
}

/** \param value  of a style key, as it shows in the cell */
export function clipOf(value: (key: string) => StyleValue | undefined): Clip {
    const shape = value("clip.shape");
    return {
        units: value("clip.units") === "world" ? "world" : "fraction",
        planes: (rowsOf(value("clip.planes"), 4) ?? []) as unknown as PlaneRow[],
        box: ((rowsOf(value("clip.box"), 6) ?? [])[0] as unknown as BoxRow | undefined) ?? null,
        shape: typeof shape === "string" && shape !== "none" ? shape : "",
        transform: (rowsOf(value("clip.transform"), 9) ?? [])[0] ?? noTransform,
    };
}

export function hasClip(clip: Clip): boolean {
    return clip.planes.length > 0 || clip.box !== null || clip.shape !== "";
}

/** Figures that say no more than a hand can aim: four decimals of a fraction, six digits of a length. */
export function roundedPosition(value: number, units: ClipUnits): number {
    return units === "fraction" ? Math.round(value * 1e4) / 1e4 + 0 : Number(value.toPrecision(6));
}
