// A field that keeps what is typed until Enter or leaving it.
import { useState } from "preact/hooks";

export function TextField({ id, value, set, step, label, placeholder, numeric }: {
    id?: string;
    value: string;
    set: (text: string) => void;
    /** Arrow keys: 1 up, -1 down, ten times as far with Shift. */
    step?: (by: number) => void;
    label?: string;
    placeholder?: string;
    numeric?: boolean;
}) {
    const [typed, setTyped] = useState<string | null>(null);
    const commit = (): void => {
        if (typed !== null && typed !== value) set(typed);
        setTyped(null);
    };
    return (
        <input
            id={id}
            class={numeric ? "number-field" : "text-field"}
            aria-label={label}
            inputMode={numeric ? "decimal" : undefined}
            placeholder={placeholder}
            spellcheck={false}
            value={typed ?? value}
            onInput={(event) => setTyped(event.currentTarget.value)}
            onBlur={commit}
            onKeyDown={(event) => {
                if (event.key === "Enter") commit();
                if (event.key === "Escape") setTyped(null);
                if (!step || (event.key !== "ArrowUp" && event.key !== "ArrowDown")) return;
                event.preventDefault();
                setTyped(null);
                step((event.key === "ArrowUp" ? 1 : -1) * (event.shiftKey ? 10 : 1));
            }}
        />
    );
}
