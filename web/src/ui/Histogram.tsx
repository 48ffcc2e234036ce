// The distribution of a cell's values, over the range of its transfer function.
import { useEffect, useState } from "preact/hooks";
import { getHistogram } from "../api/datasets";
import type { CellState, ColourBarInfo, Histogram } from "../api/types";
import { formatNumber, withUnit } from "../model/format";
import { positionOf, type Scale } from "../model/transfer";
import { gradient } from "./ColourBar";

/** Of the drawing's own coordinates. */
export const histogramWidth = 260;
export const histogramHeight = 110;

export function useHistogram(cell: CellState): Histogram | null {
    const [histogram, setHistogram] = useState<Histogram | null>(null);
    const field = cell.style["field"]?.value;
    const step = cell.style["time"]?.value;
    const wanted = cell.state === "ok" ? cell.dataset : null;
    useEffect(() => {
        setHistogram(null);
        if (!wanted) return;
        let current = true;
        getHistogram(wanted, typeof field === "string" || typeof field === "number" ? field : null, typeof step === "number" ? step : null).then(
            (answer) => current && setHistogram(answer),
            // Without a histogram the curve can still be edited.
            () => undefined,
        );
        return () => {
            current = false;
        };
    }, [wanted, field, step]);
    return histogram;
}

/** The histogram over the range of the transfer function, counts on a logarithmic scale. */
export function histogramPath(histogram: Histogram, bar: ColourBarInfo): string {
    const largest = Math.log1p(Math.max(1, ...histogram.counts));
    const binWidth = (histogram.high - histogram.low) / Math.max(1, histogram.counts.length);
    const parts: string[] = [];
    histogram.counts.forEach((count, i) => {
        const at = (value: number): number => histogramWidth * Math.min(1, Math.max(0, positionOf(value, bar, bar.scale as Scale)));
        const left = at(histogram.low + i * binWidth);
        const right = at(histogram.low + (i + 1) * binWidth);
        if (right <= left || count === 0) return;
        const top = histogramHeight * (1 - Math.log1p(count) / largest);
        parts.push(`M${left.toFixed(1)} ${histogramHeight}V${top.toFixed(1)}H${right.toFixed(1)}V${histogramHeight}`);
    });
    return parts.join("");
}

/** The colours of the range, and its ends in numbers. */
export function RangeStrip({ bar, note }: { bar: ColourBarInfo; note: string }) {
    return (
        <>
            <div class="map-strip" style={{ background: gradient(bar.stops, "to right") }} />
            <div class="range-labels">
                <span>{formatNumber(bar.low)}</span>
                <span>{note}</span>
                <span>{withUnit(formatNumber(bar.high), bar.unit)}</span>
            </div>
        </>
    );
}
