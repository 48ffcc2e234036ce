// Lattice planes of crystals by Miller indices (server/engine/lattice_planes.h).
import type { StyleValue } from "../api/types";
import { isFinite3 } from "./camera";
import { add, cross, dot, length, scaled, type Matrix, type Vector } from "./vector";

/** h a* + k b* + l c*: at right angles to the planes, as long as one over their distance. null: no plane */
export function reciprocalVector(lattice: Matrix | undefined, hkl: StyleValue | undefined): Vector | null {
    if (!lattice || !isFinite3(hkl)) return null;
    const [a, b, c] = lattice;
    const faces: Matrix = [cross(b, c), cross(c, a), cross(a, b)];
    const sum = faces.reduce<Vector>((sum, face, i) => add(sum, scaled(face, hkl[i]!)), [0, 0, 0]);
    return length(sum) > 0 ? scaled(sum, 1 / dot(a, faces[0])) : null;
}
