// The opacity curve as numbers: exact, and usable without a pointer.
import { Plus, X } from "lucide-preact";
import { useState } from "preact/hooks";
import type { ColourBarInfo } from "../api/types";
import { plainNumber } from "../model/format";
import { addedPoint, movedPoint, positionOf, removedPoint, valueAt, type OpacityPoint, type Scale } from "../model/transfer";
import { IconButton } from "./IconButton";

export interface TransferTableProps {
    points: readonly OpacityPoint[];
    bar: ColourBarInfo;
    write: (points: OpacityPoint[]) => void;
}

function NumberCell({ label, value, set }: { label: string; value: string; set: (value: number) => void }) {
    return (
        <input
            class="number-field"
            inputMode="decimal"
            aria-label={label}
            value={value}
            onChange={(event) => {
                const number = Number(event.currentTarget.value);
                if (event.currentTarget.value.trim() !== "" && Number.isFinite(number)) set(number);
                else event.currentTarget.value = value;
            }}
        />
    );
}

export function TransferTable({ points, bar, write }: TransferTableProps) {
    const [open, setOpen] = useState(false);
    const scale = bar.scale as Scale;
    const add = (): void => {
        const last = points[points.length - 1] ?? [1, 0];
        const before = points[points.length - 2] ?? [0, 0];
        write(addedPoint(points, (last[0] + before[0]) / 2, (last[1] + before[1]) / 2).points);
    };
    return (
        <div class="transfer-table">
            <button type="button" class="text-button" aria-expanded={open} onClick={() => setOpen(!open)}>
                {open ? "hide numbers" : "numbers"}
            </button>
            {open && (
                <table>
                    <thead>
                        <tr>
                            <th scope="col">value</th>
                            <th scope="col">opacity</th>
                            <th>
                                <IconButton icon={Plus} class="small" label="Add a point" onClick={add} />
                            </th>
                        </tr>
                    </thead>
                    <tbody>
                        {points.map(([position, opacity], i) => (
                            <tr key={i}>
                                <td>
                                    <NumberCell
                                        label={`Value of point ${i + 1}`}
                                        value={plainNumber(Number(valueAt(position, bar, scale).toPrecision(6)))}
                                        set={(value) => write(movedPoint(points, i, positionOf(value, bar, scale), opacity))}
                                    />
                                </td>
                                <td>
                                    <NumberCell
                                        label={`Opacity of point ${i + 1}`}
                                        value={plainNumber(opacity)}
                                        set={(value) => write(movedPoint(points, i, position, value))}
                                    />
                                </td>
                                <td>
                                    <IconButton
                                        icon={X}
                                        class="small"
                                        label={`Remove point ${i + 1}`}
                                        disabled={points.length <= 2}
                                        onClick={() => write(removedPoint(points, i))}
                                    />
                                </td>
                            </tr>
                        ))}
                    </tbody>
                </table>
            )}
        </div>
    );
}
