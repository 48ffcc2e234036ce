// The opacity curve over the histogram: points are dragged, added and removed with mouse, touch and keyboard.
import { useMemo, useRef, useState } from "preact/hooks";
import type { CellState, ColourBarInfo } from "../api/types";
import { followPointer } from "../input/pointer_drag";
import { formatNumber } from "../model/format";
import {
    addedPoint,
    movedPoint,
    opacityPointsOf,
    removedPoint,
    simplifiedCurve,
    valueAt,
    type OpacityPoint,
    type Scale,
} from "../model/transfer";
import { useApp, useSelect } from "./app_context";
import { histogramHeight as height, histogramPath, histogramWidth as width, RangeStrip, useHistogram } from "./Histogram";
import { TransferTable } from "./TransferTable";

const key = "transfer.opacity";

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
        const edit = app.beginEdit(app.styles.targets());
        const show = (): void => {
            setDrag(latest);
            edit.show({ [key]: latest.map((point) => [...point]) });
        };
        if (changed) show();
        followPointer(event, svg.current!, {
            move: (next) => {
                changed = true;
                latest = movedPoint(latest, index, ...place(next));
                show();
            },
            end: (cancelled) => {
                setDrag(null);
                if (cancelled || !changed) edit.cancel();
                else void edit.end();
            },
        });
    };
    const onBackground = (event: PointerEvent): void => {
        if (event.button !== 0) return;
        const added = addedPoint(shown, ...place(event));
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
        if (by) {
            const moved = movedPoint(shown, index, position + by[0], opacity + by[1]).map((point) => [...point]);
            app.keyEdits.show(`${cell.cell} ${key} ${index}`, app.styles.targets(), { [key]: moved });
        }
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
                        onBlur={() => void app.keyEdits.finish()}
                    />
                ))}
            </div>
            <RangeStrip bar={bar} note={automatic ? "curve chosen from the data" : ""} />
            <TransferTable points={shown} bar={bar} write={write} />
        </div>
    );
}
