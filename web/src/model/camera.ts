// The camera as the style keys describe it, and what gestures do to it. Angles in degrees; distance and target in bounding
// radii of the cell's dataset, so that one camera frames cells of any size.
//
// Azimuth 0 looks along +y with z up and x to the right; azimuth turns the eye counter-clockwise seen from above; elevation
// lifts the eye; roll turns the eye clockwise about its line of sight (so the picture turns the other way).
import { add, cross, dot, normalized, scaled, type Vector } from "./vector";

export interface Camera {
    azimuth: number;
    elevation: number;
    roll: number;
    distance: number;
    target: Vector;
    fov: number;
    projection: "perspective" | "orthographic";
}

export const defaultCamera: Camera = {
    azimuth: 30,
    elevation: 20,
    roll: 0,
    distance: 4,
    target: [0, 0, 0],
    fov: 30,
    projection: "perspective",
};

/** A half turn across one tile height. */
const orbitDegreesPerHeight = 180;
const distanceLimits: readonly [number, number] = [0.05, 100];

const radians = Math.PI / 180;

export interface Basis {
    right: Vector;
    up: Vector;
    towardsEye: Vector;
}

export function cameraBasis(camera: Camera): Basis {
    const az = camera.azimuth * radians;
    const el = camera.elevation * radians;
    const towardsEye: Vector = [Math.cos(el) * Math.sin(az), -Math.cos(el) * Math.cos(az), Math.sin(el)];
    const level: Vector = [Math.cos(az), Math.sin(az), 0];
    const upright = cross(towardsEye, level);
    const roll = camera.roll * radians;
    const right = add(scaled(level, Math.cos(roll)), scaled(upright, -Math.sin(roll)));
    return { right: normalized(right), up: normalized(cross(towardsEye, right)), towardsEye };
}

/** Bounding radii per pixel in the plane through the target. */
export function radiiPerPixel(camera: Camera, heightPixels: number): number {
    return (2 * camera.distance * Math.tan((camera.fov * radians) / 2)) / Math.max(1, heightPixels);
}

/** How a picture shows the world where it is looked at, in place of what the camera's angles say (technique plane). */
export interface FlatView {
    basis: Basis;
    /** World height of the picture in bounding radii when camera.distance is 1. */
    heightPerDistance: number;
}

function scaleOf(camera: Camera, heightPixels: number, flat?: FlatView): number {
    return flat ? (flat.heightPerDistance * camera.distance) / Math.max(1, heightPixels) : radiiPerPixel(camera, heightPixels);
}

function wrapDegrees(angle: number): number {
    const turned = (((angle + 180) % 360) + 360) % 360;
    return turned - 180;
}

function clamp(value: number, low: number, high: number): number {
    return Math.min(high, Math.max(low, value));
}

/** dx to the right and dy downwards in pixels: the object follows the pointer. */
export function orbited(camera: Camera, dx: number, dy: number, heightPixels: number): Camera {
    const perPixel = orbitDegreesPerHeight / Math.max(1, heightPixels);
    const cos = Math.cos(camera.roll * radians);
    const sin = Math.sin(camera.roll * radians);
    // A rolled camera still turns the object where the pointer goes.
    const acrossX = dx * cos - dy * sin;
    const acrossY = dx * sin + dy * cos;
    return {
        ...camera,
        azimuth: wrapDegrees(camera.azimuth - acrossX * perPixel),
        elevation: clamp(camera.elevation + acrossY * perPixel, -90, 90),
    };
}

export function panned(camera: Camera, dx: number, dy: number, heightPixels: number, flat?: FlatView): Camera {
    const { right, up } = flat?.basis ?? cameraBasis(camera);
    const perPixel = scaleOf(camera, heightPixels, flat);
    return { ...camera, target: add(camera.target, add(scaled(right, -dx * perPixel), scaled(up, dy * perPixel))) };
}

/**
 * factor > 1 comes closer. (x, y): pointer in pixels from the picture's centre, y downwards; what lies there in the target
 * plane stays under the pointer.
 */
export function zoomed(camera: Camera, factor: number, x = 0, y = 0, heightPixels = 1, flat?: FlatView): Camera {
    const distance = clamp(camera.distance / factor, distanceLimits[0], distanceLimits[1]);
    const before = scaleOf(camera, heightPixels, flat);
    const after = scaleOf({ ...camera, distance }, heightPixels, flat);
    const { right, up } = flat?.basis ?? cameraBasis(camera);
    const shift = add(scaled(right, x * (before - after)), scaled(up, -y * (before - after)));
    return { ...camera, distance, target: add(camera.target, shift) };
}

/** The picture turns by as much as the pointer about the picture's centre; all in pixels from the centre, y downwards. */
export function rolled(camera: Camera, fromX: number, fromY: number, toX: number, toY: number): Camera {
    const turn = Math.atan2(toY, toX) - Math.atan2(fromY, fromX);
    return { ...camera, roll: wrapDegrees(camera.roll - turn / radians) };
}

export function isFinite3(vector: unknown): vector is Vector {
    return Array.isArray(vector) && vector.length === 3 && vector.every((part) => Number.isFinite(part));
}

export type StyleValue = string | number | boolean | null | StyleValue[];
export type StylePatch = Record<string, StyleValue>;

/** Camera from values of the style keys; what is missing comes from `base`. */
export function cameraFromStyle(style: StylePatch, base: Camera = defaultCamera): Camera {
    const number = (key: string, fallback: number): number => {
        const value = style[key];
        return typeof value === "number" && Number.isFinite(value) ? value : fallback;
    };
    const target = style["camera.target"];
    return {
        azimuth: number("camera.azimuth", base.azimuth),
        elevation: number("camera.elevation", base.elevation),
        roll: number("camera.roll", base.roll),
        distance: number("camera.distance", base.distance),
        target: isFinite3(target) ? target : base.target,
        fov: number("camera.fov", base.fov),
        projection: style["camera.projection"] === "orthographic" ? "orthographic" : base.projection,
    };
}

function rounded(value: number): number {
    return Math.round(value * 1e5) / 1e5;
}

/** The keys that gestures change. */
export function styleFromCamera(camera: Camera): StylePatch {
    return {
        "camera.azimuth": rounded(camera.azimuth),
        "camera.elevation": rounded(camera.elevation),
        "camera.roll": rounded(camera.roll),
        "camera.distance": rounded(camera.distance),
        "camera.target": camera.target.map(rounded),
    };
}

/** Used by tests and by the orientation cube: screen coordinates (x right, y up) of a world direction. */
export function projectDirection(camera: Camera, direction: Vector): [number, number, number] {
    const { right, up, towardsEye } = cameraBasis(camera);
    return [dot(right, direction), dot(up, direction), dot(towardsEye, direction)];
}
