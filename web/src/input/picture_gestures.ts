// Pointer, wheel and touch on a picture, turned into what they mean. Knows nothing of cameras or servers.

export type DragKind = "orbit" | "pan" | "roll" | "window";

export interface DragStep {
    kind: DragKind;
    /** Alt: this cell only. */
    alone: boolean;
    /** CSS pixels since the last step. */
    dx: number;
    dy: number;
    /** From the picture's centre, y downwards. */
    x: number;
    y: number;
    width: number;
    height: number;
}

export interface ZoomStep {
    factor: number;
    x: number;
    y: number;
    height: number;
    alone: boolean;
}

export interface GestureHandlers {
    dragBegan(kind: DragKind): void;
    drag(step: DragStep): void;
    /** cancelled: the browser took the pointer away. */
    dragEnded(kind: DragKind, cancelled: boolean): void;
    zoom(step: ZoomStep): void;
    /** The wheel steps through what the picture shows; with Ctrl or Shift it zooms all the same. */
    wheelSteps(): boolean;
    /** \param by  voxels; up is positive */
    step(by: number, alone: boolean): void;
    click(event: PointerEvent): void;
    hover(x: number, y: number): void;
    left(): void;
    /** A letter that is held down while dragging, such as "w". */
    isHeld(key: string): boolean;
}

/** Below this a press is a click. */
const clickPixels = 3;
const wheelPixelsPerDoubling = 500;
/** A wheel's notch is one step, however many pixels the browser makes of it; a trackpad's small strokes add up. */
const wheelPixelsPerStep = 40;
const wheelPixelsPerNotch = 120;

export class PictureGestures {
    private readonly pointers = new Map<number, { x: number; y: number }>();
    private kind: DragKind | null = null;
    private began = false;
    private start = { x: 0, y: 0 };
    private wheelRest = 0;

    constructor(
        private readonly element: HTMLElement,
        private readonly handlers: GestureHandlers,
    ) {
        const on = <K extends keyof HTMLElementEventMap>(type: K, listener: (event: HTMLElementEventMap[K]) => void): void =>
            element.addEventListener(type, listener as EventListener, { passive: false });
        on("pointerdown", (event) => this.down(event));
        on("pointermove", (event) => this.moved(event));
        on("pointerup", (event) => this.up(event, false));
        on("pointercancel", (event) => this.up(event, true));
        on("pointerleave", () => this.handlers.left());
        on("wheel", (event) => this.wheel(event));
        on("contextmenu", (event) => event.preventDefault());
        // The middle button would start the browser's own scrolling.
        on("mousedown", (event) => {
            if (event.button === 1) event.preventDefault();
        });
    }

    private kindOf(event: PointerEvent): DragKind | null {
        if (event.pointerType === "touch") return "orbit";
        if (event.button === 1) return "window";
        if (event.button === 2) return "pan";
        if (event.button !== 0) return null;
        if (this.handlers.isHeld("w")) return "window";
        if (event.shiftKey) return "pan";
        if (event.ctrlKey || event.metaKey) return "roll";
        return "orbit";
    }

    private down(event: PointerEvent): void {
        if (this.pointers.size >= 2) return;
        const first = this.pointers.size === 0;
        const kind = first ? this.kindOf(event) : this.kind;
        if (kind === null) return;
        this.pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
        this.element.setPointerCapture(event.pointerId);
        if (first) {
            this.kind = kind;
            this.began = false;
            this.start = { x: event.clientX, y: event.clientY };
        } else {
            // Two fingers are never a click.
            this.begin();
        }
    }

    private begin(): void {
        if (this.began || this.kind === null) return;
        this.began = true;
        this.handlers.dragBegan(this.kind);
    }

