// Directions of the lights on a ball: a press or drag puts the light there, over the rim it goes behind.
import { useRef } from "preact/hooks";
import type { CellState, StylePatch } from "../api/types";
import { followPointer } from "../input/pointer_drag";
import { directionAt } from "../model/clip/arrow_ball";
import { formatNumber } from "../model/format";
import { lightFromView, lightInView, lightsOf, type LightFrame } from "../model/light";
import { cameraOf } from "../model/look";
import { add, applied, rotation, scaled, type Vector } from "../model/vector";
import { useApp, useSelect } from "./app_context";

const key = "light.direction";
const radius = 40;
const margin = 14;
const size = 2 * (radius + margin);

/** Half a turn is the whole: arrow keys go 1 % of it, 10 % with Shift. */
function turnedByKey(event: KeyboardEvent, direction: Vector): Vector | null {
    const steps: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const step = steps[event.key];
    if (!step) return null;
    const axis = add(scaled([0, 1, 0], step[0]), scaled([1, 0, 0], -step[1]));
    return applied(rotation(axis, Math.PI * (event.shiftKey ? 0.1 : 0.01)), direction);
}

export function LightBall({ cell }: { cell: CellState }) {
    const app = useApp();
    const live = useSelect((state) => state.page.live[cell.cell]?.[key]);
    const camera = useSelect((state) => cameraOf(state.page.look, cell), (a, b) => JSON.stringify(a) === JSON.stringify(b));
    const ball = useRef<SVGSVGElement>(null);
    const frame: LightFrame = cell.style["light.frame"]?.value === "world" ? "world" : "view";
    const given = lightsOf(live ?? cell.style[key]?.value);
    const lights = given.map((direction) => lightInView(direction, frame, camera));

    /** In radii from the ball's middle, y upwards. */
    const place = (event: PointerEvent): { x: number; y: number } => {
        const box = ball.current!.getBoundingClientRect();
        const unit = (box.width * radius) / size;
        return { x: (event.clientX - box.left - box.width / 2) / unit, y: -(event.clientY - box.top - box.height / 2) / unit };
    };
    const patch = (index: number, inView: Vector): StylePatch => {
        const light = lightFromView(inView, frame, camera);
        const next = index < given.length ? given.map((old, i) => (i === index ? light : old)) : [...given, light];
        return { [key]: next.map((each) => [...each]) };
    };
    const press = (event: PointerEvent): void => {
        if (event.button !== 0) return;
        event.preventDefault();
        const at = place(event);
        const away = (light: Vector): number => Math.hypot(light[0] - at.x, light[1] - at.y);
        const index = lights.reduce((best, light, i) => (away(light) < away(lights[best]!) ? i : best), 0);
        const front = (lights[index]?.[2] ?? 1) >= 0 || away(lights[index]!) > 0.4;
        const edit = app.beginEdit(app.styles.targets());
        const show = ({ x, y }: { x: number; y: number }): void => edit.show(patch(index, directionAt(x, y, front)));
        show(at);
        followPointer(event, ball.current!, {
            move: (next) => show(place(next)),
            end: (cancelled) => (cancelled ? edit.cancel() : void edit.end()),
        });
    };
    const onKey = (event: KeyboardEvent, index: number): void => {
        const turned = turnedByKey(event, lights[index]!);
        if (!turned) return;
        event.preventDefault();
        event.stopPropagation();
        app.keyEdits.show(`${cell.cell} ${key} ${index}`, app.styles.targets(), patch(index, turned));
    };
    const brightest = lights[0] ?? [0, 0, 1];
    const behind = brightest[2] < 0;
    return (
        <div class="light-ball">
            <svg
                ref={ball}
                width={size}
                height={size}
                viewBox={`${-size / 2} ${-size / 2} ${size} ${size}`}
                role="group"
                aria-label="Directions of the lights"
                onPointerDown={press}
            >
                <title>Press where the light comes from; over the rim is behind</title>
                <defs>
                    <radialGradient id="lit" gradientUnits="userSpaceOnUse" cx={brightest[0] * radius * 0.8} cy={-brightest[1] * radius * 0.8} r={radius * 1.5}>
                        <stop offset="0" stop-color={behind ? "#8a8a8a" : "#f4f4f4"} />
                        <stop offset="1" stop-color="#26282b" />
                    </radialGradient>
                </defs>
                <circle r={radius} fill="url(#lit)" />
                {lights.map(([x, y, z], i) => (
                    <g
                        key={i}
                        class={`handle light ${z < 0 ? "behind" : ""}`}
                        role="slider"
                        tabIndex={0}
                        aria-label={`Light ${i + 1}: arrow keys turn it`}
                        aria-valuetext={(given[i] ?? []).map((part) => formatNumber(part, 3)).join(", ")}
                        transform={`translate(${(x * radius).toFixed(2)} ${(-y * radius).toFixed(2)})`}
                        onKeyDown={(event) => onKey(event, i)}
                        onBlur={() => void app.keyEdits.finish()}
                    >
                        <circle class="handle-target" r={12} />
                        <circle class="handle-mark" r={5} />
                    </g>
                ))}
            </svg>
            <p>{lights.length ? `${lights.length === 1 ? "one light" : `${lights.length} lights`}, ${frame === "view" ? "fixed to the viewer" : "fixed to the world"}` : "press to add a light besides that at the eye"}</p>
        </div>
    );
}
