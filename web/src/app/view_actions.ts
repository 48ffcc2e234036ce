// What the page looks at: cameras by gesture, enlarging, playing, saving and sharing the view.
import { saveView } from "../api/sheets";
import type { CellState } from "../api/types";
import type { Camera, StyleValue } from "../model/camera";
import { cameraOf, lookToText, viewOverrides, withCamera, withKey, withoutCamera } from "../model/look";
import type { AppStore } from "../state/app_state";
import { cellOf, currentSheet } from "../state/book";
import type { Notices } from "./notices";
import type { ServerSync } from "./server_sync";

/** A key or a wheel step counts as moving for this long. */
const pulseMs = 220;
const playStepMs = 250;

export class ViewActions {
    private pulse: ReturnType<typeof setTimeout> | undefined;
    private gestures = 0;
    private player: ReturnType<typeof setInterval> | undefined;

    constructor(
        private readonly store: AppStore,
        private readonly sync: ServerSync,
        private readonly notices: Notices,
    ) {}

    cell(name: string): CellState | undefined {
        return cellOf(currentSheet(this.store.get().book), name);
    }

    camera(name: string): Camera {
        return cameraOf(this.store.get().page.look, this.cell(name));
    }

    setCamera(name: string, camera: Camera, alone: boolean): void {
        const cell = this.cell(name);
        if (!cell) return;
        this.store.dispatch({ type: "page/look", look: withCamera(this.store.get().page.look, cell, camera, alone) });
    }

    /** A drag began; until gestureEnded the server draws for speed. */
    gestureBegan(): void {
        ++this.gestures;
        this.updateMoving();
    }

    gestureEnded(): void {
        this.gestures = Math.max(0, this.gestures - 1);
        this.updateMoving();
    }

    /** A single step (key, wheel). */
    stepped(): void {
        clearTimeout(this.pulse);
        this.pulse = setTimeout(() => {
            this.pulse = undefined;
            this.updateMoving();
        }, pulseMs);
        this.updateMoving();
    }

    private updateMoving(): void {
        this.store.dispatch({ type: "page/moving", moving: this.gestures > 0 || this.pulse !== undefined });
    }

    /** null: every cell. */
    reset(cell: string | null): void {
        this.store.dispatch({ type: "page/look", look: withoutCamera(this.store.get().page.look, cell) });
    }

    /** Keeps the direction; the dataset's bounding sphere fills the shorter side of the picture. */
    fit(name: string, aspect: number, alone: boolean): void {
        const camera = this.camera(name);
        const half = (camera.fov * Math.PI) / 360;
        const narrow = Math.atan(Math.tan(half) * Math.min(1, aspect));
        this.setCamera(name, { ...camera, target: [0, 0, 0], distance: 1 / Math.sin(narrow) }, alone);
    }

    enlarge(cell: string | null): void {
        this.store.dispatch({ type: "page/enlarge", cell });
    }

    steps(): number {
        return Math.max(1, ...this.store.get().book.datasets.map((dataset) => dataset.steps ?? 1));
    }

    private step(): number {
        const { page, book } = this.store.get();
        const value: StyleValue | undefined = page.look.style["time"] ?? currentSheet(book)?.cells[0]?.style["time"]?.value;
        return typeof value === "number" ? value : 0;
    }

    advance(by: number): void {
        const steps = this.steps();
        const next = (((this.step() + by) % steps) + steps) % steps;
        this.store.dispatch({ type: "page/look", look: withKey(this.store.get().page.look, "time", next) });
    }

    togglePlaying(): void {
        const playing = !this.store.get().page.playing && this.steps() > 1;
        this.store.dispatch({ type: "page/playing", playing });
        clearInterval(this.player);
        if (playing) this.player = setInterval(() => this.advance(1), playStepMs);
    }

    async save(): Promise<void> {
        const { page, book } = this.store.get();
        const sheet = currentSheet(book);
        if (!sheet) return;
        const view = viewOverrides(page.look, sheet, {});
        const done = await this.notices.attempt(async () => {
            await saveView(sheet.name, { style: view.style, cells: view.cells });
            return true;
        });
        if (!done) return;
        await this.sync.book.request();
        this.reset(null);
        this.notices.info("The view is now part of the workbook.");
    }

    /** The page's address with the view in it, without any token. */
    link(): string {
        const { page, book } = this.store.get();
        const url = new URL(window.location.href);
        url.searchParams.delete("token");
        const sheet = currentSheet(book)?.name ?? "";
        url.hash = `sheet=${encodeURIComponent(sheet)}&view=${lookToText(page.look)}`;
        return url.href;
    }

    async copyLink(): Promise<void> {
        const link = this.link();
        window.history.replaceState(null, "", link);
        try {
            await navigator.clipboard.writeText(link);
            this.notices.info("Link with this view copied. Opening it needs access to this server.");
        } catch {
            this.notices.info("The link with this view is now in the address bar.");
        }
    }
}
