// The clip box in the world of one cell, and its six faces.
import type { Vector } from "../vector";
import { boxCentre, extentAlong, fractionsOf, partOfBox, pointAt, uprightBox, type Extent, type VolumeBox } from "../volume_box";
import { roundedPosition, type BoxRow, type ClipUnits } from "./clip";

export function clipBoxInWorld(row: BoxRow, units: ClipUnits, box: VolumeBox): VolumeBox {
    const low: Vector = [row[0], row[2], row[4]];
    const high: Vector = [row[1], row[3], row[5]];
    return units === "fraction" ? partOfBox(box, low, high) : uprightBox(low, high);
}

/** The box within which the clip box's faces are dragged. */
export function clipBoxLimits(units: ClipUnits, box: VolumeBox): VolumeBox {
    if (units === "fraction") return box;
    const extents = ([[1, 0, 0], [0, 1, 0], [0, 0, 1]] as const).map((axis) => extentAlong(box, axis));
    return uprightBox(extents.map(({ low }) => low) as unknown as Vector, extents.map(({ high }) => high) as unknown as Vector);
}

/** Opposite faces stay this far apart, in parts of the limits. */
const thinnest = 0.01;

/** \param face  0 to 5, in the order of the row  \param part  0 to 1 along the limits' axis */
export function withFace(row: BoxRow, face: number, part: number, units: ClipUnits, box: VolumeBox): BoxRow {
    const axis = face >> 1;
    const extent = faceExtent(axis, units, box);
    const gap = thinnest * (extent.high - extent.low);
    const wanted = extent.low + part * (extent.high - extent.low);
    const value = face % 2 === 0 ? Math.min(wanted, row[face + 1]! - gap) : Math.max(wanted, row[face - 1]! + gap);
    return row.map((old, i) => (i === face ? roundedPosition(value, units) : old)) as unknown as BoxRow;
}

/** Where a face stands along the limits' axis: 0 to 1 inside them. */
export function facePart(row: BoxRow, face: number, units: ClipUnits, box: VolumeBox): number {
    const { low, high } = faceExtent(face >> 1, units, box);
    return (row[face]! - low) / (high - low);
}

function faceExtent(axis: number, units: ClipUnits, box: VolumeBox): Extent {
    if (units === "fraction") return { low: 0, high: 1 };
    const limits = clipBoxLimits(units, box);
    const low = limits.origin[axis]!;
    return { low, high: low + limits.edges[axis]![axis]! };
}

/** The way of a face's middle while only that face moves. */
export function facePath(row: BoxRow, face: number, units: ClipUnits, box: VolumeBox): (part: number) => Vector {
    const limits = clipBoxLimits(units, box);
    const axis = face >> 1;
    const middle = fractionsOf(limits, boxCentre(clipBoxInWorld(row, units, box)));
    return (part) => pointAt(limits, [0, 1, 2].map((i) => (i === axis ? part : middle[i]!)) as unknown as Vector);
}

export function middleBox(units: ClipUnits, box: VolumeBox): BoxRow {
    const limits = clipBoxLimits(units, box);
    const ends = ([0, 1, 2] as const).flatMap((axis) => {
        if (units === "fraction") return [0.1, 0.9];
        const low = limits.origin[axis];
        const edge = limits.edges[axis][axis];
        return [roundedPosition(low + 0.1 * edge, units), roundedPosition(low + 0.9 * edge, units)];
    });
    return ends as unknown as BoxRow;
}
