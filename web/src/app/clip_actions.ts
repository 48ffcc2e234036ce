// Clipping from the toolbar and the inspector: what is added begins in a place where it can be seen and dragged.
import type { StylePatch } from "../api/types";
import { formatAddress } from "../model/address";
import { cameraBasis } from "../model/camera";
import { clipOf, mostPlanes, type Clip } from "../model/clip/clip";
import { middleBox } from "../model/clip/clip_box";
import { facingObject } from "../model/clip/clip_object";
import { facingPlane } from "../model/clip/clip_plane";
import type { Vector } from "../model/vector";
import type { VolumeBox } from "../model/volume_box";
import type { AppStore } from "../state/app_state";
import type { Notices } from "./notices";
import type { StyleActions } from "./style_actions";
import type { ViewActions } from "./view_actions";

export class ClipActions {
    constructor(
        private readonly store: AppStore,
        private readonly styles: StyleActions,
        private readonly view: ViewActions,
        private readonly notices: Notices,
    ) {}

    toggleHandles(): void {
        this.store.dispatch({ type: "page/clipHandles", shown: !this.store.get().page.clipHandles });
    }

    clip(cell: string): Clip {
        return clipOf((key) => this.styles.shownValue(cell, key));
    }

    private active(): string {
        return formatAddress(this.store.get().page.selection.active);
    }

    /** At the layer that the inspector edits, in the place that the active cell's picture suggests. */
    private async add(patchOf: (clip: Clip, box: VolumeBox, towardsEye: Vector) => StylePatch): Promise<void> {
        const cell = this.active();
        const box = this.view.cell(cell)?.box;
        if (!box) {
            this.notices.info(`${cell} shows no volume to clip: select a cell that does.`);
            return;
        }
        this.store.dispatch({ type: "page/clipHandles", shown: true });
        await this.styles.set(patchOf(this.clip(cell), box, cameraBasis(this.view.camera(cell)).towardsEye));
    }

    addPlane(): Promise<void> {
        if (this.clip(this.active()).planes.length >= mostPlanes) {
            this.notices.info(`There are ${mostPlanes} planes already: remove one first.`);
            return Promise.resolve();
        }
        return this.add((clip, box, towardsEye) => ({
            "clip.planes": [...clip.planes, facingPlane(towardsEye, clip.units, box)].map((row) => [...row]),
        }));
    }

    addBox(): Promise<void> {
        return this.add((clip, box) => ({ "clip.box": [...middleBox(clip.units, box)] }));
    }

    addObject(shape: string): Promise<void> {
        return this.add((clip, box, towardsEye) => ({
            "clip.shape": shape,
            "clip.transform": [...facingObject(towardsEye, clip.units, box)],
        }));
    }

    async removeAll(): Promise<void> {
        await this.styles.set({ "clip.planes": "none", "clip.box": "none", "clip.shape": "none" });
    }
}
