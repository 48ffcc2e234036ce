// Lines in the world as SVG paths on a picture.
import { toPixel, type PictureView, type Pixel } from "../../model/projection";
import type { Vector } from "../../model/vector";
import { boxCorners, boxEdges, type VolumeBox } from "../../model/volume_box";

function command(first: boolean, { x, y }: Pixel): string {
    return `${first ? "M" : "L"}${x.toFixed(1)} ${y.toFixed(1)}`;
}

/** Pieces behind the eye are left out. */
export function linePath(view: PictureView, points: readonly Vector[]): string {
    let first = true;
    return points
        .map((point) => {
            const pixel = toPixel(view, point);
            const text = pixel ? command(first, pixel) : "";
            first = pixel === null;
            return text;
        })
        .join("");
}

export function closedPath(view: PictureView, points: readonly Vector[]): string {
    return points.length ? linePath(view, [...points, points[0]!]) : "";
}

export function boxPath(view: PictureView, box: VolumeBox): string {
    const corners = boxCorners(box);
    return boxEdges.map(([from, to]) => linePath(view, [corners[from]!, corners[to]!])).join("");
}
