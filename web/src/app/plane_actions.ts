// Moving the planes of technique plane: in the pictures at once, in the workbook when the steps rest.
import { steppedPlane } from "../model/plane_position";
import type { KeyEdits } from "./style_edit";
import type { StyleActions } from "./style_actions";
import type { ViewActions } from "./view_actions";

export class PlaneActions {
    constructor(
        private readonly styles: StyleActions,
        private readonly view: ViewActions,
        private readonly edits: KeyEdits,
    ) {}

    /** \param by  voxels along the plane's normal. Every cell that shares the position goes along; `alone`: this one only. */
    step(cell: string, by: number, alone: boolean): void {
        const patch = steppedPlane(this.view.cell(cell), (key) => this.styles.shownValue(cell, key), by);
        const key = patch && Object.keys(patch)[0];
        if (!patch || !key) return;
        this.edits.show(`${cell} ${key} ${alone}`, this.styles.homeOf(cell, key, alone), patch);
    }
}
