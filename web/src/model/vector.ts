// Just enough 3-vector arithmetic for cameras and clipping.

export type Vector = readonly [number, number, number];

/** Three columns: where a linear map takes x, y and z. */
export type Matrix = readonly [Vector, Vector, Vector];

export const unitMatrix: Matrix = [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
];

export function add(a: Vector, b: Vector): Vector {
    return [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
}

export function subtract(a: Vector, b: Vector): Vector {
    return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

export function scaled(a: Vector, factor: number): Vector {
    return [a[0] * factor, a[1] * factor, a[2] * factor];
}

export function dot(a: Vector, b: Vector): number {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

export function cross(a: Vector, b: Vector): Vector {
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

export function length(a: Vector): number {
    return Math.hypot(a[0], a[1], a[2]);
}

export function normalized(a: Vector): Vector {
    const size = length(a);
    return size > 0 ? scaled(a, 1 / size) : a;
}

export function mean(points: readonly Vector[]): Vector {
    return scaled(points.reduce(add, [0, 0, 0]), 1 / Math.max(1, points.length));
}

export function applied(matrix: Matrix, a: Vector): Vector {
    return add(add(scaled(matrix[0], a[0]), scaled(matrix[1], a[1])), scaled(matrix[2], a[2]));
}

/** First `b`, then `a`. */
export function product(a: Matrix, b: Matrix): Matrix {
    return [applied(a, b[0]), applied(a, b[1]), applied(a, b[2])];
}

/** The solution of matrix * a = b; the columns must not lie in one plane. */
export function solved(matrix: Matrix, b: Vector): Vector {
    const [x, y, z] = matrix;
    const volume = dot(x, cross(y, z));
    return [dot(b, cross(y, z)) / volume, dot(x, cross(b, z)) / volume, dot(x, cross(y, b)) / volume];
}

/** Right-handed rotation about an axis of any length. */
export function rotation(axis: Vector, radians: number): Matrix {
    const [x, y, z] = normalized(axis);
    const c = Math.cos(radians);
    const s = Math.sin(radians);
    const t = 1 - c;
    return [
        [t * x * x + c, t * x * y + s * z, t * x * z - s * y],
        [t * x * y - s * z, t * y * y + c, t * y * z + s * x],
        [t * x * z + s * y, t * y * z - s * x, t * z * z + c],
    ];
}

/** The shortest turn that takes one direction of unit length to another. */
export function turnBetween(from: Vector, to: Vector): Matrix {
    const axis = cross(from, to);
    const sine = length(axis);
    if (sine > 1e-12) return rotation(axis, Math.atan2(sine, dot(from, to)));
    if (dot(from, to) > 0) return unitMatrix;
    const aside: Vector = Math.abs(from[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0];
    return rotation(cross(from, aside), Math.PI);
}
