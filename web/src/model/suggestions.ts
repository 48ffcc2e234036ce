// What may stand in a text key, for its menu.
import type { CellState, Dataset, StyleKey } from "../api/types";
import { shapeNames } from "./clip/shape_outline";

export interface Suggestion {
    text: string;
    hint?: string;
}

/** A triangle mesh becomes a volume of signed distances when it is read. */
function isMesh(dataset: Dataset): boolean {
    return dataset.state === "ready" && dataset.fields?.[0]?.quantity === "signed distance";
}

/** \param middle  a value that divides the active cell's data, for the example of a comparison */
export function suggestionsFor(
    key: StyleKey,
    cells: readonly CellState[],
    datasets: readonly Dataset[],
    active: string,
    middle: number | null,
): Suggestion[] {
    const none: Suggestion[] = key.takesNone ? [{ text: "none" }] : [];
    const drawn = cells.filter((cell) => cell.state === "ok");
    if (key.name === "clip.shape") {
        const shapes = shapeNames.map((text) => ({ text, hint: "shape" }));
        const meshes = datasets.filter(isMesh).map(({ name }) => ({ text: name, hint: "mesh" }));
        const compared = middle === null ? [] : [{ text: `${active} > ${middle}`, hint: "where it is so" }];
        return [...none, ...shapes, ...meshes, ...compared];
    }
    if (key.name === "isosurface.colorBy" || key.name === "layers" || key.name === "overlay.dataset") {
        const others = drawn.filter((cell) => cell.cell !== active).map((cell) => ({ text: cell.cell, hint: cell.title ?? "cell" }));
        const volumes = datasets.filter((dataset) => dataset.state === "ready").map(({ name }) => ({ text: name, hint: "dataset" }));
        return [...none, ...others, ...volumes];
    }
    return none;
}
