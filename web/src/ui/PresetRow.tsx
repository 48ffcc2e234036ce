// Looks that are chosen with one press: they set several keys at the layer that the inspector edits.
import { useApp, useSelect } from "./app_context";

export function PresetRow() {
    const app = useApp();
    const presets = useSelect((state) => state.connection.presets);
    if (presets.length === 0) return null;
    return (
        <div class="preset-row" role="group" aria-label="Presets">
            {presets.map(({ name, label, doc, style }) => (
                <button type="button" key={name} class="chip" title={doc} data-preset={name} onClick={() => void app.styles.set(style)}>
                    {label}
                </button>
            ))}
            <button
                type="button"
                class="chip"
                title="Axial, coronal and sagittal planes in cells of their own beside the selected ones, linked by a crosshair (p)"
                data-planes="beside"
                onClick={() => void app.planes.beside()}
            >
                Planes beside
            </button>
        </div>
    );
}
