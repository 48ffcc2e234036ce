// A button with a menu: arrow keys move, Enter chooses, Esc and a click elsewhere close.
import type { ComponentChildren } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { popupPlace } from "./popup_place";

export interface MenuItem {
    label: string;
    hint?: string;
    href?: string;
    download?: string;
    onChoose?: () => void;
    disabled?: boolean;
}

export interface MenuProps {
    label: string;
    items: MenuItem[];
    children: ComponentChildren;
    class?: string;
    align?: "left" | "right";
}

export function Menu({ label, items, children, class: extra, align = "right" }: MenuProps) {
    const [open, setOpen] = useState(false);
    const root = useRef<HTMLDivElement>(null);
    const button = useRef<HTMLButtonElement>(null);
    useEffect(() => {
        if (!open) return;
        root.current?.querySelector<HTMLElement>("[role=menuitem]")?.focus();
        const outside = (event: PointerEvent): void => {
            if (!root.current?.contains(event.target as Node)) setOpen(false);
        };
        document.addEventListener("pointerdown", outside);
        return () => document.removeEventListener("pointerdown", outside);
    }, [open]);

    const close = (): void => {
        setOpen(false);
        button.current?.focus();
    };
    const onKeyDown = (event: KeyboardEvent): void => {
        if (event.key === "Escape") {
            event.stopPropagation();
            close();
        }
        if (event.key !== "ArrowDown" && event.key !== "ArrowUp") return;
        event.preventDefault();
        const entries = [...(root.current?.querySelectorAll<HTMLElement>("[role=menuitem]:not([aria-disabled=true])") ?? [])];
        const at = entries.indexOf(document.activeElement as HTMLElement);
        const step = event.key === "ArrowDown" ? 1 : entries.length - 1;
        entries[(at + step) % entries.length]?.focus();
    };
    const choose = (item: MenuItem): void => {
        close();
        item.onChoose?.();
    };

    return (
        <div class={`menu ${extra ?? ""}`} ref={root} onKeyDown={open ? onKeyDown : undefined}>
            <button
                type="button"
                ref={button}
                class="icon-button"
                aria-haspopup="menu"
                aria-expanded={open}
                aria-label={label}
                title={label}
                onClick={() => setOpen(!open)}
            >
                {children}
            </button>
            {open && (
                <div class="menu-list" role="menu" aria-label={label} style={popupPlace(button.current, align)}>
                    {items.map((item) =>
                        item.href ? (
                            <a role="menuitem" key={item.label} href={item.href} download={item.download} onClick={close}>
                                {item.label}
                                {item.hint && <small>{item.hint}</small>}
                            </a>
                        ) : (
                            <button
                                type="button"
                                role="menuitem"
                                key={item.label}
                                aria-disabled={item.disabled}
                                disabled={item.disabled}
                                onClick={() => choose(item)}
                            >
                                {item.label}
                                {item.hint && <small>{item.hint}</small>}
                            </button>
                        ),
                    )}
                </div>
            )}
        </div>
    );
}
