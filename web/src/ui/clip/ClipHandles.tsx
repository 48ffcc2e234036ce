// What is clipped, on the cell's picture: outlines, and handles to drag it. Drawn from the camera and never waiting for a
// picture.
import { useMemo } from "preact/hooks";
import type { StyleValue } from "../../api/types";
import { formatAddress } from "../../model/address";
import { clipOf, hasClip, type Clip } from "../../model/clip/clip";
import { shapeOutline } from "../../model/clip/shape_outline";
import { cameraOf } from "../../model/look";
import { pictureView, type PictureView } from "../../model/projection";
import type { VolumeBox } from "../../model/volume_box";
import { cellOf, currentSheet } from "../../state/book";
import { useApp, useSelect } from "../app_context";
import { usePictureSize } from "../picture_size";
import { BoxHandles } from "./BoxHandles";
import { ObjectHandles } from "./ObjectHandles";
import { PlaneHandles } from "./PlaneHandles";

/** What every handle of one cell needs. */
export interface HandlesContext {
    cell: string;
    view: PictureView;
    box: VolumeBox;
    clip: Clip;
    /** By Tab: only those of the active cell. */
    reachable: boolean;
}

function sameJson(a: unknown, b: unknown): boolean {
    return JSON.stringify(a) === JSON.stringify(b);
}

/** Of a cell, or of a dataset. */
function useBoxOf(): (name: string) => VolumeBox | null {
    const { store } = useApp();
    return (name) => {
        const { book } = store.get();
        return cellOf(currentSheet(book), name)?.box ?? book.datasets.find((dataset) => dataset.name === name)?.box ?? null;
    };
}

export function ClipHandles({ cell: name }: { cell: string }) {
    const { svg, size } = usePictureSize();
    const boxOf = useBoxOf();
    const cell = useSelect((state) => cellOf(currentSheet(state.book), name));
    const live = useSelect((state) => state.page.live[name]);
    const camera = useSelect((state) => cameraOf(state.page.look, cellOf(currentSheet(state.book), name)), sameJson);
    const reachable = useSelect((state) => formatAddress(state.page.selection.active) === name);
    const clip = useMemo(() => clipOf((key): StyleValue | undefined => live?.[key] ?? cell?.style[key]?.value), [cell, live]);
    const box = cell?.box;
    const drawn = box && size.width > 0 && hasClip(clip);
    const view = drawn ? pictureView(camera, box, size.width, size.height, cell.frame ?? undefined) : null;
    const context = view && box ? { cell: name, view, box, clip, reachable } : null;
    return (
        <svg ref={svg} class="clip-handles" role="group" aria-label={`Clip handles of ${name}`}>
            {context && clip.box && <BoxHandles context={context} row={clip.box} />}
            {context && clip.shape && <ObjectHandles context={context} outline={shapeOutline(clip.shape, boxOf)} />}
            {context && clip.planes.map((row, i) => <PlaneHandles key={i} context={context} row={row} index={i} />)}
        </svg>
    );
}
