// The opacity curve over the histogram: points are dragged, added and removed with mouse, touch and keyboard.
import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import { getHistogram } from "../api/datasets";
import type { CellState, ColourBarInfo, Histogram } from "../api/types";
import { formatNumber, withUnit } from "../model/format";
import {
    addedPoint,
    movedPoint,
    opacityPointsOf,
    positionOf,
    removedPoint,
    simplifiedCurve,
    valueAt,
    type OpacityPoint,
    type Scale,
} from "../model/transfer";
import { useApp, useSelect } from "./app_context";
import { gradient } from "./ColourBar";
import { TransferTable } from "./TransferTable";

const width = 260;
const height = 110;
const key = "transfer.opacity";

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
        const at = (value: number): number => width * Math.min(1, Math.max(0, positionOf(value, bar, bar.scale as Scale)));
        const left = at(histogram.low + i * binWidth);
        const right = at(histogram.low + (i + 1) * binWidth);
        if (right <= left || count === 0) return;
        const top = height - (height * Math.log1p(count)) / largest;
        parts.push(`M${left.toFixed(1)} ${height}V${top.toFixed(1)}H${right.toFixed(1)}V${height}`);
    });
    return parts.join("");
}

function curvePath(points: readonly OpacityPoint[]): string {
    if (points.length === 0) return "";
    const at = ([position, opacity]: OpacityPoint): string => `${(width * position).toFixed(1)} ${(height * (1 - opacity)).toFixed(1)}`;
    const first = points[0]!;
    const last = points[points.length - 1]!;
    return `M${at([0, first[1]])}L${points.map(at).join("L")}L${at([1, last[1]])}`;
}

/** Points of the workbook or of the edit under way; a curve that the server chose is sampled from the colour bar. */
function useCurve(cell: CellState, bar: ColourBarInfo | undefined): { points: OpacityPoint[]; automatic: boolean } {
    const live = useSelect((state) => state.page.live[cell.cell]?.[key]);
    const value = live ?? cell.style[key]?.value;
    return useMemo(() => {
        const own = opacityPointsOf(value);
        if (own) return { points: own, automatic: false };
        const chosen = opacityPointsOf(bar?.opacity);
        if (chosen) return { points: chosen, automatic: true };
        const samples = (bar?.stops ?? []).map(([position, , , , opacity]): OpacityPoint => [position, opacity]);
        return { points: simplifiedCurve(samples), automatic: true };
    }, [value, bar]);
}

export function TransferEditor({ cell }: { cell: CellState }) {
    const app = useApp();
    const bar = useSelect((state) => state.book.bars[cell.cell]);
    const histogram = useHistogram(cell);
    const { points, automatic } = useCurve(cell, bar);
    const [selected, setSelected] = useState<number | null>(null);
    const [drag, setDrag] = useState<OpacityPoint[] | null>(null);
    const svg = useRef<SVGSVGElement>(null);
    const path = useMemo(() => (histogram && bar ? histogramPath(histogram, bar) : ""), [histogram, bar]);
    if (!bar) return null;
    const shown = drag ?? points;

    const place = (event: PointerEvent | MouseEvent): [number, number] => {
        const box = svg.current!.getBoundingClientRect();
        return [(event.clientX - box.left) / box.width, 1 - (event.clientY - box.top) / box.height];
    };
    const write = (next: OpacityPoint[]): void => {
        setDrag(null);
        void app.styles.set({ [key]: next.map((point) => [...point]) });
    };
    const startDrag = (event: PointerEvent, list: OpacityPoint[], index: number): void => {
        event.preventDefault();
        setSelected(index);
        let latest = list;
        let changed = list !== points;
        const target = svg.current!;
        target.setPointerCapture(event.pointerId);
        app.view.gestureBegan();
        const move = (next: PointerEvent): void => {
            changed = true;
            latest = movedPoint(latest, index, ...place(next));
            setDrag(latest);
            app.styles.preview({ [key]: latest.map((point) => [...point]) });
        };
        const end = (): void => {
            target.removeEventListener("pointermove", move);
            target.removeEventListener("pointerup", end);
            target.removeEventListener("pointercancel", end);
            app.view.gestureEnded();
            if (changed) write(latest);
            else setDrag(null);
        };
        target.addEventListener("pointermove", move);
        target.addEventListener("pointerup", end);
        target.addEventListener("pointercancel", end);
    };
    const onBackground = (event: PointerEvent): void => {
        if (event.button !== 0) return;
        const added = addedPoint(shown, ...place(event));
        setDrag(added.points);
        startDrag(event, added.points, added.index);
    };
    const onPointKey = (event: KeyboardEvent, index: number): void => {
        const step = event.shiftKey ? 0.1 : 0.01;
        const [position, opacity] = shown[index]!;
        const moves: Record<string, [number, number]> = {
            ArrowLeft: [-step, 0],
            ArrowRight: [step, 0],
            ArrowUp: [0, step],
            ArrowDown: [0, -step],
        };
        const by = moves[event.key];
        if (by) write(movedPoint(shown, index, position + by[0], opacity + by[1]));
        else if (event.key === "Delete" || event.key === "Backspace") write(removedPoint(shown, index));
        else if (event.key === "Insert" || event.key === "+") {
            const next = shown[index + 1] ?? [1, opacity];
            write(addedPoint(shown, (position + next[0]) / 2, (opacity + next[1]) / 2).points);
        } else return;
        event.preventDefault();
        event.stopPropagation();
    };

    return (
        <div class="transfer-editor">
            <svg
                ref={svg}
                viewBox={`0 0 ${width} ${height}`}
                preserveAspectRatio="none"
                role="group"
                aria-label="Opacity over the value; press to add a point, Delete removes one"
                onPointerDown={onBackground}
                onContextMenu={(event) => event.preventDefault()}
            >
                <path class="histogram" d={path} />
                <path class="curve" d={curvePath(shown)} />
            </svg>
            <div class="points">
                {shown.map(([position, opacity], i) => (
                    <button
                        type="button"
                        key={i}
                        class={`point ${i === selected ? "selected" : ""}`}
                        role="slider"
                        aria-label={`Point ${i + 1} of ${shown.length}`}
                        aria-valuemin={0}
                        aria-valuemax={1}
                        aria-valuenow={opacity}
                        aria-valuetext={`opacity ${opacity.toFixed(2)} at ${formatNumber(valueAt(position, bar, bar.scale as Scale))}`}
                        style={{ left: `${100 * position}%`, top: `${100 * (1 - opacity)}%` }}
                        onPointerDown={(event) => (event.button === 2 ? write(removedPoint(shown, i)) : startDrag(event, shown, i))}
                        onContextMenu={(event) => event.preventDefault()}
                        onFocus={() => setSelected(i)}
                        onKeyDown={(event) => onPointKey(event, i)}
                    />
                ))}
            </div>
            <div class="map-strip" style={{ background: gradient(bar.stops, "to right") }} />
            <div class="range-labels">
                <span>{formatNumber(bar.low)}</span>
                <span>{automatic ? "curve chosen from the data" : ""}</span>
                <span>{withUnit(formatNumber(bar.high), bar.unit)}</span>
            </div>
            <TransferTable points={shown} bar={bar} write={write} />
        </div>
    );
}
