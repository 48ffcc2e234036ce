// Edits that are shown before they are written: a drag, or keys pressed in a row. The pictures follow at once, the workbook
// takes the last state, and that is one undo step.
import type { LayerTarget, StylePatch } from "../api/types";
import type { StyleActions } from "./style_actions";
import type { ViewActions } from "./view_actions";

export class StyleEdit {
    private patch: StylePatch | null = null;

    constructor(
        private readonly styles: StyleActions,
        private readonly view: ViewActions,
        private readonly targets: LayerTarget[],
    ) {
        view.gestureBegan();
    }

    show(patch: StylePatch): void {
        this.patch = patch;
        this.styles.preview(patch, this.targets);
    }

    async end(): Promise<void> {
        this.view.gestureEnded();
        if (this.patch) await this.styles.set(this.patch, this.targets);
    }

    cancel(): void {
        this.view.gestureEnded();
        this.styles.cancelPreview();
    }
}

/** Keys that come closer together than this are one edit. */
const burstMs = 500;

export class KeyEdits {
    private current: { id: string; edit: StyleEdit } | null = null;
    private timer: ReturnType<typeof setTimeout> | undefined;

    constructor(
        private readonly styles: StyleActions,
        private readonly view: ViewActions,
    ) {}

    /** \param id  what the keys move: another one is another edit */
    show(id: string, targets: LayerTarget[], patch: StylePatch): void {
        if (this.current?.id !== id) {
            void this.finish();
            this.current = { id, edit: new StyleEdit(this.styles, this.view, targets) };
        }
        this.current.edit.show(patch);
        clearTimeout(this.timer);
        this.timer = setTimeout(() => void this.finish(), burstMs);
    }

    /** Writes what is only shown so far. */
    async finish(): Promise<void> {
        clearTimeout(this.timer);
        const { current } = this;
        this.current = null;
        await current?.edit.end();
    }
}
