// Which way the picture looks: letters at the edges for medical data (R L A P S I), an axes cross for the rest.
import type { Basis } from "../model/camera";
import { directionInView } from "../model/clip/arrow_ball";
import { cameraOf } from "../model/look";
import { pictureBasis } from "../model/plane_view";
import type { Vector } from "../model/vector";
import { cellOf, currentSheet } from "../state/book";
import { useSelect } from "./app_context";

const axes: { label: string; direction: Vector }[] = [
    { label: "x", direction: [1, 0, 0] },
    { label: "y", direction: [0, 1, 0] },
    { label: "z", direction: [0, 0, 1] },
];

/** World is RAS+: +x right, +y anterior, +z superior. */
const anatomical: { letter: string; direction: Vector }[] = [
    { letter: "R", direction: [1, 0, 0] },
    { letter: "L", direction: [-1, 0, 0] },
    { letter: "A", direction: [0, 1, 0] },
    { letter: "P", direction: [0, -1, 0] },
    { letter: "S", direction: [0, 0, 1] },
    { letter: "I", direction: [0, 0, -1] },
];

/** The letters that lie mainly towards (right, up), strongest first; a second one when the view is oblique. */
export function edgeLetters(basis: Basis, right: number, up: number): string {
    return anatomical
        .map(({ letter, direction }) => {
            const [x, y] = directionInView(basis, direction);
            return { letter, along: x * right + y * up };
        })
        .filter(({ along }) => along > 0.35)
        .sort((a, b) => b.along - a.along)
        .map(({ letter }) => letter)
        .slice(0, 2)
        .join("");
}

function sameBasis(a: Basis, b: Basis): boolean {
    return a.right.every((part, i) => part === b.right[i]) && a.up.every((part, i) => part === b.up[i]);
}

function AxesCross({ basis }: { basis: Basis }) {
    const size = 44;
    const arm = 15;
    const drawn = axes
        .map(({ label, direction }) => ({ label, at: directionInView(basis, direction) }))
        .sort((a, b) => a.at[2] - b.at[2]);
    return (
        <svg class="axes-cross" width={size} height={size} viewBox={`${-size / 2} ${-size / 2} ${size} ${size}`} aria-hidden="true">
            {drawn.map(({ label, at }) => (
                <g key={label} class={`axis-${label}`}>
                    <line x1="0" y1="0" x2={at[0] * arm} y2={-at[1] * arm} />
                    <text x={at[0] * (arm + 5)} y={-at[1] * (arm + 5)}>
                        {label}
                    </text>
                </g>
            ))}
        </svg>
    );
}

export function OrientationMarks({ cell }: { cell: string }) {
    const anatomy = useSelect((state) => cellOf(currentSheet(state.book), cell)?.orientation === true);
    const shown = useSelect((state) => {
        const annotations = cellOf(currentSheet(state.book), cell)?.style["annotations"]?.value;
        return annotations === undefined || annotations === "all";
    });
    const basis = useSelect((state) => {
        const shownCell = cellOf(currentSheet(state.book), cell);
        return pictureBasis(shownCell, cameraOf(state.page.look, shownCell));
    }, sameBasis);
    if (!shown) return null;
    if (!anatomy) return <AxesCross basis={basis} />;
    return (
        <div class="anatomy" aria-hidden="true">
            <b class="edge-left">{edgeLetters(basis, -1, 0)}</b>
            <b class="edge-right">{edgeLetters(basis, 1, 0)}</b>
            <b class="edge-top">{edgeLetters(basis, 0, 1)}</b>
            <b class="edge-bottom">{edgeLetters(basis, 0, -1)}</b>
        </div>
    );
}
