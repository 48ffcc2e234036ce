// Where a list that belongs to a button opens: below it, or above it where the window ends. Fixed to the window, so that no
// scrolling panel cuts it off.

const assumedHeight = 260;

export function popupPlace(button: Element | null, align: "left" | "right"): Record<string, string> {
    if (!button) return {};
    const box = button.getBoundingClientRect();
    const below = window.innerHeight - box.bottom;
    const vertical: Record<string, string> =
        below < assumedHeight && box.top > below
            ? { bottom: `${window.innerHeight - box.top + 2}px`, maxHeight: `${box.top - 8}px` }
            : { top: `${box.bottom + 2}px`, maxHeight: `${below - 8}px` };
    const horizontal: Record<string, string> =
        align === "right" ? { right: `${Math.max(0, window.innerWidth - box.right)}px` } : { left: `${box.left}px` };
    return { position: "fixed", ...vertical, ...horizontal };
}
