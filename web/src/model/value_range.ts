// Ranges of values as numbers that people can read and type.
import type { ValueRange } from "./transfer";

/** Of the range's width: no colour changes visibly. */
const digits = 6;

/** Ends with few digits that leave no value of the range out; a single value gets a range about it. */
export function roundedOutwards({ low, high }: ValueRange): ValueRange {
    const width = high - low;
    if (!(width > 0)) {
        const half = Math.abs(low) / 2 || 0.5;
        return { low: low - half, high: low + half };
    }
    const unit = Math.pow(10, Math.floor(Math.log10(width)) - digits + 1);
    const tidy = (value: number): number => Number(value.toPrecision(15));
    return { low: tidy(Math.floor(low / unit + 1e-9) * unit), high: tidy(Math.ceil(high / unit - 1e-9) * unit) };
}

/** The range as scans have it: how many values it spans, and the one in its middle. */
export interface WindowLevel {
    window: number;
    level: number;
}

export function windowLevelOf({ low, high }: ValueRange): WindowLevel {
    return { window: high - low, level: (low + high) / 2 };
}

export function rangeOfWindowLevel({ window, level }: WindowLevel): ValueRange {
    return { low: level - window / 2, high: level + window / 2 };
}
