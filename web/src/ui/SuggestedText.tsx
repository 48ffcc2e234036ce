// A text with a menu of what it is likely to be.
import { ChevronDown } from "lucide-preact";
import { formatAddress } from "../model/address";
import { keyLabel, valueText } from "../model/keys";
import { suggestionsFor } from "../model/suggestions";
import { roundedValue } from "../model/transfer";
import { currentSheet } from "../state/book";
import { useSelect } from "./app_context";
import type { ControlProps } from "./KeyControl";
import { Menu } from "./Menu";
import { TextField } from "./TextField";

export function SuggestedText({ spec, value, id, set }: ControlProps) {
    const sheet = useSelect((state) => currentSheet(state.book));
    const datasets = useSelect((state) => state.book.datasets);
    const active = useSelect((state) => formatAddress(state.page.selection.active));
    const bar = useSelect((state) => state.book.bars[active]);
    const middle = bar ? roundedValue((bar.low + bar.high) / 2, bar) : null;
    const label = keyLabel(spec.name, spec.group);
    return (
        <span class="suggested-text">
            <TextField id={id} value={valueText(value)} set={(typed) => set(typed.trim() || null)} placeholder={spec.takesNone ? "none" : ""} />
            <Menu
                class="small"
                label={`Choose ${label}`}
                items={suggestionsFor(spec, sheet?.cells ?? [], datasets, active, middle).map(({ text, hint }) => ({
                    label: text,
                    ...(hint ? { hint } : {}),
                    onChoose: () => set(text),
                }))}
            >
                <ChevronDown size={14} aria-hidden="true" />
            </Menu>
        </span>
    );
}
