// The drawn box of a cell's volume: a parallelepiped in the world (crystals need not be rectangular).
import { add, dot, length, mean, scaled, solved, subtract, type Matrix, type Vector } from "./vector";

export interface VolumeBox {
    /** First corner, world units. */
    origin: Vector;
    /** From the first corner along the volume's axes, world units. */
    edges: Matrix;
    /** Of the drawn box of a dataset: how many voxels long each edge is. */
    voxels?: Vector;
    /** And how many voxels from the first corner the first sample sits. */
    firstSample?: Vector;
    /** Of crystals: the vectors a, b, c that Miller indices refer to. */
    lattice?: Matrix;
}

/** The corners' numbers: bit 0, 1, 2 set means at the far end of axis 0, 1, 2. */
export const boxEdges: readonly (readonly [number, number])[] = [0, 1, 2, 3, 4, 5, 6, 7].flatMap((corner) =>
    [1, 2, 4].filter((bit) => (corner & bit) === 0).map((bit) => [corner, corner | bit] as const),
);

/** fractions: 0 at the first corner, 1 at the far end of each axis. */
export function pointAt(box: VolumeBox, fractions: Vector): Vector {
    return box.edges.reduce<Vector>((point, edge, axis) => add(point, scaled(edge, fractions[axis]!)), box.origin);
}

export function fractionsOf(box: VolumeBox, point: Vector): Vector {
    return solved(box.edges, subtract(point, box.origin));
}

export function boxCorners(box: VolumeBox): Vector[] {
    return [0, 1, 2, 3, 4, 5, 6, 7].map((corner) => pointAt(box, [corner & 1, (corner >> 1) & 1, (corner >> 2) & 1]));
}

export function boxCentre(box: VolumeBox): Vector {
    return pointAt(box, [0.5, 0.5, 0.5]);
}

/** Of the sphere about the centre through the farthest corner: the camera's unit of length. */
export function boundingRadius(box: VolumeBox): number {
    const centre = boxCentre(box);
    return Math.max(...boxCorners(box).map((corner) => length(subtract(corner, centre))));
}

export function shortestEdge(box: VolumeBox): number {
    return Math.min(...box.edges.map(length));
}

export interface Extent {
    low: number;
    high: number;
}

/** Of the box along a direction of unit length, from the world's origin. */
export function extentAlong(box: VolumeBox, direction: Vector): Extent {
    const along = boxCorners(box).map((corner) => dot(corner, direction));
    return { low: Math.min(...along), high: Math.max(...along) };
}

/** Where the box is lowest along a direction: a corner, or the middle of an edge or a face. */
export function supportPoint(box: VolumeBox, direction: Vector): Vector {
    const { low, high } = extentAlong(box, direction);
    const tolerance = 1e-9 * Math.max(high - low, Number.MIN_VALUE);
    return mean(boxCorners(box).filter((corner) => dot(corner, direction) - low <= tolerance));
}

/** The box that is a part of another one, given by fractions of it. */
export function partOfBox(box: VolumeBox, low: Vector, high: Vector): VolumeBox {
    const edge = (axis: 0 | 1 | 2): Vector => scaled(box.edges[axis], high[axis] - low[axis]);
    return { origin: pointAt(box, low), edges: [edge(0), edge(1), edge(2)] };
}

/** A box along the world's axes. */
export function uprightBox(low: Vector, high: Vector): VolumeBox {
    return {
        origin: low,
        edges: [
            [high[0] - low[0], 0, 0],
            [0, high[1] - low[1], 0],
            [0, 0, high[2] - low[2]],
        ],
    };
}
