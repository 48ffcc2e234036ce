// Rescaling: the values that the colours span, from what a cell holds or shows.
import { getValueRange, type RangeOver } from "../api/sheets";
import type { StylePatch } from "../api/types";
import { roundedOutwards } from "../model/value_range";
import type { ValueRange } from "../model/transfer";
import type { AppStore } from "../state/app_state";
import { currentSheet } from "../state/book";
import type { ViewSender } from "../stream/view_sender";
import type { Notices } from "./notices";
import type { StyleActions } from "./style_actions";
import type { TileSizes } from "./tile_sizes";

/** Of the chosen layer: every cell by its own values, or all that share by all of theirs. */
export type RangeRule = "own" | "shared" | "symmetric" | "shared symmetric";

function fixedRange(range: ValueRange): StylePatch {
    return { "range.mode": "fixed", "range.min": range.low, "range.max": range.high };
}

export class RangeActions {
    constructor(
        private readonly store: AppStore,
        private readonly styles: StyleActions,
        private readonly sizes: TileSizes,
        private readonly sender: ViewSender,
        private readonly notices: Notices,
    ) {}

    async follow(rule: RangeRule): Promise<void> {
        const both = rule === "shared symmetric";
        await this.styles.set({ "range.mode": both ? "shared" : rule, "range.symmetric": both ? "on" : null, "range.min": null, "range.max": null });
    }

    async setTo(range: ValueRange): Promise<void> {
        if (!(range.low < range.high)) {
            this.notices.error(`A range from ${range.low} to ${range.high}: its lower end is not below its upper end; change the other end first.`);
            return;
        }
        await this.styles.set(fixedRange(range));
    }

    /** To the ends of what one cell holds or shows now. */
    async fitTo(cell: string, over: RangeOver): Promise<void> {
        const sheet = currentSheet(this.store.get().book);
        if (!sheet) return;
        const { width, height } = this.sizes.visibleTiles(cell).find((tile) => tile.cell === cell) ?? { width: 512, height: 512 };
        const answer = await this.notices.attempt(() =>
            getValueRange(sheet.name, cell, { over, width, height, stream: this.sender.streamId() }),
        );
        if (!answer) return;
        if (answer.min === null || answer.max === null) {
            this.notices.info(`${cell} shows no values here: the range stays as it is.`);
            return;
        }
        await this.styles.set(fixedRange(roundedOutwards({ low: answer.min, high: answer.max })));
    }
}
