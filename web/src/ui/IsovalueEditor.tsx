// Isovalues as lines on the histogram: dragged, moved by keys, added by a double-click and removed by Delete.
import { useMemo, useRef } from "preact/hooks";
import type { CellState, StylePatch } from "../api/types";
import { followPointer } from "../input/pointer_drag";
import { formatNumber, withUnit } from "../model/format";
import { isovalueHandles, isovaluesOf, mostIsovalues, withHandleAt, withoutMirrored, type IsovalueHandle } from "../model/isovalues";
import { roundedValue, valueAt, type Scale } from "../model/transfer";
import { useApp, useSelect } from "./app_context";
import { histogramHeight, histogramPath, histogramWidth, RangeStrip, useHistogram } from "./Histogram";

const key = "isovalue";

export function IsovalueEditor({ cell }: { cell: CellState }) {
    const app = useApp();
    const bar = useSelect((state) => state.book.bars[cell.cell]);
    const live = useSelect((state) => state.page.live[cell.cell]?.[key]);
    const histogram = useHistogram(cell);
    const path = useMemo(() => (histogram && bar ? histogramPath(histogram, bar) : ""), [histogram, bar]);
    const lines = useRef<HTMLDivElement>(null);
    if (!bar) return null;
    const scale = bar.scale as Scale;
    const own = isovaluesOf(live ?? cell.style[key]?.value);
    const mirror = cell.style["isosurface.mirror"]?.value === "on";
    const drawn = (bar.isovalues ?? []).map(({ value }) => value);
    const values = own ?? (mirror ? withoutMirrored(drawn) : drawn);
    const handles = isovalueHandles(values, mirror, bar, scale);

    const positionAt = (event: MouseEvent): number => {
        const box = lines.current!.getBoundingClientRect();
        return (event.clientX - box.left) / box.width;
    };
    const patch = (next: readonly number[]): StylePatch => ({ [key]: next.length ? [...next] : "auto" });
    const write = (next: readonly number[]): void => {
        void app.keyEdits.finish().then(() => app.styles.set(patch(next)));
    };
    const startDrag = (event: PointerEvent, handle: IsovalueHandle): void => {
        if (event.button !== 0) return;
        event.preventDefault();
        (event.currentTarget as HTMLElement).focus({ preventScroll: true });
        const aside = handle.position - positionAt(event);
        const edit = app.beginEdit(app.styles.targets());
        followPointer(event, lines.current!, {
            move: (next) => edit.show(patch(withHandleAt(values, handle, positionAt(next) + aside, bar, scale))),
            end: (cancelled) => (cancelled ? edit.cancel() : void edit.end()),
        });
    };
    const add = (position: number): void => {
        if (values.length < mostIsovalues) write([...values, roundedValue(valueAt(position, bar, scale), bar)]);
    };
    const onKey = (event: KeyboardEvent, handle: IsovalueHandle): void => {
        const step = event.shiftKey ? 0.1 : 0.01;
        const by = { ArrowLeft: -step, ArrowDown: -step, ArrowRight: step, ArrowUp: step }[event.key];
        if (by !== undefined) {
            const moved = withHandleAt(values, handle, handle.position + by, bar, scale);
            app.keyEdits.show(`${cell.cell} ${key} ${handle.index}`, app.styles.targets(), patch(moved));
        } else if (event.key === "Delete" || event.key === "Backspace") write(values.filter((_, i) => i !== handle.index));
        else if (event.key === "Insert" || event.key === "+") add(Math.min(1, handle.position + 0.1));
        else return;
        event.preventDefault();
        event.stopPropagation();
    };

    return (
        <div class="transfer-editor isovalue-editor">
            <svg
                viewBox={`0 0 ${histogramWidth} ${histogramHeight}`}
                preserveAspectRatio="none"
                role="group"
                aria-label="Isovalues on the histogram; a double-click adds one, Delete removes one"
                onDblClick={(event) => add(positionAt(event))}
            >
                <title>Double-click adds an isovalue</title>
                <path class="histogram" d={path} />
            </svg>
            <div class="points" ref={lines}>
                {handles.map((handle) => (
                    <button
                        type="button"
                        key={`${handle.index} ${handle.mirrored}`}
                        class={`isovalue-line ${handle.mirrored ? "mirrored" : ""} ${handle.outside ? "outside" : ""}`}
                        role="slider"
                        data-isovalue={`${handle.index}${handle.mirrored ? " mirrored" : ""}`}
                        aria-label={`Isovalue ${handle.index + 1}${handle.mirrored ? ", mirrored" : ""}`}
                        aria-valuemin={bar.low}
                        aria-valuemax={bar.high}
                        aria-valuenow={handle.value}
                        aria-valuetext={withUnit(formatNumber(handle.value), bar.unit)}
                        title={withUnit(formatNumber(handle.value), bar.unit)}
                        style={{ left: `${100 * handle.position}%` }}
                        onPointerDown={(event) => startDrag(event, handle)}
                        onKeyDown={(event) => onKey(event, handle)}
                        onBlur={() => void app.keyEdits.finish()}
                    />
                ))}
            </div>
            <RangeStrip bar={bar} note={own ? "" : "isovalue chosen from the data"} />
        </div>
    );
}