    private moved(event: PointerEvent): void {
        const before = this.pointers.get(event.pointerId);
        const box = this.element.getBoundingClientRect();
        if (!before) {
            this.handlers.hover(event.clientX - box.left, event.clientY - box.top);
            return;
        }
        if (this.pointers.size === 2) {
            this.pinch(event, box);
            return;
        }
        if (!this.began && Math.hypot(event.clientX - this.start.x, event.clientY - this.start.y) < clickPixels) return;
        this.begin();
        this.pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
        this.step(this.kind!, event.clientX - before.x, event.clientY - before.y, event, box);
    }

    private step(
        kind: DragKind,
        dx: number,
        dy: number,
        event: { clientX: number; clientY: number; altKey: boolean },
        box: DOMRect,
    ): void {
        this.handlers.drag({
            kind,
            alone: event.altKey,
            dx,
            dy,
            x: event.clientX - box.left - box.width / 2,
            y: event.clientY - box.top - box.height / 2,
            width: box.width,
            height: box.height,
        });
    }

    /** Two fingers: their middle pans, their distance zooms. */
    private pinch(event: PointerEvent, box: DOMRect): void {
        const ends = (): [{ x: number; y: number }, { x: number; y: number }] => {
            const [a, b] = [...this.pointers.values()];
            return [a!, b!];
        };
        const [a0, b0] = ends();
        const before = { x: (a0.x + b0.x) / 2, y: (a0.y + b0.y) / 2, apart: Math.hypot(a0.x - b0.x, a0.y - b0.y) };
        this.pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
        const [a1, b1] = ends();
        const after = { x: (a1.x + b1.x) / 2, y: (a1.y + b1.y) / 2, apart: Math.hypot(a1.x - b1.x, a1.y - b1.y) };
        const middle = { clientX: after.x, clientY: after.y, altKey: event.altKey };
        this.step("pan", after.x - before.x, after.y - before.y, middle, box);
        if (before.apart > 0 && after.apart > 0) {
            this.handlers.zoom({
                factor: after.apart / before.apart,
                x: after.x - box.left - box.width / 2,
                y: after.y - box.top - box.height / 2,
                height: box.height,
                alone: event.altKey,
            });
        }
    }

    private up(event: PointerEvent, cancelled: boolean): void {
        if (!this.pointers.delete(event.pointerId) || this.pointers.size > 0) return;
        const { kind, began } = this;
        this.kind = null;
        this.began = false;
        if (kind === null) return;
        if (began) this.handlers.dragEnded(kind, cancelled);
        else if (!cancelled) this.handlers.click(event);
    }

    private wheel(event: WheelEvent): void {
        event.preventDefault();
        const box = this.element.getBoundingClientRect();
        const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 16 : 1;
        // With Shift, some browsers turn the wheel sideways.
        const turned = (event.shiftKey && event.deltaY === 0 ? event.deltaX : event.deltaY) * lines;
        const zooms = event.ctrlKey || event.metaKey || event.shiftKey;
        if (!zooms && this.handlers.wheelSteps()) {
            this.wheelStep(turned, event.altKey);
            return;
        }
        // A trackpad's pinch arrives as a wheel with Ctrl and small steps; a wheel's notch is never that small.
        const pinch = event.ctrlKey && Math.abs(turned) < wheelPixelsPerStep;
        const pixels = turned * (pinch ? 8 : 1);
        this.handlers.zoom({
            factor: Math.pow(2, -pixels / wheelPixelsPerDoubling),
            x: event.clientX - box.left - box.width / 2,
            y: event.clientY - box.top - box.height / 2,
            height: box.height,
            alone: event.altKey,
        });
    }

    private wheelStep(pixels: number, alone: boolean): void {
        if (Math.abs(pixels) >= wheelPixelsPerStep) {
            this.wheelRest = 0;
            this.handlers.step(-Math.sign(pixels) * Math.max(1, Math.round(Math.abs(pixels) / wheelPixelsPerNotch)), alone);
            return;
        }
        this.wheelRest += pixels;
        const steps = Math.trunc(this.wheelRest / wheelPixelsPerStep);
        if (steps === 0) return;
        this.wheelRest -= steps * wheelPixelsPerStep;
        this.handlers.step(-steps, alone);
    }
}
