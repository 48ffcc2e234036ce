// A clip plane in the world of one cell, and the cut that it makes.
import { add, cross, dot, length, mean, normalized, scaled, subtract, type Vector } from "../vector";
import { boxCentre, boxCorners, boxEdges, extentAlong, supportPoint, type Extent, type VolumeBox } from "../volume_box";
import { roundedPosition, type ClipUnits, type PlaneRow } from "./clip";

export interface WorldPlane {
    /** Unit length. */
    normal: Vector;
    /** World units from the world's origin, along the normal. */
    offset: number;
}

function roundedVector(vector: Vector): Vector {
    return [0, 1, 2].map((i) => Math.round(vector[i]! * 1e4) / 1e4 + 0) as unknown as Vector;
}

function positionExtent(normal: Vector, units: ClipUnits, box: VolumeBox): Extent {
    return units === "fraction" ? extentAlong(box, normal) : { low: 0, high: 1 };
}

/** null: the normal has no direction. */
export function worldPlane(row: PlaneRow, units: ClipUnits, box: VolumeBox): WorldPlane | null {
    const given: Vector = [row[0], row[1], row[2]];
    if (!(length(given) > 0)) return null;
    const normal = normalized(given);
    const { low, high } = positionExtent(normal, units, box);
    return { normal, offset: low + row[3] * (high - low) };
}

export function planeRow(plane: WorldPlane, units: ClipUnits, box: VolumeBox): PlaneRow {
    const normal = roundedVector(plane.normal);
    const { low, high } = positionExtent(normalized(normal), units, box);
    return [...normal, roundedPosition((plane.offset - low) / (high - low), units)];
}

/** The corners of the cut through a box, in order about it; empty where the plane misses the box. */
export function cutPolygon(plane: WorldPlane, box: VolumeBox): Vector[] {
    const corners = boxCorners(box);
    const above = corners.map((corner) => dot(corner, plane.normal) - plane.offset);
    const tolerance = 1e-9 * Math.max(...box.edges.map(length));
    const points = corners.filter((_, i) => Math.abs(above[i]!) <= tolerance);
    for (const [from, to] of boxEdges) {
        const a = above[from]!;
        const b = above[to]!;
        if (Math.abs(a) <= tolerance || Math.abs(b) <= tolerance || a > 0 === b > 0) continue;
        points.push(add(corners[from]!, scaled(subtract(corners[to]!, corners[from]!), a / (a - b))));
    }
    if (points.length < 3) return [];
    const centre = mean(points);
    const first = normalized(subtract(points[0]!, centre));
    const second = cross(plane.normal, first);
    const angle = (point: Vector): number => {
        const offset = subtract(point, centre);
        return Math.atan2(dot(offset, second), dot(offset, first));
    };
    return points.sort((a, b) => angle(a) - angle(b));
}

/** Of a flat polygon's area. */
function polygonCentre(points: readonly Vector[]): Vector {
    const middle = mean(points);
    let centre: Vector = [0, 0, 0];
    let total = 0;
    points.forEach((point, i) => {
        const next = points[(i + 1) % points.length]!;
        const area = length(cross(subtract(point, middle), subtract(next, middle)));
        centre = add(centre, scaled(mean([middle, point, next]), area));
        total += area;
    });
    return total > 0 ? scaled(centre, 1 / total) : middle;
}

/** The middle of the cut; where the plane misses the box, the nearest point of the box. */
export function planeCentre(plane: WorldPlane, box: VolumeBox): Vector {
    const points = cutPolygon(plane, box);
    if (points.length) return polygonCentre(points);
    const { low } = extentAlong(box, plane.normal);
    return plane.offset <= low ? supportPoint(box, plane.normal) : supportPoint(box, scaled(plane.normal, -1));
}

/** Through the middle of the box, keeping what is behind it as the viewer sees it. */
export function facingPlane(towardsEye: Vector, units: ClipUnits, box: VolumeBox): PlaneRow {
    const normal = scaled(towardsEye, -1);
    return planeRow({ normal, offset: dot(normal, boxCentre(box)) }, units, box);
}
