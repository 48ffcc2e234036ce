// The panel of levels and timings, the policy, and pinned levels.
import { getTimings, measureTimings, setResolution, type LevelPatch } from "../api/levels";
import type { AppStore } from "../state/app_state";
import { currentSheet } from "../state/book";
import type { Notices } from "./notices";
import { Refresher } from "./refresher";
import type { StyleActions } from "./style_actions";

export class LevelActions {
    private readonly timings = new Refresher(() => this.load());

    constructor(
        private readonly store: AppStore,
        private readonly styles: StyleActions,
        private readonly notices: Notices,
    ) {}

    toggle(): void {
        const open = !this.store.get().levels.open;
        this.store.dispatch({ type: "levels/open", open });
        if (open) void this.timings.request();
    }

    show(): void {
        if (!this.store.get().levels.open) this.toggle();
    }

    /** The pictures are at rest: times and levels may be new ones. */
    rested(): void {
        if (this.store.get().levels.open) void this.timings.request();
    }

    async choose(patch: LevelPatch): Promise<void> {
        const sheet = this.sheet();
        if (sheet === undefined) return;
        await this.notices.attempt(() => setResolution(sheet, patch));
        await this.timings.request();
    }

    async measure(): Promise<void> {
        const sheet = this.sheet();
        if (sheet === undefined || this.store.get().levels.measuring) return;
        this.store.dispatch({ type: "levels/measuring", measuring: true });
        const timings = await this.notices.attempt(() => measureTimings(sheet));
        this.store.dispatch({ type: "levels/measuring", measuring: false });
        if (!timings) return;
        this.store.dispatch({ type: "levels/timings", timings });
        if (timings.measured?.warning) this.notices.info(`${timings.measured.warning}.`);
    }

    /** null: by policy again. */
    async pin(cell: string, level: number | null): Promise<void> {
        await this.styles.set({ level: level ?? null }, [{ layer: "cell", cell }]);
    }

    hover(cell: string | null): void {
        this.store.dispatch({ type: "levels/hovered", cell });
    }

    private sheet(): string | undefined {
        return currentSheet(this.store.get().book)?.name;
    }

    private async load(): Promise<void> {
        const sheet = this.sheet();
        if (sheet === undefined) return;
        try {
            this.store.dispatch({ type: "levels/timings", timings: await getTimings(sheet) });
        } catch (problem) {
            // The next rest asks again; a lost connection is told by the status bar.
            console.warn("timings not loaded", problem);
        }
    }
}
