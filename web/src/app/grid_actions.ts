// How many cells the window shows.
import { formatAddress } from "../model/address";
import { steppedZoom } from "../model/grid_zoom";
import type { AppStore } from "../state/app_state";
import { currentSheet } from "../state/book";

export class GridActions {
    /** \param area  the scrolled element; null while there is none */
    constructor(
        private readonly store: AppStore,
        private readonly area: () => HTMLElement | null,
    ) {}

    /** Larger tiles, fewer cells (1), or the other way round (-1). */
    step(step: 1 | -1): void {
        const sheet = currentSheet(this.store.get().book);
        const area = this.area();
        if (!sheet || !area) return;
        const size = { width: area.clientWidth, height: area.clientHeight };
        this.set(steppedZoom(sheet, size, this.store.get().page.gridZoom, step));
    }

    fit(): void {
        this.set(1);
    }

    /** The active cell stays in view. */
    private set(zoom: number): void {
        const { page } = this.store.get();
        if (zoom === page.gridZoom) return;
        this.store.dispatch({ type: "page/gridZoom", zoom });
        const cell = formatAddress(page.selection.active);
        requestAnimationFrame(() => this.area()?.querySelector(`[data-cell="${cell}"]`)?.scrollIntoView({ block: "nearest", inline: "nearest" }));
    }
}
