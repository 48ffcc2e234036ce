// Numbers and sizes as people read them.

const thinSpace = "\u2009";

/** About four significant digits, without needless zeros: "0.0213", "1.2e-7", "312". */
export function formatNumber(value: number | null | undefined, digits = 4): string {
    if (value === null || value === undefined || Number.isNaN(value)) return "–";
    if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
    if (value === 0) return "0";
    const size = Math.abs(value);
    const text = size >= 1e6 || size < 1e-3 ? value.toExponential(digits - 1) : value.toPrecision(digits);
    const [mantissa, exponent] = text.split("e");
    const trimmed = mantissa!.includes(".") ? mantissa!.replace(/\.?0+$/, "") : mantissa!;
    return (exponent === undefined ? trimmed : `${trimmed}e${Number(exponent)}`).replaceAll("-", "−");
}

/** The text that goes back to the server: plain ASCII. */
export function plainNumber(value: number): string {
    return String(Number(value.toPrecision(10)));
}

export function formatBytes(bytes: number | null | undefined): string {
    if (bytes === null || bytes === undefined || !Number.isFinite(bytes)) return "–";
    if (bytes < 1000) return `${bytes}${thinSpace}B`;
    const units = ["kB", "MB", "GB", "TB"];
    let value = bytes;
    let unit = "B";
    for (const next of units) {
        if (value < 999.5) break;
        value /= 1000;
        unit = next;
    }
    return `${value < 10 ? value.toFixed(1) : Math.round(value)}${thinSpace}${unit}`;
}

export function formatMs(ms: number | null | undefined): string {
    if (ms === null || ms === undefined || !Number.isFinite(ms)) return "–";
    return `${ms < 10 ? ms.toFixed(1) : Math.round(ms)}${thinSpace}ms`;
}

export function formatDims(dims: readonly number[] | null | undefined): string {
    return dims?.length ? dims.join(" × ") : "–";
}

export function formatPercent(part: number | null | undefined): string {
    return part === null || part === undefined ? "" : `${Math.round(100 * part)}${thinSpace}%`;
}

const raised: Record<string, string> = { "-": "⁻", "0": "⁰", "1": "¹", "2": "²", "3": "³", "4": "⁴", "6": "⁶" };

/** "e/Å^3" as people write it: "e/Å³". */
export function formatUnit(unit: string | null | undefined): string {
    return (unit ?? "").replace(/\^(-?[0-9])/g, (text, power: string) => {
        const signs = [...power].map((sign) => raised[sign]);
        return signs.every((sign) => sign !== undefined) ? signs.join("") : text;
    });
}

export function withUnit(text: string, unit: string | null | undefined): string {
    return unit ? `${text}${thinSpace}${formatUnit(unit)}` : text;
}

/** "run2" before "run10". */
export const naturalOrder = new Intl.Collator(undefined, { numeric: true, sensitivity: "base" }).compare;

interface Probed {
    value: number | null;
    label?: string | null;
    unit?: string;
    note?: string;
}

function probedText({ value, label, unit, note }: Probed): string {
    if (label && value !== null) return label === String(value) ? label : `${label} (${formatNumber(value)})`;
    return value === null ? note || "no value" : withUnit(formatNumber(value), unit);
}

/** A cell's own value, then those of the volumes that are blended into its picture. */
export function probeText(found: Probed & { atom?: string | null; layers?: (Probed & { name: string })[] }): string {
    return [...(found.atom ? [found.atom] : []), probedText(found), ...(found.layers ?? []).map((layer) => `${layer.name}: ${probedText(layer)}`)].join(" · ");
}
