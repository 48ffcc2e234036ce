// Edits of cells and of the workbook: sources, clipboard, layout, undo.
import { ApiProblem } from "../api/http";
import { patchCell, patchSheet } from "../api/sheets";
import { putWorkbook, redo, saveWorkbook, undo } from "../api/workbook";
import { formatAddress, parseAddress, shiftFormula } from "../model/address";
import { selectedCells } from "../model/selection";
import type { AppStore } from "../state/app_state";
import { cellOf, currentSheet, sourceText } from "../state/book";
import type { Notices } from "./notices";
import type { ServerSync } from "./server_sync";
import { newGestureId } from "./style_actions";

interface ClipboardCell {
    column: number;
    row: number;
    source: string;
}

export class CellActions {
    /** What was last copied on this page, with the text that went to the clipboard: proof that it is still what is there. */
    private copied: { text: string; cells: ClipboardCell[] } | null = null;

    constructor(
        private readonly store: AppStore,
        private readonly sync: ServerSync,
        private readonly notices: Notices,
    ) {}

    /** Returns the server's objection, or null. */
    async setSource(cell: string, source: string | null): Promise<string | null> {
        const sheet = currentSheet(this.store.get().book);
        if (!sheet) return null;
        try {
            await patchCell(sheet.name, cell, { source: source?.trim() || null });
        } catch (problem) {
            if (problem instanceof ApiProblem) return problem.message;
            throw problem;
        }
        await this.sync.book.request();
        return null;
    }

    async setTitle(cell: string, title: string): Promise<void> {
        const sheet = currentSheet(this.store.get().book);
        if (!sheet) return;
        await this.notices.attempt(() => patchCell(sheet.name, cell, { title }));
        await this.sync.book.request();
    }

    async setColumns(columns: number): Promise<void> {
        const sheet = currentSheet(this.store.get().book);
        if (!sheet || columns < 1) return;
        await this.notices.attempt(() => patchSheet(sheet.name, { columns }));
        await this.sync.book.request();
    }

    /** Rows are lines, cells are separated by tabs, as spreadsheets exchange them. */
    copy(): string {
        const { book, page } = this.store.get();
        const sheet = currentSheet(book);
        if (!sheet) return "";
        const cells = selectedCells(page.selection, sheet).map((name) => ({
            ...parseAddress(name)!,
            source: sourceText(cellOf(sheet, name)),
        }));
        const rows = new Map<number, string[]>();
        for (const cell of cells) rows.set(cell.row, [...(rows.get(cell.row) ?? []), cell.source]);
        const text = [...rows.values()].map((line) => line.join("\t")).join("\n");
        this.copied = { text, cells };
        return text;
    }

    async paste(text: string): Promise<void> {
        const { book, page } = this.store.get();
        const sheet = currentSheet(book);
        if (!sheet) return;
        const to = page.selection.active;
        const cells =
            this.copied?.text === text
                ? this.copied.cells
                : text
                      .replace(/\r?\n$/, "")
                      .split(/\r?\n/)
                      .flatMap((line, row) => line.split("\t").map((source, column) => ({ column, row, source })));
        const left = Math.min(...cells.map((cell) => cell.column));
        const top = Math.min(...cells.map((cell) => cell.row));
        const moved = this.copied?.text === text;
        const gesture = newGestureId();
        await this.notices.attempt(async () => {
            for (const cell of cells) {
                const target = { column: to.column + cell.column - left, row: to.row + cell.row - top };
                const shift = moved && cell.source.startsWith("=");
                const source = shift
                    ? shiftFormula(cell.source, target.column - cell.column, target.row - cell.row)
                    : cell.source.trim();
                await patchCell(sheet.name, formatAddress(target), { source: source || null }, gesture);
            }
        });
        await this.sync.book.request();
    }

    async clearSelected(): Promise<void> {
        const { book, page } = this.store.get();
        const sheet = currentSheet(book);
        if (!sheet) return;
        const gesture = newGestureId();
        const used = selectedCells(page.selection, sheet).filter((name) => sourceText(cellOf(sheet, name)) !== "");
        await this.notices.attempt(async () => {
            for (const cell of used) await patchCell(sheet.name, cell, { source: null }, gesture);
        });
        await this.sync.book.request();
    }

    async undo(): Promise<void> {
        await this.notices.attempt(undo);
        await this.sync.book.request();
    }

    async redo(): Promise<void> {
        await this.notices.attempt(redo);
        await this.sync.book.request();
    }

    /** To the workbook's own file; one without a file is asked where to go. */
    async save(): Promise<void> {
        try {
            await saveWorkbook();
            this.notices.info("Workbook saved.");
        } catch (problem) {
            if (!(problem instanceof ApiProblem)) throw problem;
            if (problem.status === 0 || problem.status >= 500) this.notices.error(problem.message);
            else this.store.dispatch({ type: "page/leftPanel", panel: "save", reason: problem.message });
        }
    }

    async saveAs(path: string): Promise<boolean> {
        const done = await this.notices.attempt(async () => {
            await saveWorkbook(path);
            return true;
        });
        if (done) this.notices.info(`Workbook saved as ${path}.`);
        return done === true;
    }

    async loadWorkbook(file: File): Promise<void> {
        let document: unknown;
        try {
            document = JSON.parse(await file.text());
        } catch {
            this.notices.error(`${file.name} is not a workbook: it holds no valid JSON.`);
            return;
        }
        await this.notices.attempt(() => putWorkbook(document));
        await this.sync.book.request();
    }
}
