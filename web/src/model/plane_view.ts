// How technique plane lies in its picture, as the server says (server/engine/plane_resolver.h): the camera's angles mean
// nothing there.
import type { CellState } from "../api/types";
import { cameraBasis, isFinite3, type Basis, type Camera, type FlatView } from "./camera";
import { reciprocalVector } from "./lattice";
import { ownFrame, pictureView, type PictureView } from "./projection";
import { add, cross, length, normalized, scaled, type Vector } from "./vector";
import { extentAlong } from "./volume_box";

/** Picture over box where it fits tightest, at the camera distance that shows all. */
const margin = 1.04;
const fittingDistance = 3.9;

const x: Vector = [1, 0, 0];
const y: Vector = [0, 1, 0];
const z: Vector = [0, 0, 1];

function basisOf(right: Vector, up: Vector): Basis {
    return { right, up, towardsEye: cross(right, up) };
}

function customBasis(normal: Vector): Basis {
    const towardsEye = normalized(normal);
    const vertical = length(cross(z, towardsEye)) < 1e-6;
    const right = normalized(cross(vertical ? y : z, towardsEye));
    return { right, up: cross(towardsEye, right), towardsEye };
}

export function isPlane(cell: CellState | undefined): boolean {
    return cell?.style["technique"]?.value === "plane";
}

/** Patients are shown in the radiological convention: their right is on the picture's left. */
export function planeBasis(cell: CellState): Basis {
    const mirrored = (axis: Vector): Vector => (cell.orientation === true ? scaled(axis, -1) : axis);
    const normal = cell.style["plane.normal"]?.value;
    switch (cell.style["plane.axis"]?.value) {
        case "coronal":
            return basisOf(mirrored(x), z);
        case "sagittal":
            return basisOf(mirrored(y), z);
        case "custom":
            return customBasis(isFinite3(normal) ? normal : z);
        case "hkl":
            return customBasis(reciprocalVector(cell.box?.lattice, cell.style["plane.hkl"]?.value) ?? z);
        default:
            return basisOf(mirrored(x), y);
    }
}

/** Of what the cell's picture shows, whatever its technique. */
export function pictureBasis(cell: CellState | undefined, camera: Camera): Basis {
    return cell && isPlane(cell) ? planeBasis(cell) : cameraBasis(camera);
}

/** undefined: the picture follows the camera. \param aspect  width over height of the picture */
export function flatView(cell: CellState | undefined, aspect: number): FlatView | undefined {
    if (!cell?.box || !isPlane(cell)) return undefined;
    const box = cell.box;
    const basis = planeBasis(cell);
    const extent = (direction: Vector): number => {
        const { low, high } = extentAlong(box, direction);
        return high - low;
    };
    const frame = cell.frame ?? ownFrame(box);
    const fitting = frame.size ? Math.max(...frame.size) / Math.min(1, aspect) : Math.max(extent(basis.up), extent(basis.right) / aspect);
    return { basis, heightPerDistance: (margin * fitting) / (fittingDistance * frame.radius) };
}

/** Of what the cell's picture shows, whatever its technique. null: there is no volume yet */
export function cellPictureView(cell: CellState, camera: Camera, width: number, height: number): PictureView | null {
    if (!cell.box) return null;
    const frame = cell.frame ?? ownFrame(cell.box);
    const flat = flatView(cell, width / Math.max(1, height));
    if (!flat) return pictureView(camera, cell.box, width, height, frame);
    const target = add(frame.centre, scaled(camera.target, frame.radius));
    return {
        basis: flat.basis,
        eye: add(target, scaled(flat.basis.towardsEye, camera.distance * frame.radius)),
        perspective: false,
        halfHeight: (flat.heightPerDistance * camera.distance * frame.radius) / 2,
        width,
        height,
    };
}
