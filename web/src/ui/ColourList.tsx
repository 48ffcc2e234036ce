// A list of colours: swatches to change, add and remove.
import { Plus, X } from "lucide-preact";
import type { StyleValue } from "../api/types";
import { keyLabel } from "../model/keys";
import { IconButton } from "./IconButton";
import type { ControlProps } from "./KeyControl";

const mostColours = 8;
const plainColour = /^#[0-9a-fA-F]{6}$/;

/** What new entries begin with: colours that are told apart by most people (Okabe and Ito 2008). */
const firstColours = ["#56b4e9", "#e69f00", "#009e73", "#f0e442", "#cc79a7", "#0072b2", "#d55e00", "#ffffff"];

function coloursOf(value: StyleValue | undefined): string[] {
    const list = Array.isArray(value) ? value : typeof value === "string" ? value.split(",") : [];
    return list.map((entry) => String(entry).trim()).filter((entry) => plainColour.test(entry));
}

export function ColourList({ spec, value, id, set, preview }: ControlProps) {
    const colours = coloursOf(value);
    const label = keyLabel(spec.name, spec.group);
    const empty = spec.takesAuto ? "auto" : spec.takesNone ? "none" : null;
    const withColour = (at: number, colour: string): string[] => colours.map((old, i) => (i === at ? colour : old));
    const remove = (at: number): void => {
        const left = colours.filter((_, i) => i !== at);
        if (left.length || empty) set(left.length ? left : empty!);
    };
    return (
        <div class="colour-list" role="group" aria-label={label} id={id}>
            {colours.map((colour, i) => (
                <span class="listed-colour" key={i}>
                    <input
                        type="color"
                        aria-label={`${label} ${i + 1}`}
                        value={colour}
                        onInput={(event) => preview(withColour(i, event.currentTarget.value))}
                        onChange={(event) => set(withColour(i, event.currentTarget.value))}
                    />
                    {(colours.length > 1 || empty) && (
                        <IconButton icon={X} class="small" label={`Remove ${label} ${i + 1}`} onClick={() => remove(i)} />
                    )}
                </span>
            ))}
            {colours.length === 0 && <span class="stands-for">{String(value ?? empty ?? "")}</span>}
            {colours.length < mostColours && (
                <IconButton
                    icon={Plus}
                    class="small add"
                    label={`Add to ${label}`}
                    onClick={() => set([...colours, firstColours[colours.length % firstColours.length]!])}
                />
            )}
        </div>
    );
}
