// Keys that work anywhere on the page, unless something is being typed.
import type { App } from "../app/app";
import { formatAddress } from "../model/address";
import { orbited, panned, zoomed, type Camera, type FlatView } from "../model/camera";
import { flatView, isPlane } from "../model/plane_view";

const orbitDegrees = 5;
const panPart = 0.04;
const zoomFactor = 1.15;

export interface ShortcutTargets {
    editFormula(text?: string): void;
    focusPicture(cell: string): void;
}

function isTyping(target: EventTarget | null): boolean {
    if (!(target instanceof HTMLElement)) return false;
    return target.isContentEditable || ["INPUT", "TEXTAREA", "SELECT"].includes(target.tagName);
}

/** Controls that use Enter and space themselves. */
function isControl(target: EventTarget | null): boolean {
    return target instanceof HTMLElement && target.closest("button, a, [role=slider], [role=menu], [role=listbox]") !== null;
}

const arrows: Record<string, [number, number]> = {
    ArrowLeft: [-1, 0],
    ArrowRight: [1, 0],
    ArrowUp: [0, -1],
    ArrowDown: [0, 1],
};

/** Degrees and parts of the picture's height become pixels of a picture 180 pixels high. */
const nominalHeight = 180;

/** \param flat  set where the picture shows a plane, which has one side to be seen from: arrows move it */
export function moveByKey(camera: Camera, event: { key: string; shiftKey: boolean }, flat?: FlatView): Camera | null {
    const arrow = arrows[event.key];
    if (arrow && (event.shiftKey || flat)) {
        return panned(camera, arrow[0] * panPart * nominalHeight, arrow[1] * panPart * nominalHeight, nominalHeight, flat);
    }
    if (arrow) return orbited(camera, arrow[0] * orbitDegrees, arrow[1] * orbitDegrees, nominalHeight);
    if (event.key === "+" || event.key === "=") return zoomed(camera, zoomFactor, 0, 0, nominalHeight, flat);
    if (event.key === "-") return zoomed(camera, 1 / zoomFactor, 0, 0, nominalHeight, flat);
    return null;
}

class Shortcuts {
    constructor(
        private readonly app: App,
        private readonly targets: ShortcutTargets,
    ) {}

    keyDown(event: KeyboardEvent): void {
        if (event.defaultPrevented || isTyping(event.target)) return;
        // AltGr, by which many keyboards type [ and ], may count as Ctrl + Alt.
        const typed = event.getModifierState("AltGraph");
        const handled = (event.ctrlKey || event.metaKey) && !typed ? this.command(event) : this.plain(event);
        if (handled) event.preventDefault();
    }

    private command(event: KeyboardEvent): boolean {
        const key = event.key.toLowerCase();
        if (key === "z") void (event.shiftKey ? this.app.redo() : this.app.undo());
        else if (key === "y") void this.app.redo();
        else if (key === "s") void this.app.cells.save();
        else return false;
        return true;
    }

    private plain(event: KeyboardEvent): boolean {
        const { store, view, cells } = this.app;
        const { page } = store.get();
        const active = formatAddress(page.selection.active);
        const onPicture = event.target instanceof HTMLElement && event.target.dataset["pictureOf"] !== undefined;
        const nowhere = event.target === document.body;
        // "=" begins a formula everywhere but on a picture, where it is the unshifted "+".
        if ((onPicture || nowhere) && !(event.key === "=" && !onPicture) && this.moveCamera(event, active)) return true;
        switch (event.key) {
            case "?":
                store.dispatch({ type: "page/help", open: !page.help });
                return true;
            case "Escape":
                this.escape();
                return true;
            case "F2":
                this.targets.editFormula();
                return true;
            case "=":
                this.targets.editFormula("=");
                return true;
            case "r":
                view.reset(event.altKey ? active : null);
                return true;
            case "c":
                this.app.clips.toggleHandles();
                return true;
            case "f":
                view.fit(active, this.aspectOf(active), event.altKey);
                view.stepped();
                return true;
            case "[":
            case "]":
                this.app.planes.step(active, event.key === "]" ? 1 : -1, event.altKey && !event.getModifierState("AltGraph"));
                return true;
            case "PageUp":
            case "PageDown":
                if (!(onPicture || nowhere) || !isPlane(view.cell(active))) return false;
                this.app.planes.step(active, event.key === "PageUp" ? 1 : -1, event.altKey);
                return true;
            case "x":
                this.app.planes.crosshairHere(event.altKey);
                return true;
            case "X":
                this.app.planes.crosshairOff(event.altKey);
                return true;
            case "p":
                void this.app.planes.beside();
                return true;
            case "z":
            case "Z":
                this.app.grid.step(event.shiftKey ? -1 : 1);
                return true;
            case "0":
                this.app.grid.fit();
                return true;
            case "Delete":
                void cells.clearSelected();
                return true;
            case ",":
                view.advance(-1);
                return true;
            case ".":
                view.advance(1);
                return true;
        }
        if (isControl(event.target)) return false;
        if (event.key === " ") view.togglePlaying();
        else if (event.key === "Enter") view.enlarge(page.enlarged === null ? active : null);
        else return false;
        return true;
    }

    private moveCamera(event: KeyboardEvent, cell: string): boolean {
        const shown = this.app.view.cell(cell);
        const camera = moveByKey(this.app.view.camera(cell), event, flatView(shown, this.aspectOf(cell)));
        if (!camera || shown?.state !== "ok") return false;
        this.app.view.setCamera(cell, camera, event.altKey);
        this.app.view.stepped();
        return true;
    }

    private escape(): void {
        const { store, view } = this.app;
        const { page } = store.get();
        if (page.help) store.dispatch({ type: "page/help", open: false });
        else if (page.enlarged !== null) {
            const cell = page.enlarged;
            view.enlarge(null);
            this.targets.focusPicture(cell);
        } else if (page.leftPanel === "open" || page.leftPanel === "save") store.dispatch({ type: "page/leftPanel", panel: "datasets" });
    }

    private aspectOf(cell: string): number {
        const box = document.querySelector(`[data-picture-of="${cell}"]`)?.getBoundingClientRect();
        return box && box.height > 0 ? box.width / box.height : 1;
    }
}

/** Copy and paste through the browser's own events, which need no permission. */
function watchClipboard(app: App): void {
    const ours = (): boolean => !isTyping(document.activeElement) && !window.getSelection()?.toString();
    const copy = (event: ClipboardEvent, cut: boolean): void => {
        if (!ours()) return;
        event.preventDefault();
        event.clipboardData?.setData("text/plain", app.cells.copy());
        if (cut) void app.cells.clearSelected();
    };
    document.addEventListener("copy", (event) => copy(event, false));
    document.addEventListener("cut", (event) => copy(event, true));
    document.addEventListener("paste", (event) => {
        const text = event.clipboardData?.getData("text/plain") ?? "";
        if (!ours() || text === "") return;
        event.preventDefault();
        void app.cells.paste(text);
    });
}

export function watchShortcuts(app: App, targets: ShortcutTargets): void {
    const shortcuts = new Shortcuts(app, targets);
    document.addEventListener("keydown", (event) => shortcuts.keyDown(event));
    watchClipboard(app);
}
