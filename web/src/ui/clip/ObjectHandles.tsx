// The clip object on a picture: its outline, and handles that move, turn and scale it.
import type { StylePatch } from "../../api/types";
import { directionInView, directionInWorld } from "../../model/clip/arrow_ball";
import type { TransformRow } from "../../model/clip/clip";
import { objectFrame, toWorld, withCentre, withScale, withTurn } from "../../model/clip/clip_object";
import { turnBetween, type Vector, add, length, normalized, rotation, scaled } from "../../model/vector";
import { formatNumber } from "../../model/format";
import { pixelsPerUnit, pointUnder, sightLine, toPixel, type Pixel } from "../../model/projection";
import { boundingRadius } from "../../model/volume_box";
import type { HandlesContext } from "./ClipHandles";
import { Handle, HandleDisc } from "./Handle";
import { linePath } from "./outline";
import { arrowDrag, arrowTip } from "./PlaneHandles";

const ringPixels = 58;
const shortestScalePixels = 26;
/** Right and down. */
const scaleDirection = { x: Math.SQRT1_2, y: Math.SQRT1_2 };

function angleFrom(centre: Pixel, at: Pixel): number {
    return Math.atan2(centre.y - at.y, at.x - centre.x);
}

export function ObjectHandles({ context, outline }: { context: HandlesContext; outline: readonly Vector[][] }) {
    const { view, box, clip } = context;
    const frame = objectFrame(clip.transform, clip.units, box);
    const disc = toPixel(view, frame.centre);
    if (!disc) return null;
    const perUnit = pixelsPerUnit(view, frame.centre);
    const axisInView = directionInView(view.basis, normalized(frame.axes[2]));
    const tip = arrowTip(disc, axisInView);
    const largest = Math.max(...frame.axes.map(length)) * perUnit;
    const reach = Math.min(Math.max(largest, shortestScalePixels), Math.min(view.width, view.height) * 0.45);
    const corner = { x: disc.x + reach * scaleDirection.x, y: disc.y + reach * scaleDirection.y };
    const diameter = 2 * boundingRadius(box);

    const patch = (row: TransformRow): StylePatch => ({ "clip.transform": [...row] });
    const movedTo = (centre: Vector): StylePatch => patch(withCentre(clip.transform, centre, clip.units, box));
    const rolled = (angle: number): StylePatch => patch(withTurn(clip.transform, rotation(view.basis.towardsEye, angle)));
    const common = {
        cell: context.cell,
        styleKey: "clip.transform",
        reachable: context.reachable,
        remove: () => ({ "clip.shape": "none" }),
    };
    const drawn = outline.map((line) => linePath(view, line.map((point) => toWorld(frame, point)))).join("");
    return (
        <g>
            <path class="clip-outline" d={drawn} />
            <path class="clip-arrow" d={`M${disc.x} ${disc.y}L${tip.x} ${tip.y}`} />
            <Handle
                {...common}
                name="object-turn"
                label="Clip object: drag the ring to turn it about the line of sight; arrow keys"
                text={`turned by ${clip.transform.slice(3, 6).map((value) => formatNumber(value)).join(", ")} degrees`}
                drag={(pressed) => (pointer) => rolled(angleFrom(disc, pointer) - angleFrom(disc, pressed))}
                keys={({ x, y }) => rolled(-Math.PI * (x + y))}
            >
                <circle class="ring-target" cx={disc.x} cy={disc.y} r={ringPixels} />
                <circle class="ring-mark" cx={disc.x} cy={disc.y} r={ringPixels} />
            </Handle>
            <Handle
                {...common}
                name="object-axis"
                label="Axis of the clip object: drag to turn it; arrow keys"
                text={`turned by ${clip.transform.slice(3, 6).map((value) => formatNumber(value)).join(", ")} degrees`}
                drag={(pressed) => {
                    const from = directionInWorld(view.basis, axisInView);
                    const direction = arrowDrag(axisInView, pressed);
                    return (pointer) => patch(withTurn(clip.transform, turnBetween(from, directionInWorld(view.basis, direction(pointer)))));
                }}
                keys={({ x, y }) => {
                    const axis = add(scaled(view.basis.up, x), scaled(view.basis.right, -y));
                    return x || y ? patch(withTurn(clip.transform, rotation(axis, Math.PI * Math.hypot(x, y)))) : null;
                }}
            >
                <HandleDisc at={tip} mark="tip" />
            </Handle>
            <Handle
                {...common}
                name="object-scale"
                label="Size of the clip object: drag to scale it; arrow keys"
                text={`scaled by ${clip.transform.slice(6).map((value) => formatNumber(value)).join(", ")}`}
                drag={(pressed) => {
                    const start = Math.max(1, Math.hypot(pressed.x - disc.x, pressed.y - disc.y));
                    return (pointer) => patch(withScale(clip.transform, Math.hypot(pointer.x - disc.x, pointer.y - disc.y) / start));
                }}
                keys={({ x, y }) => patch(withScale(clip.transform, 1 + x + y))}
            >
                <HandleDisc at={corner} mark="square" />
            </Handle>
            <Handle
                {...common}
                name="object-centre"
                label="Clip object: drag to move it, with Shift along the line of sight; arrow keys, Page Up, Page Down, Delete"
                text={`at ${clip.transform.slice(0, 3).map((value) => formatNumber(value)).join(", ")}`}
                drag={(pressed, event) => {
                    const sight = sightLine(view, frame.centre);
                    if (event.shiftKey) return (pointer) => movedTo(add(frame.centre, scaled(sight, (pressed.y - pointer.y) / perUnit)));
                    return (pointer) => movedTo(pointUnder(view, { x: disc.x + pointer.x - pressed.x, y: disc.y + pointer.y - pressed.y }, frame.centre));
                }}
                keys={({ x, y, z }) => {
                    const across = add(scaled(view.basis.right, x), scaled(view.basis.up, y));
                    return movedTo(add(frame.centre, scaled(add(across, scaled(sightLine(view, frame.centre), z)), diameter)));
                }}
            >
                <HandleDisc at={disc} />
            </Handle>
        </g>
    );
}
