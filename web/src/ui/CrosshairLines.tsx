// The crosshair on a cell's picture: across a plane, or along the world's axes through a volume. Drawn from the camera and
// never waiting for a picture. Pictures of volumes have it at its depth; here it faintly shines through what hides it.
import type { CellState, StyleValue } from "../api/types";
import { crosshairAxes, crosshairPoint, unitsOf } from "../model/crosshair";
import { cameraOf } from "../model/look";
import { cellPictureView, isPlane } from "../model/plane_view";
import { toPixel, type PictureView, type Pixel } from "../model/projection";
import type { Vector } from "../model/vector";
import { cellOf, currentSheet } from "../state/book";
import { useSelect } from "./app_context";
import { usePictureSize } from "./picture_size";

const gapPixels = 6;

function linesAcross(at: Pixel, { width, height }: PictureView): [Pixel, Pixel][] {
    return [
        [{ x: 0, y: at.y }, { x: at.x - gapPixels, y: at.y }],
        [{ x: at.x + gapPixels, y: at.y }, { x: width, y: at.y }],
        [{ x: at.x, y: 0 }, { x: at.x, y: at.y - gapPixels }],
        [{ x: at.x, y: at.y + gapPixels }, { x: at.x, y: height }],
    ];
}

function linesOf(cell: CellState, view: PictureView, point: Vector): [Pixel, Pixel][] {
    if (isPlane(cell)) {
        const at = toPixel(view, point);
        return at ? linesAcross(at, view).filter(([from, to]) => from.x <= to.x && from.y <= to.y) : [];
    }
    return crosshairAxes(cell.box!, point).flatMap(([from, to]) => {
        const ends = [toPixel(view, from), toPixel(view, to)] as const;
        return ends[0] && ends[1] ? [[ends[0], ends[1]] as [Pixel, Pixel]] : [];
    });
}

function sameJson(a: unknown, b: unknown): boolean {
    return JSON.stringify(a) === JSON.stringify(b);
}

/** Nothing where there is no crosshair: whatever follows the camera has its price in every cell. */
export function CrosshairLines({ cell }: { cell: string }) {
    const placed = useSelect((state) => {
        const value = state.page.live[cell]?.["plane.crosshair"] ?? cellOf(currentSheet(state.book), cell)?.style["plane.crosshair"]?.value;
        return Array.isArray(value);
    });
    return placed ? <PlacedCrosshair cell={cell} /> : null;
}

function PlacedCrosshair({ cell: name }: { cell: string }) {
    const { svg, size } = usePictureSize();
    const cell = useSelect((state) => cellOf(currentSheet(state.book), name));
    const live = useSelect((state) => state.page.live[name]);
    const camera = useSelect((state) => cameraOf(state.page.look, cellOf(currentSheet(state.book), name)), sameJson);
    const shown = (key: string): StyleValue | undefined => live?.[key] ?? cell?.style[key]?.value;
    const point = cell?.box && crosshairPoint(cell.box, shown("plane.crosshair"), unitsOf(shown("plane.units")));
    const annotations = shown("annotations") ?? "all";
    const view = cell && point && annotations === "all" && size.width > 0 ? cellPictureView(cell, camera, size.width, size.height) : null;
    const lines = view && point ? linesOf(cell, view, point) : [];
    return (
        <svg ref={svg} class={cell && isPlane(cell) ? "crosshair" : "crosshair through"} aria-hidden="true" data-crosshair={lines.length > 0 ? name : undefined}>
            {["edge", "line"].map((part) =>
                lines.map(([from, to], i) => <line key={`${part}${i}`} class={part} x1={from.x} y1={from.y} x2={to.x} y2={to.y} />),
            )}
        </svg>
    );
}
