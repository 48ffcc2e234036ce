// Gestures on one cell's picture become camera changes, window/level edits, selections and probes.
import { probePixel } from "../api/sheets";
import type { LayerTarget, StylePatch } from "../api/types";
import { orbited, panned, rolled, zoomed, type FlatView } from "../model/camera";
import { parseAddress } from "../model/address";
import { flatView, isPlane } from "../model/plane_view";
import { selectCell } from "../model/selection";
import { windowLevel, type ValueRange } from "../model/transfer";
import { currentSheet } from "../state/book";
import { isHeld } from "../input/held_keys";
import type { DragKind, DragStep, GestureHandlers, ZoomStep } from "../input/picture_gestures";
import type { App } from "./app";

const probeIntervalMs = 100;

export class PictureController implements GestureHandlers {
    private window: ValueRange | null = null;
    private targets: LayerTarget[] = [];
    private last: { x: number; y: number } = { x: 0, y: 0 };
    private probeTimer: ReturnType<typeof setTimeout> | undefined;
    private probeAt = { x: 0, y: 0 };
    private probing: AbortController | null = null;

    constructor(
        private readonly app: App,
        private readonly cell: string,
        private readonly size: () => { width: number; height: number },
    ) {}

    isHeld(key: string): boolean {
        return isHeld(key);
    }

    dragBegan(kind: DragKind): void {
        this.left();
        this.app.view.gestureBegan();
        if (kind !== "window") return;
        const bar = this.app.store.get().book.bars[this.cell];
        this.window = bar ? { low: bar.low, high: bar.high } : null;
        this.targets = this.app.styles.targets();
    }

    drag(step: DragStep): void {
        if (step.kind === "window") {
            this.windowDrag(step);
            return;
        }
        const before = this.app.view.camera(this.cell);
        const flat = this.flat();
        // A plane has one side to be seen from: what would turn other pictures moves it.
        const camera =
            flat || step.kind === "pan"
                ? panned(before, step.dx, step.dy, step.height, flat)
                : step.kind === "orbit"
                  ? orbited(before, step.dx, step.dy, step.height)
                  : rolled(before, step.x - step.dx, step.y - step.dy, step.x, step.y);
        this.app.view.setCamera(this.cell, camera, step.alone);
    }

    private flat(): FlatView | undefined {
        const { width, height } = this.size();
        return flatView(this.app.view.cell(this.cell), width / Math.max(1, height));
    }

    private windowDrag(step: DragStep): void {
        if (!this.window) return;
        this.window = windowLevel(this.window, step.dx / step.width, step.dy / step.height);
        this.app.styles.preview(this.windowPatch(this.window), this.targets);
    }

    private windowPatch(range: ValueRange): StylePatch {
        const digits = (value: number): number => Number(value.toPrecision(6));
        return { "range.mode": "fixed", "range.min": digits(range.low), "range.max": digits(range.high) };
    }

    dragEnded(kind: DragKind, cancelled: boolean): void {
        this.app.view.gestureEnded();
        if (kind !== "window") return;
        if (this.window && !cancelled) void this.app.styles.set(this.windowPatch(this.window), this.targets);
        else this.app.styles.cancelPreview();
        this.window = null;
    }

    zoom(step: ZoomStep): void {
        const camera = zoomed(this.app.view.camera(this.cell), step.factor, step.x, step.y, step.height, this.flat());
        this.app.view.setCamera(this.cell, camera, step.alone);
        this.app.view.stepped();
    }

    wheelSteps(): boolean {
        return isPlane(this.app.view.cell(this.cell));
    }

    step(by: number, alone: boolean): void {
        this.app.planes.step(this.cell, by, alone);
    }

    click(event: PointerEvent): void {
        const address = parseAddress(this.cell);
        if (!address) return;
        const modifiers = { extend: event.shiftKey, toggle: event.ctrlKey || event.metaKey };
        const { selection } = this.app.store.get().page;
        this.app.store.dispatch({ type: "page/select", selection: selectCell(selection, address, modifiers) });
        if (event.button === 0 && !modifiers.extend && !modifiers.toggle) this.point(event);
    }

    private point(event: PointerEvent): void {
        const box = (event.currentTarget as HTMLElement | null)?.getBoundingClientRect();
        if (!box) return;
        const pixel = { x: event.clientX - box.left, y: event.clientY - box.top };
        this.app.planes.pointAt(this.cell, pixel, this.size(), event.altKey);
    }

    /** At most one probe under way, and ten a second: hovering must not compete with pictures. */
    hover(x: number, y: number): void {
        this.app.levels.hover(this.cell);
        this.probeAt = { x, y };
        if (this.probeTimer !== undefined || this.app.store.get().page.moving) return;
        this.probeTimer = setTimeout(() => {
            this.probeTimer = undefined;
            void this.probe();
        }, probeIntervalMs);
    }

    left(): void {
        this.app.levels.hover(null);
        clearTimeout(this.probeTimer);
        this.probeTimer = undefined;
        this.probing?.abort();
        this.probing = null;
        this.last = { x: -1, y: -1 };
        if (this.app.store.get().page.probe) this.app.store.dispatch({ type: "page/probe", probe: null });
    }

    private async probe(): Promise<void> {
        const { store, sender } = this.app;
        const sheet = currentSheet(store.get().book);
        const at = this.probeAt;
        if (!sheet || this.probing || (at.x === this.last.x && at.y === this.last.y)) return;
        if (this.app.view.cell(this.cell)?.state !== "ok") return;
        this.last = at;
        const abort = new AbortController();
        this.probing = abort;
        try {
            const { width, height } = this.size();
            const inside = (value: number, size: number): number => Math.min(size, Math.max(0, value));
            const pixel = { cell: this.cell, px: inside(at.x, width), py: inside(at.y, height), width, height, stream: sender.streamId() };
            const probe = await probePixel(sheet.name, pixel, abort.signal);
            if (this.probing === abort) store.dispatch({ type: "page/probe", probe: { ...probe, cell: this.cell } });
        } catch {
            // Aborted, or a value that cannot be had right now: the chip stays away.
            if (this.probing === abort) store.dispatch({ type: "page/probe", probe: null });
        } finally {
            if (this.probing === abort) this.probing = null;
        }
        if (this.probeAt !== at) this.hover(this.probeAt.x, this.probeAt.y);
    }
}
