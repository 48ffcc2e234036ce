// The control for one style key, by its type. Dragging previews, letting go writes.
import { useEffect, useRef, useState } from "preact/hooks";
import type { StyleKey, StyleValue } from "../api/types";
import { plainNumber } from "../model/format";
import { choicesOf, optionsOf, readValue, sliderSpan, valueText } from "../model/keys";
import { useApp } from "./app_context";
import { ColourList } from "./ColourList";
import { ColourMapPicker } from "./ColourMapPicker";
import { NumberRows } from "./NumberRows";
import { SuggestedText } from "./SuggestedText";
import { TextField } from "./TextField";

export interface ControlProps {
    spec: StyleKey;
    value: StyleValue | undefined;
    id: string;
    /** Where the value goes. */
    set: (value: StyleValue) => void;
    preview: (value: StyleValue) => void;
    /** For keys that are pressed in a row: previews now, writes once they rest. */
    nudge: (value: StyleValue) => void;
}

function NumberControl({ spec, value, id, set, preview }: ControlProps) {
    const { view } = useApp();
    const dragging = useRef(false);
    const [dragged, setDragged] = useState<number | null>(null);
    useEffect(() => setDragged(null), [value]);
    const span = spec.widget === "slider" || !spec.widget ? sliderSpan(spec) : null;
    const number = typeof value === "number" ? value : typeof spec.default === "number" ? spec.default : (span?.min ?? 0);
    const shown = dragged ?? (typeof value === "number" ? value : null);
    const text = shown !== null ? plainNumber(shown) : valueText(value);
    const finish = (next: number): void => {
        if (dragging.current) view.gestureEnded();
        dragging.current = false;
        set(next);
    };
    return (
        <span class="number-control">
            {span && (
                <input
                    type="range"
                    aria-label={`${spec.name}, slider`}
                    min={span.min}
                    max={span.max}
                    step={span.step}
                    value={shown ?? number}
                    onInput={(event) => {
                        if (!dragging.current) view.gestureBegan();
                        dragging.current = true;
                        const next = Number(event.currentTarget.value);
                        setDragged(next);
                        preview(next);
                    }}
                    onChange={(event) => finish(Number(event.currentTarget.value))}
                />
            )}
            <TextField id={id} numeric value={text} set={(typed) => set(readValue(typed))} placeholder={spec.takesAuto ? "auto" : ""} />
        </span>
    );
}

function SelectControl({ spec, value, id, set }: ControlProps) {
    return (
        <select id={id} value={String(value ?? "")} onChange={(event) => set(event.currentTarget.value)}>
            {optionsOf(spec).map((choice) => (
                <option key={choice} value={choice}>
                    {choice}
                </option>
            ))}
        </select>
    );
}

const plainColour = /^#[0-9a-fA-F]{6}$/;

function ColourControl({ spec, value, id, set, preview }: ControlProps) {
    const text = valueText(value);
    return (
        <span class="colour-control">
            <input
                type="color"
                aria-label={`${spec.name}, colour`}
                value={plainColour.test(text) ? text : "#000000"}
                onInput={(event) => preview(event.currentTarget.value)}
                onChange={(event) => set(event.currentTarget.value)}
            />
            <TextField id={id} value={text} set={(typed) => set(typed.trim() || null)} placeholder={spec.takesNone ? "none" : ""} />
        </span>
    );
}

function VectorControl({ spec, value, id, set }: ControlProps) {
    const parts = Array.isArray(value) ? value : spec.takesNone ? [null, null, null] : [0, 0, 0];
    return (
        <span class="vector-control">
            {["x", "y", "z"].map((axis, i) => (
                <TextField
                    key={axis}
                    numeric
                    id={i === 0 ? id : undefined}
                    label={`${spec.name} ${axis}`}
                    value={typeof parts[i] === "number" ? plainNumber(parts[i]) : ""}
                    placeholder={spec.takesNone ? "none" : ""}
                    set={(typed) => {
                        const number = Number(typed);
                        // The first number of a vector that was none: the others are 0 until they are typed.
                        if (Number.isFinite(number)) set(parts.map((part, j) => (j === i ? number : (part ?? 0))));
                    }}
                />
            ))}
        </span>
    );
}

export function KeyControl(props: ControlProps) {
    const { spec, value, id, set } = props;
    if (spec.name === "transfer.map") return <ColourMapPicker id={id} value={String(value ?? "")} set={set} choices={choicesOf(spec)} />;
    switch (spec.type) {
        case "number":
        case "integer":
            return <NumberControl {...props} />;
        case "choice":
        case "enum":
            return <SelectControl {...props} />;
        case "bool":
        case "boolean":
            return <input id={id} type="checkbox" checked={value === true} onChange={(event) => set(event.currentTarget.checked)} />;
        case "colour":
            return <ColourControl {...props} />;
        case "vector3":
        case "vec3":
            return <VectorControl {...props} />;
        case "numberRows":
            return <NumberRows {...props} />;
        case "colours":
            return <ColourList {...props} />;
        case "text":
            return <SuggestedText {...props} />;
        default:
            return <TextField id={id} value={valueText(value)} set={(typed) => set(readValue(typed))} placeholder={spec.takesAuto ? "auto" : ""} />;
    }
}
