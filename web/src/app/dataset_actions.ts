// Bringing data in and taking it out.
import { cancelImport, importFiles, removeDataset, uploadFile, type ImportOptions } from "../api/datasets";
import { ApiProblem } from "../api/http";
import type { OpenRequest } from "../model/file_choice";
import type { AppStore } from "../state/app_state";
import type { Notices } from "./notices";
import type { ServerSync } from "./server_sync";

/** Files that are drawn onto the page but are workbooks go another way. */
export function isWorkbookFile(file: File): boolean {
    return file.name.toLowerCase().endsWith(".json");
}

export class DatasetActions {
    private nextUpload = 1;

    constructor(
        private readonly store: AppStore,
        private readonly sync: ServerSync,
        private readonly notices: Notices,
    ) {}

    /** True when all of them were taken. */
    async open(requests: readonly OpenRequest[]): Promise<boolean> {
        let all = true;
        for (const { files, series, name } of requests) {
            const options: ImportOptions = {};
            if (series) options.series = series;
            if (name) options.name = this.freeName(name);
            all = (await this.notices.attempt(() => importFiles(files, options))) !== null && all;
        }
        await Promise.all([this.sync.datasets.request(), this.sync.book.request()]);
        return all;
    }

    /** One after the other: several at once would only share the same link. */
    async upload(files: readonly File[]): Promise<void> {
        for (const file of files) await this.uploadOne(file);
    }

    private async uploadOne(file: File): Promise<void> {
        const id = this.nextUpload++;
        const show = (progress: number, error: string | null): void =>
            this.store.dispatch({ type: "book/upload", upload: { id, name: file.name, progress, error } });
        show(0, null);
        try {
            await uploadFile(this.freeName(file.name), file, (part) => show(part, null));
            this.store.dispatch({ type: "book/uploadDone", id });
        } catch (problem) {
            if (!(problem instanceof ApiProblem)) throw problem;
            show(1, problem.message);
        }
        await Promise.all([this.sync.datasets.request(), this.sync.book.request()]);
    }

    /** The file's name, or "name (2)" when a dataset has it already. */
    private freeName(name: string): string {
        const taken = new Set(this.store.get().book.datasets.map((dataset) => dataset.name));
        let free = name;
        for (let count = 2; taken.has(free); ++count) free = `${name} (${count})`;
        return free;
    }

    dismissUpload(id: number): void {
        this.store.dispatch({ type: "book/uploadDone", id });
    }

    async remove(name: string): Promise<void> {
        await this.notices.attempt(() => removeDataset(name));
        await Promise.all([this.sync.datasets.request(), this.sync.book.request()]);
    }

    async cancel(name: string): Promise<void> {
        await this.notices.attempt(() => cancelImport(name));
        await this.sync.datasets.request();
    }
}
