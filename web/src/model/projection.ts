// From the world to the pixels of a cell's picture and back, as the server's camera does it (server/sheet/camera.h,
// server/engine/cell_resolver.h).
import { cameraBasis, type Basis, type Camera } from "./camera";
import { add, dot, scaled, subtract, type Vector } from "./vector";
import { boundingRadius, boxCentre, type VolumeBox } from "./volume_box";

export interface Pixel {
    x: number;
    /** Downwards, from the picture's upper edge. */
    y: number;
}

export interface PictureView {
    basis: Basis;
    eye: Vector;
    perspective: boolean;
    /** Half the picture's height at distance 1 (perspective), or anywhere (orthographic); world units. */
    halfHeight: number;
    width: number;
    height: number;
}

/** What the camera's lengths refer to: a cell's own volume, or what linked cells have together. World units. */
export interface CameraFrame {
    centre: Vector;
    radius: number;
    /** Of the upright box whose longest edge pictures of planes show; null: the cell's own box fits. */
    size?: Vector | null;
}

export function ownFrame(box: VolumeBox): CameraFrame {
    return { centre: boxCentre(box), radius: boundingRadius(box) };
}

/** \param width, height  of the picture, in the pixels that the results are in */
export function pictureView(
    camera: Camera,
    box: VolumeBox,
    width: number,
    height: number,
    frame: CameraFrame = ownFrame(box),
): PictureView {
    const basis = cameraBasis(camera);
    const { radius } = frame;
    const target = add(frame.centre, scaled(camera.target, radius));
    const distance = camera.distance * radius;
    // The angle of view is that of the shorter side.
    const slope = Math.tan((camera.fov * Math.PI) / 360) / Math.min(1, width / height);
    const perspective = camera.projection === "perspective";
    return {
        basis,
        eye: add(target, scaled(basis.towardsEye, distance)),
        perspective,
        halfHeight: perspective ? slope : slope * distance,
        width,
        height,
    };
}

/** Distance in front of the eye along its line of sight; negative behind it. */
export function depthOf(view: PictureView, point: Vector): number {
    return -dot(view.basis.towardsEye, subtract(point, view.eye));
}

/** Pixels per world unit across the line of sight, at the depth of a point in front of the eye. */
export function pixelsPerUnit(view: PictureView, point: Vector): number {
    const depth = view.perspective ? Math.max(depthOf(view, point), 1e-9 * view.halfHeight) : 1;
    return view.height / 2 / (view.halfHeight * depth);
}

/** null: behind the eye. */
export function toPixel(view: PictureView, point: Vector): Pixel | null {
    if (view.perspective && depthOf(view, point) <= 0) return null;
    const offset = subtract(point, view.eye);
    const scale = pixelsPerUnit(view, point);
    return { x: view.width / 2 + dot(view.basis.right, offset) * scale, y: view.height / 2 - dot(view.basis.up, offset) * scale };
}

/** The point under a pixel, at the depth of another point. */
export function pointUnder(view: PictureView, pixel: Pixel, atDepthOf: Vector): Vector {
    const scale = pixelsPerUnit(view, atDepthOf);
    const across = add(
        scaled(view.basis.right, (pixel.x - view.width / 2) / scale),
        scaled(view.basis.up, (view.height / 2 - pixel.y) / scale),
    );
    return add(view.eye, add(across, scaled(view.basis.towardsEye, -depthOf(view, atDepthOf))));
}

/** Away from the eye through a point; unit length. */
export function sightLine(view: PictureView, point: Vector): Vector {
    if (!view.perspective) return scaled(view.basis.towardsEye, -1);
    const offset = subtract(point, view.eye);
    return scaled(offset, 1 / Math.max(Math.hypot(...offset), 1e-300));
}

const coarseSteps = 48;
const fineSteps = 40;

/** Shorter paths than this cannot be followed by a pointer: the picture looks along them. */
const shortestPathPixels = 16;

/** The part (0 to 1) of a path whose pixel is nearest to the given one: a scan, then a golden-section search. */
function nearestPart(view: PictureView, path: (part: number) => Vector, pixel: Pixel): number {
    const away = (part: number): number => {
        const at = toPixel(view, path(part));
        return at ? Math.hypot(at.x - pixel.x, at.y - pixel.y) : Infinity;
    };
    let best = 0;
    for (let step = 1; step <= coarseSteps; ++step) if (away(step / coarseSteps) < away(best)) best = step / coarseSteps;
    let low = Math.max(0, best - 1 / coarseSteps);
    let high = Math.min(1, best + 1 / coarseSteps);
    const golden = (Math.sqrt(5) - 1) / 2;
    for (let step = 0; step < fineSteps; ++step) {
        const left = high - golden * (high - low);
        const right = low + golden * (high - low);
        if (away(left) <= away(right)) high = right;
        else low = left;
    }
    return (low + high) / 2;
}

function pathPixels(view: PictureView, path: (part: number) => Vector): number {
    const from = toPixel(view, path(0));
    const to = toPixel(view, path(1));
    return from && to ? Math.hypot(to.x - from.x, to.y - from.y) : Infinity;
}

/**
 * Follows a path (0 to 1) with a pointer that was pressed at `pressed` while the path stood at `startPart`: the result's
 * pixel is as near to the pointer as the path comes. Where the picture looks along the path, upwards is onwards, and the
 * picture's height is the whole path.
 */
export function followPath(
    view: PictureView,
    path: (part: number) => Vector,
    startPart: number,
    pressed: Pixel,
): (pointer: Pixel) => number {
    const start = toPixel(view, path(startPart));
    if (!start || pathPixels(view, path) < shortestPathPixels) {
        return (pointer) => Math.min(1, Math.max(0, startPart + (pressed.y - pointer.y) / view.height));
    }
    return (pointer) => nearestPart(view, path, { x: start.x + pointer.x - pressed.x, y: start.y + pointer.y - pressed.y });
}
