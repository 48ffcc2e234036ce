// A clip plane on a picture: its cut through the volume, a disc that moves it and an arrow that turns it.
import { directionAt, directionInView, directionInWorld } from "../../model/clip/arrow_ball";
import type { PlaneRow } from "../../model/clip/clip";
import { cutPolygon, planeCentre, planeRow, worldPlane, type WorldPlane } from "../../model/clip/clip_plane";
import { formatNumber } from "../../model/format";
import { followPath, toPixel, type Pixel } from "../../model/projection";
import { applied, dot, rotation, scaled, add, type Vector } from "../../model/vector";
import { extentAlong } from "../../model/volume_box";
import type { StylePatch } from "../../api/types";
import type { HandlesContext } from "./ClipHandles";
import { Handle, HandleDisc, type KeyStep } from "./Handle";
import { closedPath } from "./outline";

const arrowPixels = 44;
/** Where the arrow points at the viewer its tip stands this far aside, so that disc and tip can both be pressed. */
const shortestArrowPixels = 24;

export function arrowTip(centre: Pixel, inView: Vector): Pixel {
    const across = Math.hypot(inView[0], inView[1]);
    const reach = Math.max(arrowPixels * across, shortestArrowPixels);
    const [x, y] = across > 1e-3 ? [inView[0] / across, inView[1] / across] : [Math.SQRT1_2, Math.SQRT1_2];
    return { x: centre.x + reach * x, y: centre.y - reach * y };
}

/** The pointer on the ball of the arrow, as far from the tip as where it was pressed. */
export function arrowDrag(start: Vector, pressed: Pixel): (pointer: Pixel) => Vector {
    const front = start[2] >= 0;
    return (pointer) => directionAt(start[0] + (pointer.x - pressed.x) / arrowPixels, start[1] - (pointer.y - pressed.y) / arrowPixels, front);
}

export function PlaneHandles({ context, row, index }: { context: HandlesContext; row: PlaneRow; index: number }) {
    const { view, box, clip } = context;
    const plane = worldPlane(row, clip.units, box);
    if (!plane) return null;
    const centre = planeCentre(plane, box);
    const disc = toPixel(view, centre);
    if (!disc) return null;
    const extent = extentAlong(box, plane.normal);
    const size = extent.high - extent.low;
    const part = Math.min(1, Math.max(0, (plane.offset - extent.low) / size));
    const inView = directionInView(view.basis, plane.normal);
    const tip = arrowTip(disc, inView);

    const at = (where: number): WorldPlane => ({ normal: plane.normal, offset: extent.low + where * size });
    const patch = (next: WorldPlane): StylePatch => ({
        "clip.planes": clip.planes.map((old, i) => [...(i === index ? planeRow(next, clip.units, box) : old)]),
    });
    /** About the middle of the cut. */
    const turned = (normal: Vector): StylePatch => patch({ normal, offset: dot(normal, centre) });
    const turnedBy = (step: KeyStep): StylePatch | null => {
        const axis = add(scaled(view.basis.up, step.x), scaled(view.basis.right, -step.y));
        const angle = Math.PI * Math.hypot(step.x, step.y);
        return angle > 0 ? turned(applied(rotation(axis, angle), plane.normal)) : null;
    };
    const remove = (): StylePatch => {
        const left = clip.planes.filter((_, i) => i !== index).map((old) => [...old]);
        return { "clip.planes": left.length ? left : "none" };
    };
    const common = { cell: context.cell, styleKey: "clip.planes", reachable: context.reachable };
    const outline = closedPath(view, cutPolygon(plane, box));
    return (
        <g>
            <path class="clip-outline filled" d={outline} />
            <path class="clip-arrow" d={`M${disc.x} ${disc.y}L${tip.x} ${tip.y}`} />
            <Handle
                {...common}
                name={`plane-${index}`}
                label={`Clip plane ${index + 1}: drag to move it; arrow keys, Delete`}
                now={Number(part.toFixed(4))}
                text={`position ${formatNumber(row[3])}`}
                drag={(pressed) => {
                    const follow = followPath(view, (where) => planeCentre(at(where), box), part, pressed);
                    return (pointer) => patch(at(follow(pointer)));
                }}
                keys={({ x, y }) => patch(at(Math.min(1, Math.max(0, part + x + y))))}
                remove={remove}
            >
                <HandleDisc at={disc} />
            </Handle>
            <Handle
                {...common}
                name={`plane-${index}-arrow`}
                label={`Direction of clip plane ${index + 1}: drag to turn it; arrow keys`}
                text={`normal ${row.slice(0, 3).map((value) => formatNumber(value, 3)).join(", ")}`}
                drag={(pressed) => {
                    const direction = arrowDrag(inView, pressed);
                    return (pointer) => turned(directionInWorld(view.basis, direction(pointer)));
                }}
                keys={turnedBy}
                remove={remove}
            >
                <HandleDisc at={tip} mark="tip" />
            </Handle>
        </g>
    );
}
