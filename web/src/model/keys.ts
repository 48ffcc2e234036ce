// The key table as the inspector shows it.
import type { CellState, StyleKey, StyleValue } from "../api/types";

export interface KeyGroup {
    name: string;
    keys: StyleKey[];
}

/** Groups in the table's order. Keys that depend on another key appear only while that has one of the right values. */
export function groupKeys(keys: readonly StyleKey[], cell: CellState | undefined): KeyGroup[] {
    const groups = new Map<string, StyleKey[]>();
    for (const key of keys) {
        if (!applies(key, cell)) continue;
        const name = key.group || "Other";
        groups.set(name, [...(groups.get(name) ?? []), key]);
    }
    return [...groups].map(([name, members]) => ({ name, keys: members }));
}

function applies(key: StyleKey, cell: CellState | undefined): boolean {
    const condition = key.appliesWhen;
    if (!condition?.key || !cell) return true;
    const value = cell.style[condition.key]?.value;
    return value === undefined || condition.values.includes(String(value));
}

/** Controls that need the whole width of the panel. */
export function isWide(key: StyleKey): boolean {
    return ["numberRows", "colours", "text"].includes(key.type);
}

export function choicesOf(key: StyleKey): string[] {
    return key.choices ?? key.values ?? [];
}

/** The choices with the words that stand for no choice: "auto", "none". */
export function optionsOf(key: StyleKey): string[] {
    const words = [...(key.takesAuto ? ["auto"] : []), ...(key.takesNone ? ["none"] : [])];
    return [...new Set([...words, ...choicesOf(key)])];
}

/** "transfer.unitLength" in group "Transfer function" -> "Unit length"; in another group "Transfer unit length". */
export function keyLabel(key: string, group = ""): string {
    const parts = key.split(".");
    const inGroup = parts.length > 1 && group.toLowerCase().startsWith(parts[0]!.toLowerCase());
    const text = (inGroup ? parts.slice(1) : parts).join(" ");
    const words = text.replace(/([a-z])([A-Z0-9])/g, "$1 $2").toLowerCase().replace(/\bnan\b/, "NaN");
    return words.charAt(0).toUpperCase() + words.slice(1);
}

/** What a text field shows; readValue reads it back. */
export function valueText(value: StyleValue | undefined): string {
    if (value === undefined || value === null) return "";
    return Array.isArray(value) ? JSON.stringify(value) : String(value);
}

/** Lists as JSON, numbers as numbers, the rest as words; an empty text resets. */
export function readValue(text: string): StyleValue {
    const trimmed = text.trim();
    if (trimmed === "") return null;
    if (/^[[{]/.test(trimmed)) {
        try {
            return JSON.parse(trimmed) as StyleValue;
        } catch {
            return trimmed;
        }
    }
    const number = Number(trimmed);
    return Number.isFinite(number) ? number : trimmed;
}

/** A slider is of use only over a span that one can see: not for 1e-30 … 1e30. */
export function sliderSpan(key: StyleKey): { min: number; max: number; step: number } | null {
    const { min, max } = key;
    if (typeof min !== "number" || typeof max !== "number" || max - min > 400 || max <= min) return null;
    const step = key.type === "integer" ? 1 : Number(((max - min) / 200).toPrecision(2));
    return { min, max, step };
}
