// Lines that show a clip object, in its own coordinates (renderer/volume/clip_shapes.h).
import type { Vector } from "../vector";
import { boxCorners, boxEdges, uprightBox, type VolumeBox } from "../volume_box";

const circleSteps = 48;

/** A circle about one of the axes 0, 1, 2. */
function circle(axis: 0 | 1 | 2, radius: number, centre: Vector = [0, 0, 0]): Vector[] {
    return Array.from({ length: circleSteps + 1 }, (_, i) => {
        const angle = (2 * Math.PI * i) / circleSteps;
        const point: [number, number, number] = [...centre];
        point[(axis + 1) % 3]! += radius * Math.cos(angle);
        point[(axis + 2) % 3]! += radius * Math.sin(angle);
        return point;
    });
}

export function boxLines(box: VolumeBox): Vector[][] {
    const corners = boxCorners(box);
    return boxEdges.map(([from, to]) => [corners[from]!, corners[to]!]);
}

const sphere = ([0, 1, 2] as const).map((axis) => circle(axis, 1));
const sides = (points: readonly (readonly [number, number])[], low: number, high: number): Vector[][] =>
    points.map(([x, y]) => [
        [x, y, low],
        [x, y, high],
    ]);

const outlines: Record<string, Vector[][]> = {
    sphere,
    ellipsoid: sphere.map((line) => line.map(([x, y, z]): Vector => [x, 0.75 * y, 0.5 * z])),
    box: boxLines(uprightBox([-1, -1, -1], [1, 1, 1])),
    cylinder: [
        circle(2, 1, [0, 0, -1]),
        circle(2, 1, [0, 0, 1]),
        ...sides([[1, 0], [0, 1], [-1, 0], [0, -1]], -1, 1),
    ],
    torus: [
        circle(2, 1),
        circle(2, 0.4),
        circle(1, 0.3, [0.7, 0, 0]),
        circle(1, 0.3, [-0.7, 0, 0]),
        circle(0, 0.3, [0, 0.7, 0]),
        circle(0, 0.3, [0, -0.7, 0]),
    ],
};

export const shapeNames = Object.keys(outlines);

/** The name of the cell or dataset in a comparison such as "B1 > 0.4" or "'scan 2' <= -100"; null for anything else. */
export function comparedName(shape: string): string | null {
    const found = /^\s*(?:'([^']+)'|([^\s<>='][^<>=']*?))\s*[<>]=?\s*[-+.\d]/.exec(shape);
    return found ? (found[1] ?? found[2] ?? null) : null;
}

/** \param boxOf  the box of a cell or a dataset by its name; what is no formula is shown by the box that it fills */
export function shapeOutline(shape: string, boxOf: (name: string) => VolumeBox | null): Vector[][] {
    const known = outlines[shape];
    if (known) return known;
    const box = boxOf(comparedName(shape) ?? shape);
    return box ? boxLines(box) : [];
}
