// A list of colour maps, each as its gradient.
import { useEffect, useRef, useState } from "preact/hooks";
import type { ColourMap, StyleValue } from "../api/types";
import { formatAddress } from "../model/address";
import { useSelect } from "./app_context";
import { gradient } from "./ColourBar";
import { popupPlace } from "./popup_place";

/** A map that is chosen from the data has no stops of its own: it looks as the active cell's colour bar does. */
function Swatch({ map }: { map: ColourMap | undefined }) {
    const drawn = useSelect((state) => state.book.bars[formatAddress(state.page.selection.active)]);
    const stops = map?.stops ?? drawn?.stops;
    return <i class="swatch" style={stops ? { background: gradient(stops, "to right") } : {}} />;
}

export function ColourMapPicker({ id, value, choices, set }: {
    id: string;
    value: string;
    choices: string[];
    set: (value: StyleValue) => void;
}) {
    const maps = useSelect((state) => state.connection.maps);
    const [open, setOpen] = useState(false);
    const root = useRef<HTMLDivElement>(null);
    const names = choices.length ? choices : maps.map((map) => map.name);
    const mapOf = (name: string): ColourMap | undefined => maps.find((map) => map.name === name);
    useEffect(() => {
        if (!open) return;
        root.current?.querySelector<HTMLElement>("[aria-selected=true], [role=option]")?.focus();
        const outside = (event: PointerEvent): void => {
            if (!root.current?.contains(event.target as Node)) setOpen(false);
        };
        document.addEventListener("pointerdown", outside);
        return () => document.removeEventListener("pointerdown", outside);
    }, [open]);
    const onKeyDown = (event: KeyboardEvent): void => {
        if (event.key === "Escape") {
            event.stopPropagation();
            setOpen(false);
            root.current?.querySelector<HTMLElement>(".map-button")?.focus();
        }
        if (event.key !== "ArrowDown" && event.key !== "ArrowUp") return;
        event.preventDefault();
        const options = [...(root.current?.querySelectorAll<HTMLElement>("[role=option]") ?? [])];
        const at = options.indexOf(document.activeElement as HTMLElement);
        options[(at + (event.key === "ArrowDown" ? 1 : options.length - 1)) % options.length]?.focus();
    };
    return (
        <div class="map-picker" ref={root} onKeyDown={onKeyDown}>
            <button
                type="button"
                id={id}
                class="map-button"
                aria-haspopup="listbox"
                aria-expanded={open}
                aria-label={`Colour map: ${mapOf(value)?.label ?? value}`}
                onClick={() => setOpen(!open)}
            >
                <Swatch map={mapOf(value)} />
                <span>{mapOf(value)?.label ?? value}</span>
            </button>
            {open && (
                <div
                    class="map-list"
                    role="listbox"
                    aria-label="Colour maps"
                    style={popupPlace(root.current?.querySelector(".map-button") ?? null, "right")}
                >
                    {names.map((name) => (
                        <button
                            type="button"
                            key={name}
                            role="option"
                            aria-selected={name === value}
                            data-map={name}
                            onClick={() => {
                                setOpen(false);
                                set(name);
                            }}
                        >
                            <Swatch map={mapOf(name)} />
                            <span>{mapOf(name)?.label ?? name}</span>
                            <small>{mapOf(name)?.kind ?? ""}</small>
                        </button>
                    ))}
                </div>
            )}
        </div>
    );
}
