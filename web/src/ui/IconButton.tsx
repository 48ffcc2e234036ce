// A button that is an icon: always with a name for screen readers and a tooltip.
import type { LucideIcon } from "lucide-preact";

export interface IconButtonProps {
    icon: LucideIcon;
    label: string;
    /** Shown after the label in the tooltip. */
    keys?: string;
    onClick: () => void;
    disabled?: boolean;
    pressed?: boolean;
    text?: string;
    class?: string;
}

export function IconButton({ icon: Icon, label, keys, onClick, disabled, pressed, text, class: extra }: IconButtonProps) {
    return (
        <button
            type="button"
            class={`icon-button ${extra ?? ""}`}
            aria-label={label}
            title={keys ? `${label} (${keys})` : label}
            aria-pressed={pressed}
            disabled={disabled}
            onClick={onClick}
        >
            <Icon size={16} aria-hidden="true" />
            {text && <span>{text}</span>}
        </button>
    );
}
