// Where technique plane cuts a cell's volume, and how far one step of a voxel takes it (server/engine/plane_resolver.h).
import type { CellState, StylePatch, StyleValue } from "../api/types";
import { isFinite3 } from "./camera";
import { crosshairPoint, crosshairValue, unitsOf } from "./crosshair";
import { reciprocalVector } from "./lattice";
import { isPlane } from "./plane_view";
import { add, cross, dot, length, normalized, scaled, type Matrix, type Vector } from "./vector";
import { extentAlong, pointAt, type VolumeBox } from "./volume_box";

const worldAxes: Matrix = [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
];
const axisNumber: Record<string, 0 | 1 | 2> = { sagittal: 0, coronal: 1, axial: 2 };

/** A style key's value as the cell shows it now. */
export type ShownValue = (key: string) => StyleValue | undefined;

/** The side to which positions rise; of unit length. */
export function planeNormal(box: VolumeBox, shown: ShownValue): Vector {
    const axis = shown("plane.axis");
    if (axis === "hkl") {
        const across = reciprocalVector(box.lattice, shown("plane.hkl"));
        return across ? normalized(across) : worldAxes[2];
    }
    if (axis !== "custom") return worldAxes[axisNumber[String(axis)] ?? 2];
    const normal = shown("plane.normal");
    return isFinite3(normal) && length(normal) > 0 ? normalized(normal) : worldAxes[2];
}

/** Distances along the normal at which the plane may stand, one step apart. */
interface Steps {
    /** Of one plane of samples, or of the lattice; null: the normal is oblique to them, and every place is as good. */
    sample: number | null;
    step: number;
}

/** Index steps along each of the volume's axes per world unit along a direction. */
function indicesAlong(box: VolumeBox, voxels: Vector, direction: Vector): Vector {
    const [a, b, c] = voxelEdges(box, voxels);
    const volume = dot(a, cross(b, c));
    return [dot(direction, cross(b, c)) / volume, dot(direction, cross(c, a)) / volume, dot(direction, cross(a, b)) / volume];
}

function voxelEdges(box: VolumeBox, voxels: Vector): Matrix {
    return [scaled(box.edges[0], 1 / voxels[0]), scaled(box.edges[1], 1 / voxels[1]), scaled(box.edges[2], 1 / voxels[2])];
}

/** The axis whose planes of samples are at right angles to a direction. */
function layeredAxis(box: VolumeBox, direction: Vector): number {
    const [a, b, c] = box.edges;
    return [cross(b, c), cross(c, a), cross(a, b)].findIndex((face) => length(cross(normalized(face), direction)) < 1e-6);
}

/** The whole number of steps nearest to a voxel's between neighbouring planes of the set, one of them through a lattice point. */
function latticeSteps(box: VolumeBox, shown: ShownValue, oneVoxel: number): Steps | null {
    const across = reciprocalVector(box.lattice, shown("plane.hkl"));
    if (!across) return null;
    const spacing = 1 / length(across);
    const shift = shown("periodic.shift");
    const periods = shown("periodic.replicate");
    const fractions = [0, 1, 2].map((axis) => (isFinite3(shift) ? shift[axis]! : 0) / (isFinite3(periods) ? periods[axis]! : 1));
    const point = pointAt(box, fractions as unknown as Vector);
    return { sample: dot(normalized(across), point), step: spacing / Math.max(1, Math.round(spacing / oneVoxel)) };
}

function stepsAlong(box: VolumeBox, normal: Vector, shown: ShownValue): Steps | null {
    const { voxels, firstSample } = box;
    if (!voxels || !firstSample) return null;
    const indices = indicesAlong(box, voxels, normal);
    if (shown("plane.axis") === "hkl") return latticeSteps(box, shown, 1 / Math.max(...indices.map(Math.abs)));
    const axis = layeredAxis(box, normal);
    if (axis < 0) return { sample: null, step: 1 / Math.max(...indices.map(Math.abs)) };
    const first = pointAt(box, [firstSample[0] / voxels[0], firstSample[1] / voxels[1], firstSample[2] / voxels[2]]);
    return { sample: dot(normal, first), step: 1 / Math.abs(indices[axis]!) };
}

const tolerance = 1e-6;

/** From one place to another, a whole number of steps away; held at the last one inside the box. */
function steppedOffset(offset: number, by: number, { sample, step }: Steps, low: number, high: number): number {
    if (sample === null) return Math.min(high, Math.max(low, offset + by * step));
    const at = (offset - sample) / step;
    // From between two planes of samples, the first step goes to the next one.
    const wanted = by > 0 ? Math.floor(at + tolerance) + by : Math.ceil(at - tolerance) + by;
    const first = Math.ceil((low - sample) / step - tolerance);
    const last = Math.floor((high - sample) / step + tolerance);
    return sample + step * Math.min(last, Math.max(first, wanted));
}

/** Enough for millions of steps, and short to read. */
function rounded(value: number): number {
    return Number(value.toPrecision(10));
}

function clamp01(value: number): number {
    return Math.min(1, Math.max(0, value));
}

/** Where the plane stands along its normal, and between which ends; null: the cell shows no plane. */
interface Placed {
    box: VolumeBox;
    normal: Vector;
    low: number;
    high: number;
    offset: number;
    crosshair: Vector | null;
}

function placed(cell: CellState | undefined, shown: ShownValue): Placed | null {
    const box = cell?.box;
    const position = shown("plane.position");
    if (!box || !isPlane(cell) || cell.state !== "ok" || typeof position !== "number") return null;
    const normal = planeNormal(box, shown);
    const { low, high } = extentAlong(box, normal);
    if (high <= low) return null;
    const crosshair = crosshairPoint(box, shown("plane.crosshair"), unitsOf(shown("plane.units")));
    return { box, normal, low, high, offset: crosshair ? dot(normal, crosshair) : low + position * (high - low), crosshair };
}

/** What puts the plane at another place along its normal: its position, or the crosshair that it passes through. */
function placedAt({ box, normal, low, high, offset, crosshair }: Placed, shown: ShownValue, next: number): StylePatch {
    if (!crosshair) return { "plane.position": rounded(clamp01((next - low) / (high - low))) };
    return { "plane.crosshair": crosshairValue(box, add(crosshair, scaled(normal, next - offset)), unitsOf(shown("plane.units"))) };
}

/** \param by  voxels along the plane's normal. null: the cell shows no plane, or cannot go on */
export function steppedPlane(cell: CellState | undefined, shown: ShownValue, by: number): StylePatch | null {
    const place = placed(cell, shown);
    const steps = place && stepsAlong(place.box, place.normal, shown);
    if (!place || !steps) return null;
    const next = steppedOffset(place.offset, by, steps, place.low, place.high);
    return Math.abs(next - place.offset) < tolerance * steps.step ? null : placedAt(place, shown, next);
}

/** From 0 to 1 through the box, also where a crosshair decides. null: the cell shows no plane */
export function positionOfPlane(cell: CellState | undefined, shown: ShownValue): number | null {
    const place = placed(cell, shown);
    return place && rounded(clamp01((place.offset - place.low) / (place.high - place.low)));
}

/** null: the cell shows no plane */
export function planeMovedTo(cell: CellState | undefined, shown: ShownValue, position: number): StylePatch | null {
    const place = placed(cell, shown);
    return place && placedAt(place, shown, place.low + position * (place.high - place.low));
}
