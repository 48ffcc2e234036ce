// Isovalues as handles on a histogram: one for each value, and with the mirror one for its negative too.
import type { StyleValue } from "./camera";
import { rowsOf } from "./number_rows";
import { positionOf, roundedValue, valueAt, type Scale, type ValueRange } from "./transfer";

export const mostIsovalues = 8;

/** null: the server chooses them. */
export function isovaluesOf(value: StyleValue | undefined): number[] | null {
    return rowsOf(value, 1)?.map((row) => row[0]!) ?? null;
}

/** Of the values drawn, those that the mirror makes from an earlier one are no values of their own. */
export function withoutMirrored(drawn: readonly number[]): number[] {
    return drawn.filter((value, i) => !drawn.slice(0, i).includes(-value));
}

export interface IsovalueHandle {
    /** Which of the values it moves. */
    index: number;
    /** It stands at the negative of that value. */
    mirrored: boolean;
    /** The value that it stands at. */
    value: number;
    /** 0 to 1 along the range; held at its ends. */
    position: number;
    /** The value lies beyond the range that is shown. */
    outside: boolean;
}

export function isovalueHandles(values: readonly number[], mirror: boolean, range: ValueRange, scale: Scale): IsovalueHandle[] {
    const handle = (index: number, value: number, mirrored: boolean): IsovalueHandle => ({
        index,
        mirrored,
        value,
        position: Math.min(1, Math.max(0, positionOf(value, range, scale))),
        outside: value < range.low || value > range.high,
    });
    return values.flatMap((value, index) => [
        handle(index, value, false),
        ...(mirror && value !== 0 ? [handle(index, -value, true)] : []),
    ]);
}

/** The values after a handle was moved to a position along the range. */
export function withHandleAt(
    values: readonly number[],
    handle: Pick<IsovalueHandle, "index" | "mirrored">,
    position: number,
    range: ValueRange,
    scale: Scale,
): number[] {
    const value = roundedValue(valueAt(Math.min(1, Math.max(0, position)), range, scale), range);
    return values.map((old, i) => (i === handle.index ? (handle.mirrored ? -value + 0 : value) : old));
}
