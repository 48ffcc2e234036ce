// The clip object's place in the world of one cell: moved, turned and scaled.
import { add, applied, product, rotation, scaled, subtract, type Matrix, type Vector } from "../vector";
import { boxCentre, shortestEdge, type VolumeBox } from "../volume_box";
import { roundedPosition, type ClipUnits, type TransformRow } from "./clip";

const radians = Math.PI / 180;

/** Where the clip object's own coordinates lie in the world. */
export interface ObjectFrame {
    centre: Vector;
    axes: Matrix;
}

/** What the transform's numbers count from and in: fractions are of half the shortest edge, about the box's centre. */
function transformBase(units: ClipUnits, box: VolumeBox): { origin: Vector; unit: number } {
    return units === "fraction" ? { origin: boxCentre(box), unit: shortestEdge(box) / 2 } : { origin: [0, 0, 0], unit: 1 };
}

function part(row: TransformRow, at: 0 | 3 | 6): Vector {
    return [row[at] ?? 0, row[at + 1] ?? 0, row[at + 2] ?? 0];
}

export function rotationOf(row: TransformRow): Matrix {
    const [x, y, z] = part(row, 3);
    const about = (axis: Vector, degrees: number): Matrix => rotation(axis, degrees * radians);
    return product(about([0, 0, 1], z), product(about([0, 1, 0], y), about([1, 0, 0], x)));
}

export function objectFrame(row: TransformRow, units: ClipUnits, box: VolumeBox): ObjectFrame {
    const { origin, unit } = transformBase(units, box);
    const turn = rotationOf(row);
    const scale = part(row, 6);
    return {
        centre: add(origin, scaled(part(row, 0), unit)),
        axes: [scaled(turn[0], scale[0] * unit), scaled(turn[1], scale[1] * unit), scaled(turn[2], scale[2] * unit)],
    };
}

export function toWorld(frame: ObjectFrame, point: Vector): Vector {
    return add(frame.centre, applied(frame.axes, point));
}

export function withCentre(row: TransformRow, centre: Vector, units: ClipUnits, box: VolumeBox): TransformRow {
    const { origin, unit } = transformBase(units, box);
    const moved = scaled(subtract(centre, origin), 1 / unit).map((value) => roundedPosition(value, units));
    return [...moved, ...row.slice(3)];
}

/** Turned further, about the world's directions. */
export function withTurn(row: TransformRow, turn: Matrix): TransformRow {
    const [x, y, z] = product(turn, rotationOf(row));
    // The rotation about z, y and x, in this order from the left, that has these columns.
    const aboutY = Math.asin(Math.min(1, Math.max(-1, -x[2])));
    const flat = Math.abs(Math.cos(aboutY)) < 1e-9;
    const aboutX = flat ? Math.atan2(-z[1], y[1]) : Math.atan2(y[2], z[2]);
    const aboutZ = flat ? 0 : Math.atan2(x[1], x[0]);
    const angles = [aboutX, aboutY, aboutZ].map((angle) => Math.round((angle / radians) * 100) / 100 + 0);
    return [...row.slice(0, 3), ...angles, ...row.slice(6)];
}

export function withScale(row: TransformRow, factor: number): TransformRow {
    const limited = Math.min(1e3, Math.max(1e-3, factor));
    return [...row.slice(0, 6), ...row.slice(6).map((value) => Number((value * limited).toPrecision(4)))];
}

/** Of half the box's shortest edge, standing in the side that faces the viewer. */
export function facingObject(towardsEye: Vector, units: ClipUnits, box: VolumeBox): TransformRow {
    const half = shortestEdge(box) / 2;
    const centre = add(boxCentre(box), scaled(towardsEye, 0.75 * half));
    const size = units === "fraction" ? 0.75 : Number((0.75 * half).toPrecision(4));
    return withCentre([0, 0, 0, 0, 0, 0, size, size, size], centre, units, box);
}
