// Turning a direction by dragging the tip of its arrow: the tip moves on a ball seen from the front, and follows the pointer.
import type { Basis } from "../camera";
import { add, dot, normalized, scaled, type Vector } from "../vector";

/** Right, up and towards the viewer. */
export type ViewDirection = Vector;

export function directionInView(basis: Basis, direction: Vector): ViewDirection {
    return [dot(basis.right, direction), dot(basis.up, direction), dot(basis.towardsEye, direction)];
}

export function directionInWorld(basis: Basis, direction: ViewDirection): Vector {
    return normalized(
        add(add(scaled(basis.right, direction[0]), scaled(basis.up, direction[1])), scaled(basis.towardsEye, direction[2])),
    );
}

/**
 * The direction whose tip lies at (x, y), in radii of the ball from its middle, y upwards. front: the half of the ball on
 * which the drag began; going out over its rim leads to the other half.
 */
export function directionAt(x: number, y: number, front: boolean): ViewDirection {
    const out = Math.hypot(x, y);
    const side = front ? 1 : -1;
    if (out <= 1) return [x, y, side * Math.sqrt(1 - out * out)];
    const back = Math.max(0, 2 - out);
    return [(x / out) * back, (y / out) * back, -side * Math.sqrt(1 - back * back)];
}
