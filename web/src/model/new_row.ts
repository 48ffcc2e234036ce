// What a row of numbers begins with when it is added.
import type { StyleKey } from "../api/types";
import type { Camera } from "./camera";
import { cameraBasis } from "./camera";
import type { ClipUnits } from "./clip/clip";
import { middleBox } from "./clip/clip_box";
import { facingPlane } from "./clip/clip_plane";
import { rowShape, rowsOf } from "./number_rows";
import { roundedValue, type ValueRange } from "./transfer";
import type { VolumeBox } from "./volume_box";

export interface RowContext {
    camera: Camera;
    units: ClipUnits;
    box: VolumeBox | null;
    range: ValueRange | null;
}

/** Above the last row's value, or in the middle of the range. */
function newValue(last: number | undefined, range: ValueRange): number {
    const width = range.high - range.low;
    const wanted = last === undefined ? range.low + width / 2 : last + width / 10;
    return roundedValue(wanted <= range.high ? wanted : (last ?? range.high) - width / 10, range);
}

export function newRow(key: StyleKey, rows: readonly (readonly number[])[], context: RowContext): number[] {
    const { columns, min, max } = rowShape(key);
    const last = rows[rows.length - 1];
    if (key.name === "isovalue" && context.range) return [newValue(last?.[0], context.range)];
    if (key.name === "clip.planes" && context.box) return [...facingPlane(cameraBasis(context.camera).towardsEye, context.units, context.box)];
    if (key.name === "clip.box" && context.box) return [...middleBox(context.units, context.box)];
    if (key.name === "light.direction") return [0.5, 0.5, 0.7];
    if (last) return [...last];
    const standard = rowsOf(key.default, columns)?.[0];
    return standard ?? Array.from({ length: columns }, () => Math.min(max, Math.max(min, 0)));
}
