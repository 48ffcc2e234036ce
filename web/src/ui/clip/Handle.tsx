// Something on a picture that is dragged, or moved by keys, to change one style value.
import type { ComponentChildren } from "preact";
import type { StylePatch } from "../../api/types";
import { followPointer } from "../../input/pointer_drag";
import type { Pixel } from "../../model/projection";
import { useApp } from "../app_context";

/** Which way a key moves, and how far: 0.01, with Shift 0.1. */
export interface KeyStep {
    x: number;
    /** Upwards. */
    y: number;
    /** Away from the viewer: Page Up and Page Down. */
    z: number;
}

export interface HandleProps {
    cell: string;
    /** The style key that it changes. */
    styleKey: string;
    /** Names it among the handles of a cell. */
    name: string;
    label: string;
    /** For screen readers: where it stands, 0 to 1 where that makes sense. */
    now?: number;
    text: string;
    /** Of the active cell: reached by Tab. */
    reachable: boolean;
    /** Called when it is pressed; what it returns turns the pointer's place into an edit. */
    drag: (pressed: Pixel, event: PointerEvent) => (pointer: Pixel) => StylePatch;
    keys: (step: KeyStep) => StylePatch | null;
    remove?: () => StylePatch;
    children: ComponentChildren;
}

const keyDirections: Record<string, [number, number, number]> = {
    ArrowLeft: [-1, 0, 0],
    ArrowRight: [1, 0, 0],
    ArrowUp: [0, 1, 0],
    ArrowDown: [0, -1, 0],
    PageUp: [0, 0, 1],
    PageDown: [0, 0, -1],
};

function keyStep(event: KeyboardEvent): KeyStep | null {
    const direction = keyDirections[event.key];
    if (!direction) return null;
    const size = event.shiftKey ? 0.1 : 0.01;
    return { x: size * direction[0], y: size * direction[1], z: size * direction[2] };
}

export function Handle(props: HandleProps) {
    const { cell, styleKey, name } = props;
    const app = useApp();
    const press = (event: PointerEvent): void => {
        event.stopPropagation();
        if (event.button !== 0) return;
        event.preventDefault();
        const element = event.currentTarget as SVGGElement;
        element.focus({ preventScroll: true });
        const box = element.ownerSVGElement!.getBoundingClientRect();
        const pixel = (at: PointerEvent): Pixel => ({ x: at.clientX - box.left, y: at.clientY - box.top });
        const patchAt = props.drag(pixel(event), event);
        const edit = app.beginEdit(app.styles.homeOf(cell, styleKey, event.altKey));
        followPointer(event, element, {
            move: (next) => edit.show(patchAt(pixel(next))),
            end: (cancelled) => (cancelled ? edit.cancel() : void edit.end()),
        });
    };
    const key = (event: KeyboardEvent): void => {
        if (event.ctrlKey || event.metaKey) return;
        const step = keyStep(event);
        const removing = event.key === "Delete" || event.key === "Backspace";
        const patch = step ? props.keys(step) : removing ? (props.remove?.() ?? null) : null;
        if (!step && !(removing && patch)) return;
        event.preventDefault();
        event.stopPropagation();
        if (!patch) return;
        const targets = app.styles.homeOf(cell, styleKey, event.altKey);
        if (removing) void app.keyEdits.finish().then(() => app.styles.set(patch, targets));
        else app.keyEdits.show(`${cell} ${name} ${event.altKey}`, targets, patch);
    };
    return (
        <g
            class="handle"
            data-handle={name}
            role="slider"
            tabIndex={props.reachable ? 0 : -1}
            aria-label={props.label}
            aria-valuenow={props.now}
            aria-valuemin={props.now === undefined ? undefined : 0}
            aria-valuemax={props.now === undefined ? undefined : 1}
            aria-valuetext={props.text}
            onPointerDown={press}
            onPointerMove={(event) => event.stopPropagation()}
            onDblClick={(event) => event.stopPropagation()}
            onKeyDown={key}
            onBlur={() => void app.keyEdits.finish()}
        >
            <title>{props.label}</title>
            {props.children}
        </g>
    );
}

/** The target is 24 px, the mark 12 px. */
export function HandleDisc({ at, mark = "disc" }: { at: Pixel; mark?: "disc" | "square" | "tip" }) {
    return (
        <g transform={`translate(${at.x.toFixed(1)} ${at.y.toFixed(1)})`}>
            <circle class="handle-target" r={12} />
            {mark === "square" ? (
                <rect class="handle-mark" x={-5} y={-5} width={10} height={10} rx={2} />
            ) : (
                <circle class="handle-mark" r={mark === "tip" ? 4.5 : 6} />
            )}
        </g>
    );
}
