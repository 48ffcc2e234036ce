// T_N with its intervals, R and the level over N, one above the other. Arrow keys walk through the points.
import { useState } from "preact/hooks";
import type { TimingPoint } from "../../api/levels";
import { axisSteps, inOrder, lines, pointText } from "../../model/levels";

const width = 560;
const left = 68;
const right = 12;
const ratioLimit = 1.5;
const largestRatio = 3;

interface Band {
    top: number;
    height: number;
    high: number;
    title: string;
    steps: number[];
}

function bandsOf(points: readonly TimingPoint[]): { time: Band; ratio: Band; level: Band } {
    const slowest = Math.max(...points.map((point) => point.ms_high));
    const coarsest = Math.max(1, ...points.map((point) => point.level));
    return {
        time: { top: 8, height: 96, high: slowest * 1.05, title: "T_N ms", steps: axisSteps(slowest * 1.05, 4) },
        ratio: { top: 116, height: 40, high: largestRatio, title: "R", steps: [0, ratioLimit, largestRatio] },
        level: { top: 168, height: 24, high: coarsest, title: "level", steps: [0, coarsest] },
    };
}

function yOf(band: Band, value: number): number {
    return band.top + band.height * (1 - Math.min(1, Math.max(0, value / band.high)));
}

function Axis({ band, limit }: { band: Band; limit?: number }) {
    return (
        <g class="plot-axis">
            {band.steps.map((step) => (
                <g key={step}>
                    <line x1={left} x2={width - right} y1={yOf(band, step)} y2={yOf(band, step)} class={step === limit ? "plot-limit" : ""} />
                    <text x={left - 4} y={yOf(band, step) + 3} text-anchor="end">
                        {step}
                    </text>
                </g>
            ))}
            <text x={2} y={band.top + 3} class="plot-title">
                {band.title}
            </text>
        </g>
    );
}

export function TimeNPlot({ points }: { points: readonly TimingPoint[] }) {
    const [at, setAt] = useState<number | null>(null);
    const ordered = inOrder(points);
    if (ordered.length === 0) {
        return <p class="hint">No times yet: they come from redraws of the whole sheet, so turn a picture, or press “Measure now”.</p>;
    }
    const bands = bandsOf(ordered);
    const largest = Math.max(2, ordered.at(-1)!.n);
    const x = (n: number): number => left + ((width - left - right) * (n - 0.5)) / largest;
    const chosen = at === null ? null : ordered[Math.min(at, ordered.length - 1)]!;
    const last = ordered.at(-1)!;
    const onKeyDown = (event: KeyboardEvent): void => {
        const now = at ?? ordered.length;
        const next: Record<string, number> = { ArrowLeft: now - 1, ArrowRight: now + 1, Home: 0, End: ordered.length - 1 };
        const target = next[event.key];
        if (target === undefined) return;
        event.preventDefault();
        event.stopPropagation();
        setAt(Math.min(ordered.length - 1, Math.max(0, target)));
    };
    return (
        <div class="time-plot">
            <svg
                viewBox={`0 0 ${width} 216`}
                role="img"
                tabindex={0}
                data-points={ordered.length}
                aria-label={`Time, R and level over N, ${ordered.length} points; the last: ${pointText(last)}. Arrow keys walk through them.`}
                onKeyDown={onKeyDown}
                onPointerLeave={() => setAt(null)}
            >
                <Axis band={bands.time} />
                <Axis band={bands.ratio} limit={ratioLimit} />
                <Axis band={bands.level} />
                {axisSteps(largest, 10)
                    .filter((n) => n >= 1 && Number.isInteger(n))
                    .map((n) => (
                        <text key={n} x={x(n)} y={210} text-anchor="middle" class="plot-n">
                            {n}
                        </text>
                    ))}
                {lines(ordered).map((line) => (
                    <polyline
                        key={line[0]!.level}
                        class={`plot-line plot-level-${Math.min(3, line[0]!.level)}`}
                        points={line.map((point) => `${x(point.n)},${yOf(bands.time, point.ms)}`).join(" ")}
                    />
                ))}
                {ordered.map((point, i) => (
                    <g
                        key={`${point.n} ${point.level}`}
                        class={`plot-point plot-level-${Math.min(3, point.level)} ${point === chosen ? "chosen" : ""}`}
                        onPointerEnter={() => setAt(i)}
                    >
                        <line x1={x(point.n)} x2={x(point.n)} y1={yOf(bands.time, point.ms_low)} y2={yOf(bands.time, point.ms_high)} />
                        <circle cx={x(point.n)} cy={yOf(bands.time, point.ms)} r={point === chosen ? 4 : 2.5} />
                        {point.r_raw !== null && <circle class="plot-raw" cx={x(point.n)} cy={yOf(bands.ratio, point.r_raw)} r={2} />}
                        {point.r !== null && <circle cx={x(point.n)} cy={yOf(bands.ratio, point.r)} r={2.5} />}
                        <rect x={x(point.n) - 3} y={yOf(bands.level, point.level) - 2} width={6} height={4} />
                        <rect class="plot-target" x={x(point.n) - 6} y={0} width={12} height={196} />
                    </g>
                ))}
            </svg>
            <output class="plot-text" aria-live="polite">
                {pointText(chosen ?? last)}
            </output>
        </div>
    );
}
