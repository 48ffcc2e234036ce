// Which colour means which value: in each tile, or once in the column's header where the range is shared.
import type { ColourBarInfo, LayerBar, LegendLabel } from "../api/types";
import { formatNumber, formatUnit, withUnit } from "../model/format";
import { isovalueHandles, isovaluesOf } from "../model/isovalues";
import type { Scale } from "../model/transfer";
import { cellOf, currentSheet } from "../state/book";
import { useSelect } from "./app_context";

export function gradient(stops: readonly (readonly number[])[], towards: string): string {
    const colours = stops.map(([position, red, green, blue]) => {
        const byte = (value: number | undefined): number => Math.round(255 * (value ?? 0));
        return `rgb(${byte(red)} ${byte(green)} ${byte(blue)}) ${(100 * (position ?? 0)).toFixed(1)}%`;
    });
    return `linear-gradient(${towards}, ${colours.join(", ")})`;
}

/** Quantity, unit, and a scale that is not linear. */
export function barCaption(bar: Pick<ColourBarInfo, "quantity" | "unit" | "scale">): string {
    const named = [bar.quantity, formatUnit(bar.unit)].filter(Boolean).join(" / ");
    return [named, bar.scale && bar.scale !== "linear" ? bar.scale : ""].filter(Boolean).join(", ");
}

function cssColour([red, green, blue]: readonly [number, number, number, number]): string {
    const byte = (value: number): number => Math.round(255 * value);
    return `rgb(${byte(red)} ${byte(green)} ${byte(blue)})`;
}

export function describeRange(bar: Pick<ColourBarInfo, "low" | "high" | "unit" | "scale">): string {
    const scale = bar.scale && bar.scale !== "linear" ? `, ${bar.scale}` : "";
    return withUnit(`${formatNumber(bar.low)} to ${formatNumber(bar.high)}`, bar.unit) + scale;
}

/** Where isosurfaces stand on the bar; while one is dragged, where it is now. */
function IsovalueMarks({ cell, bar }: { cell: string; bar: ColourBarInfo }) {
    const live = useSelect((state) => state.page.live[cell]?.["isovalue"]);
    const mirror = useSelect((state) => cellOf(currentSheet(state.book), cell)?.style["isosurface.mirror"]?.value === "on");
    const drawn = bar.isovalues ?? [];
    const dragged = isovaluesOf(live);
    const positions =
        dragged && drawn.length
            ? isovalueHandles(dragged, mirror, bar, bar.scale as Scale).map(({ position, outside }) => (outside ? null : position))
            : drawn.map(({ position }) => position);
    return (
        <>
            {positions.map((position, i) => position !== null && <i key={i} class="isovalue-mark" style={{ bottom: `${100 * position}%` }} />)}
        </>
    );
}

export function ColourBar({ cell }: { cell: string }) {
    const own = useSelect((state) => state.book.bars[cell]);
    const bar = own?.colouredBy ?? own;
    const shown = useSelect((state) => {
        const annotations = cellOf(currentSheet(state.book), cell)?.style["annotations"]?.value;
        return annotations === undefined || annotations === "all";
    });
    const enlarged = useSelect((state) => state.page.enlarged === cell);
    const flat = useSelect((state) => cellOf(currentSheet(state.book), cell)?.style["technique"]?.value === "plane");
    if (!own || !bar || !shown) return null;
    const layers = <LayerBars layers={own.layers ?? []} word={flat ? "overlay" : "fused with"} />;
    if (own.labels) {
        return (
            <>
                {layers}
                <Legend labels={own.labels} title={`Labels of ${cell}`} />
            </>
        );
    }
    if (bar.shared && !enlarged) return layers;
    return (
        <>
            {layers}
            <div class="colour-bar" role="img" aria-label={`Colour bar of ${cell}: ${describeRange(bar)}`}>
                <span class="bar-unit">{barCaption(bar)}</span>
                {bar.above && <i class="bar-end" title="above the range" style={{ background: cssColour(bar.above) }} />}
                <div class="bar-scale" style={{ background: gradient(bar.stops, "to top") }}>
                    {bar.ticks.map((tick) => (
                        <span key={tick.label} style={{ bottom: `${100 * tick.pos}%` }}>
                            {tick.label}
                        </span>
                    ))}
                    {bar === own && <IsovalueMarks cell={cell} bar={own} />}
                </div>
                {bar.below && <i class="bar-end" title="below the range" style={{ background: cssColour(bar.below) }} />}
                {bar.nan && bar.nan[3] > 0 && (
                    <span class="bar-nan">
                        no value
                        <i class="bar-end" style={{ background: cssColour(bar.nan) }} />
                    </span>
                )}
            </div>
        </>
    );
}

/** What the colours of a label map mean. */
function Legend({ labels, title }: { labels: readonly LegendLabel[]; title: string }) {
    return (
        <ul class="label-legend" aria-label={title}>
            {labels
                .filter(({ hidden }) => !hidden)
                .map(({ value, name, colour }) => (
                    <li key={value} title={`${name}: ${value}`}>
                        {name}
                        <i style={{ background: cssColour([...colour, 1]) }} />
                    </li>
                ))}
        </ul>
    );
}

/** What is blended into the picture or painted over it, and which colours it has. */
function LayerBars({ layers, word }: { layers: readonly LayerBar[]; word: string }) {
    if (layers.length === 0) return null;
    return (
        <div class="layer-bars">
            <span>{word}</span>
            {layers.map((layer, index) =>
                layer.labels ? (
                    <span key={index}>
                        {layer.name}
                        <Legend labels={layer.labels} title={`Labels of layer ${layer.name}`} />
                    </span>
                ) : (
                <span key={index} role="img" aria-label={`Colour bar of layer ${layer.name}: ${describeRange(layer)}`} title={describeRange(layer)}>
                    {layer.name}
                    <i style={{ background: gradient(layer.stops, "to right") }} />
                </span>
                ),
            )}
        </div>
    );
}

/** For a column's header; only when every drawn cell of the column shares one range. */
export function SharedColourBar({ cells }: { cells: string[] }) {
    const bar = useSelect((state) => {
        const bars = cells.map((cell) => state.book.bars[cell]).filter((found): found is ColourBarInfo => found !== undefined);
        const first = bars[0];
        if (!first || !bars.every((other) => other.shared && other.low === first.low && other.high === first.high)) return null;
        return first;
    });
    if (!bar) return null;
    return (
        <span class="shared-bar" role="img" aria-label={`Shared colour bar: ${describeRange(bar)}`} title={describeRange(bar)}>
            {barCaption(bar) && <small>{barCaption(bar)}</small>}
            <small>{formatNumber(bar.low)}</small>
            <i style={{ background: gradient(bar.stops, "to right") }} />
            <small>{withUnit(formatNumber(bar.high), bar.unit)}</small>
        </span>
    );
}
