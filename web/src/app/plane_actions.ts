// Planes: moving them and their crosshair (in the pictures at once, in the workbook when the steps rest), and showing three of
// them beside a volume.
import { makePlanes } from "../api/sheets";
import type { StylePatch } from "../api/types";
import { formatAddress } from "../model/address";
import { crosshairPoint, crosshairValue, unitsOf } from "../model/crosshair";
import { planeNormal, steppedPlane } from "../model/plane_position";
import { cellPictureView, isPlane } from "../model/plane_view";
import { pointUnder, type Pixel } from "../model/projection";
import { selectedCells } from "../model/selection";
import { add, dot, scaled, type Vector } from "../model/vector";
import { boxCentre, extentAlong } from "../model/volume_box";
import type { AppStore } from "../state/app_state";
import { cellOf, currentSheet, sourceText } from "../state/book";
import type { Notices } from "./notices";
import type { ServerSync } from "./server_sync";
import type { KeyEdits } from "./style_edit";
import type { StyleActions } from "./style_actions";
import type { ViewActions } from "./view_actions";

const key = "plane.crosshair";

export class PlaneActions {
    constructor(
        private readonly store: AppStore,
        private readonly styles: StyleActions,
        private readonly view: ViewActions,
        private readonly edits: KeyEdits,
        private readonly sync: ServerSync,
        private readonly notices: Notices,
    ) {}

    /** \param by  voxels along the plane's normal. Every cell that shares the position goes along; `alone`: this one only. */
    step(cell: string, by: number, alone: boolean): void {
        const patch = steppedPlane(this.view.cell(cell), (name) => this.styles.shownValue(cell, name), by);
        if (patch) this.show(cell, patch, alone);
    }

    private show(cell: string, patch: StylePatch, alone: boolean): void {
        const edited = Object.keys(patch)[0]!;
        this.edits.show(`${cell} ${edited} ${alone}`, this.styles.homeOf(cell, edited, alone), patch);
    }

    /** Of a cell, in its world; null: there is none. */
    private crosshair(cell: string): Vector | null {
        const box = this.view.cell(cell)?.box;
        return box ? crosshairPoint(box, this.styles.shownValue(cell, key), this.units(cell)) : null;
    }

    private units(cell: string) {
        return unitsOf(this.styles.shownValue(cell, "plane.units"));
    }

    /** A press on a plane takes the crosshair there, if there is one. */
    pointAt(cell: string, pixel: Pixel, size: { width: number; height: number }, alone: boolean): void {
        const shown = this.view.cell(cell);
        const crosshair = this.crosshair(cell);
        if (!shown || !crosshair || !isPlane(shown)) return;
        const view = cellPictureView(shown, this.view.camera(cell), size.width, size.height);
        if (view) this.put(cell, pointUnder(view, pixel, crosshair), alone);
    }

    private put(cell: string, point: Vector, alone: boolean): void {
        const box = this.view.cell(cell)?.box;
        if (box) this.show(cell, { [key]: crosshairValue(box, point, this.units(cell)) }, alone);
    }

    /** To what lies under the pointer, or, where that is nowhere, to the middle of the active cell, on its plane. */
    crosshairHere(alone: boolean): void {
        const { page } = this.store.get();
        const pointed = page.probe?.world ? this.view.cell(page.probe.cell ?? "") : undefined;
        if (pointed && page.probe?.world) {
            this.put(pointed.cell, page.probe.world, alone);
            return;
        }
        const cell = formatAddress(page.selection.active);
        const middle = this.middle(cell);
        if (middle) this.put(cell, middle, alone);
    }

    private middle(cell: string): Vector | null {
        const shown = this.view.cell(cell);
        if (!shown?.box) return null;
        const centre = boxCentre(shown.box);
        const position = this.styles.shownValue(cell, "plane.position");
        if (!isPlane(shown) || typeof position !== "number") return centre;
        const normal = planeNormal(shown.box, (name) => this.styles.shownValue(cell, name));
        const { low, high } = extentAlong(shown.box, normal);
        return add(centre, scaled(normal, low + position * (high - low) - dot(normal, centre)));
    }

    crosshairOff(alone: boolean): void {
        const cell = formatAddress(this.store.get().page.selection.active);
        if (this.crosshair(cell)) this.show(cell, { [key]: "none" }, alone);
    }

    /** Axial, coronal and sagittal planes in cells of their own beside every selected one. */
    async beside(): Promise<void> {
        const { page, book } = this.store.get();
        const sheet = currentSheet(book);
        if (!sheet) return;
        const cells = selectedCells(page.selection, sheet).filter((name) => sourceText(cellOf(sheet, name)) !== "");
        if (cells.length === 0) {
            this.notices.info("The selected cells show no volume: select one that does.");
            return;
        }
        await this.edits.finish();
        await this.notices.attempt(() => makePlanes(sheet.name, cells));
        await this.sync.book.request();
    }
}
