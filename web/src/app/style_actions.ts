// Edits of style keys: at the layer that the inspector has chosen, with a preview while dragging.
import { clearOverrides, patchStyle } from "../api/sheets";
import type { HiddenEdit, LayerTarget, Origin, StylePatch, StyleValue } from "../api/types";
import { cellsShowing, scopesOf, targetOfOrigin, targetsOf, type Scope } from "../model/scope";
import type { AppStore } from "../state/app_state";
import { cellOf, currentSheet } from "../state/book";
import type { Notices } from "./notices";
import type { ServerSync } from "./server_sync";

export function newGestureId(): string {
    return `${Date.now().toString(36)}-${Math.random().toString(36).slice(2, 10)}`;
}

export class StyleActions {
    constructor(
        private readonly store: AppStore,
        private readonly sync: ServerSync,
        private readonly notices: Notices,
    ) {}

    /** The chosen layer, or the farthest one when the selection does not allow it. */
    scope(): Scope {
        const { selection, scope } = this.store.get().page;
        const scopes = scopesOf(selection);
        return scopes.includes(scope) ? scope : scopes[0]!;
    }

    targets(scope: Scope = this.scope()): LayerTarget[] {
        const { page, book } = this.store.get();
        const sheet = currentSheet(book);
        return sheet ? targetsOf(scope, page.selection, sheet) : [];
    }

    /** Where a value that shows in a cell is set, so that every cell that follows it goes along; `alone`: that cell only. */
    homeOf(cell: string, key: string, alone: boolean): LayerTarget[] {
        if (alone) return [{ layer: "cell", cell }];
        const origin = cellOf(currentSheet(this.store.get().book), cell)?.style[key]?.origin ?? "default";
        return [targetOfOrigin(origin, cell) ?? { layer: "sheet" }];
    }

    /** A value as the cell shows it now: with the edit under way, if there is one. */
    shownValue(cell: string, key: string): StyleValue | undefined {
        const { page, book } = this.store.get();
        return page.live[cell]?.[key] ?? cellOf(currentSheet(book), cell)?.style[key]?.value;
    }

    /** Shows values in the pictures at once, without changing the workbook. */
    preview(patch: StylePatch, targets: LayerTarget[] = this.targets()): void {
        const { page, book } = this.store.get();
        const sheet = currentSheet(book);
        if (!sheet) return;
        const live = { ...page.live };
        for (const target of targets) {
            for (const [key, value] of Object.entries(patch)) {
                if (value === null) continue;
                for (const cell of cellsShowing(sheet, target, key)) {
                    live[cell.cell] = { ...live[cell.cell], [key]: value };
                }
            }
        }
        this.store.dispatch({ type: "page/live", live });
    }

    cancelPreview(): void {
        this.store.dispatch({ type: "page/live", live: {} });
    }

    /** Writes into the workbook; several targets are one undo step. null resets to inherited. */
    async set(patch: StylePatch, targets: LayerTarget[] = this.targets()): Promise<void> {
        const sheet = currentSheet(this.store.get().book);
        if (!sheet || targets.length === 0) return;
        const gesture = targets.length > 1 ? newGestureId() : undefined;
        const hidden: HiddenEdit[] = [];
        const shown = this.store.get().page.live;
        await this.notices.attempt(async () => {
            for (const target of targets) {
                hidden.push(...((await patchStyle(sheet.name, target, patch, gesture)).hidden ?? []));
            }
        });
        this.store.dispatch({ type: "page/hidden", hidden });
        await this.sync.book.request();
        // Another edit may have begun meanwhile: its preview stays.
        if (this.store.get().page.live === shown) this.cancelPreview();
    }

    async setAtScope(scope: Scope, patch: StylePatch): Promise<void> {
        await this.set(patch, this.targets(scope));
    }

    /** Removes a value where it is set, so that the next layer shows again. */
    async reset(key: string, origin: Origin, cell: string): Promise<void> {
        const target = targetOfOrigin(origin, cell);
        if (target) await this.set({ [key]: null }, [target]);
    }

    /** Removes the nearer values that hide the last edit. */
    async clearHiding(): Promise<void> {
        const { hidden } = this.store.get().page;
        const sheet = currentSheet(this.store.get().book);
        if (!sheet || hidden.length === 0) return;
        const unique = (names: string[]): string[] => [...new Set(names)];
        await this.notices.attempt(() =>
            clearOverrides(sheet.name, unique(hidden.map((edit) => edit.key)), unique(hidden.map((edit) => edit.cell))),
        );
        this.store.dispatch({ type: "page/hidden", hidden: [] });
        await this.sync.book.request();
    }
}
