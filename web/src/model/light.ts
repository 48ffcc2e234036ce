// Directions towards the lights, as the ball of the inspector shows them: seen by the viewer, whatever frame they are in.
import type { Camera, StyleValue } from "./camera";
import { cameraBasis } from "./camera";
import { directionInView, directionInWorld } from "./clip/arrow_ball";
import { rowsOf } from "./number_rows";
import { normalized, type Vector } from "./vector";

export type LightFrame = "view" | "world";

export const mostLights = 4;

export function lightsOf(value: StyleValue | undefined): Vector[] {
    return (rowsOf(value, 3) ?? []) as unknown as Vector[];
}

export function lightInView(direction: Vector, frame: LightFrame, camera: Camera): Vector {
    return normalized(frame === "view" ? direction : directionInView(cameraBasis(camera), direction));
}

export function lightFromView(direction: Vector, frame: LightFrame, camera: Camera): Vector {
    const found = frame === "view" ? normalized(direction) : directionInWorld(cameraBasis(camera), direction);
    return [0, 1, 2].map((i) => Math.round(found[i]! * 1e3) / 1e3 + 0) as unknown as Vector;
}
