// Keeps the store equal to the server: what it is, the workbook, the datasets, the colour bars.
import { listDatasets } from "../api/datasets";
import { getColourMaps, getInfo, getPresets, getStyleKeys } from "../api/info";
import { getColourBar } from "../api/sheets";
import { getState } from "../api/workbook";
import type { ColourBarInfo, Dataset } from "../api/types";
import type { AppStore } from "../state/app_state";
import { formatAddress } from "../model/address";
import { currentSheet } from "../state/book";
import { Refresher } from "./refresher";

/** Colour bars are small, but a large sheet has many: few at a time leave room for input. */
const barsAtOnce = 2;

function statesOf(datasets: readonly Dataset[]): string {
    return datasets.map((dataset) => `${dataset.name}\t${dataset.state}`).join("\n");
}

export class ServerSync {
    readonly book = new Refresher(() => this.quietly(() => this.loadBook()));
    readonly datasets = new Refresher(() => this.quietly(() => this.loadDatasets()));
    private readonly bars = new Refresher(() => this.quietly(() => this.loadBars()));
    /** The bars that are there belong to an older workbook. */
    private barsStale = true;

    /** shownCells: the tiles on show; only theirs are asked for, so that a sheet of hundreds of cells costs no more. */
    constructor(
        private readonly store: AppStore,
        private readonly shownCells: () => string[],
    ) {}

    /** Throws ApiProblem. */
    async loadAbout(): Promise<void> {
        const [info, keys, maps, presets] = await Promise.all([getInfo(), getStyleKeys(), getColourMaps(), getPresets()]);
        this.store.dispatch({ type: "connection/about", info, keys, maps, presets });
    }

    /** Throws ApiProblem. */
    async loadBook(): Promise<void> {
        const book = await getState();
        this.store.dispatch({ type: "book/loaded", book });
        this.barsStale = true;
        void this.bars.request();
    }

    private async loadDatasets(): Promise<void> {
        const before = statesOf(this.store.get().book.datasets);
        const datasets = await listDatasets();
        this.store.dispatch({ type: "book/datasets", datasets });
        // A dataset that became ready or failed changes what its cells say.
        if (statesOf(datasets) !== before && this.store.get().book.book) void this.book.request();
    }

    /** Others came into view. */
    tilesShown(): void {
        if (this.missingBars().length > 0) void this.bars.request();
    }

    private missingBars(): string[] {
        const { book, page } = this.store.get();
        const sheet = currentSheet(book);
        const wanted = new Set([...this.shownCells(), formatAddress(page.selection.active)]);
        const ready = sheet?.cells.filter((cell) => cell.state === "ok" && wanted.has(cell.cell)) ?? [];
        return ready.map((cell) => cell.cell).filter((cell) => this.barsStale || !book.bars[cell]);
    }

    private async loadBars(): Promise<void> {
        const sheet = currentSheet(this.store.get().book);
        if (!sheet) return;
        const waiting = this.missingBars();
        const bars: Record<string, ColourBarInfo> = this.barsStale ? {} : { ...this.store.get().book.bars };
        this.barsStale = false;
        const worker = async (): Promise<void> => {
            for (let cell = waiting.shift(); cell !== undefined; cell = waiting.shift()) {
                const bar = await getColourBar(sheet.name, cell).catch(() => null);
                if (bar) bars[cell] = bar;
            }
        };
        await Promise.all(Array.from({ length: barsAtOnce }, worker));
        if (currentSheet(this.store.get().book)?.name === sheet.name) this.store.dispatch({ type: "book/bars", bars });
    }

    /** A refresh that fails is repeated by the next change or by the reconnection, which tells the user. */
    private async quietly(work: () => Promise<void>): Promise<void> {
        try {
            await work();
        } catch (problem) {
            console.warn("refresh failed", problem);
        }
    }
}
