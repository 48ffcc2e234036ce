// Wires store, stream and actions together.
import { ApiProblem } from "../api/http";
import { streamUrl } from "../api/sheets";
import type { LayerTarget } from "../api/types";
import { formatAddress } from "../model/address";
import { lookFromText, viewOverrides } from "../model/look";
import { newAppStore, type AppStore } from "../state/app_state";
import { cellOf, currentSheet } from "../state/book";
import type { StreamRest, StreamStatus } from "../state/connection";
import { isMoving } from "../state/page";
import type { TileInfo } from "../state/tiles";
import type { StreamMessage } from "../stream/frame_decoder";
import { StreamClient } from "../stream/stream_client";
import { TilePainter } from "../stream/tile_painter";
import { ViewSender, type ViewBody } from "../stream/view_sender";
import { CellActions } from "./cell_actions";
import { ClipActions } from "./clip_actions";
import { DatasetActions } from "./dataset_actions";
import { GridActions } from "./grid_actions";
import { LevelActions } from "./level_actions";
import { Notices } from "./notices";
import { Pace } from "./pace";
import { PlaneActions } from "./plane_actions";
import { RangeActions } from "./range_actions";
import { ServerSync } from "./server_sync";
import { StyleActions } from "./style_actions";
import { KeyEdits, StyleEdit } from "./style_edit";
import { TileSizes } from "./tile_sizes";
import { ViewActions } from "./view_actions";

export class App {
    readonly store: AppStore = newAppStore();
    readonly notices = new Notices(this.store);
    readonly sync = new ServerSync(this.store, () => this.sizes.visibleTiles("").map((tile) => tile.cell));
    readonly styles = new StyleActions(this.store, this.sync, this.notices);
    readonly cells = new CellActions(this.store, this.sync, this.notices);
    readonly datasets = new DatasetActions(this.store, this.sync, this.notices);
    readonly view = new ViewActions(this.store, this.sync, this.notices);
    readonly clips = new ClipActions(this.store, this.styles, this.view, this.notices);
    readonly levels = new LevelActions(this.store, this.styles, this.notices);
    readonly keyEdits = new KeyEdits(this.styles, this.view);
    readonly grid = new GridActions(this.store, () => document.querySelector<HTMLElement>(".grid-scroll"));
    readonly planes = new PlaneActions(this.store, this.styles, this.view, this.keyEdits, this.sync, this.notices);

    readonly painter = new TilePainter({
        framePainted: (frame, tiles) => {
            this.sender.acknowledge(frame);
            this.store.dispatch({ type: "tiles/update", tiles });
            this.catchUp(tiles);
        },
    });

    private readonly latency = new Pace<number>((ms) => this.store.dispatch({ type: "connection/latency", ms }));
    private readonly status = new Pace<StreamStatus>((status) => this.store.dispatch({ type: "connection/status", status }));

    readonly sender: ViewSender = new ViewSender(() => this.viewBody(), {
        answered: (ms) => this.latency.offer(ms),
        failed: () => this.client.reconnectNow(),
        rejected: (detail) => this.notices.error(detail),
    });

    /** The sheet that the stream was opened for. */
    private streamed = "";

    readonly sizes = new TileSizes(() => {
        this.sender.touch();
        this.sync.tilesShown();
    });

    readonly ranges = new RangeActions(this.store, this.styles, this.sizes, this.sender, this.notices);

    readonly client: StreamClient = new StreamClient({
        url: () => {
            const { clientWidth, clientHeight } = document.documentElement;
            this.streamed = this.sheetName();
            return streamUrl(this.streamed, clientWidth, clientHeight, window.devicePixelRatio || 1);
        },
        ready: () => true,
        connecting: () => this.setPhase("connecting"),
        message: (message) => this.received(message),
        lost: () => {
            this.setPhase("lost");
            // The sheet may be gone with the workbook that it was in: the next try must know.
            void this.sync.book.request();
        },
        refused: (detail) => this.store.dispatch({ type: "connection/phase", phase: "refused", message: detail }),
        paused: () => {
            this.sender.close();
            this.store.dispatch({ type: "connection/phase", phase: "paused" });
        },
    });

    constructor() {
        this.readAddress();
        this.followView();
    }

    /** Sends the view when what it is made of changes: every touch costs an animation frame. */
    private followView(): void {
        let before = this.store.get();
        this.store.subscribe(() => {
            const now = this.store.get();
            const changed = now.page !== before.page || now.book !== before.book || now.levels !== before.levels;
            before = now;
            if (changed) this.sender.touch();
        });
    }

    /** Loads what the page needs and opens the stream; goes on trying while the server does not answer. */
    async start(): Promise<void> {
        for (;;) {
            try {
                await Promise.all([this.sync.loadAbout(), this.sync.loadBook(), this.sync.datasets.request()]);
                break;
            } catch (problem) {
                if (!(problem instanceof ApiProblem)) throw problem;
                const refused = problem.status === 401 || problem.status === 403;
                const phase = refused ? "refused" : "lost";
                this.store.dispatch({ type: "connection/phase", phase, message: problem.message });
                await new Promise((resolve) => setTimeout(resolve, 1000));
            }
        }
        this.client.start();
    }

    /** A drag that changes style values; keys that were pressed before it are written first. */
    beginEdit(targets: LayerTarget[]): StyleEdit {
        void this.keyEdits.finish();
        return new StyleEdit(this.styles, this.view, targets);
    }

    async undo(): Promise<void> {
        await this.keyEdits.finish();
        await this.cells.undo();
    }

    async redo(): Promise<void> {
        await this.keyEdits.finish();
        await this.cells.redo();
    }

    showSheet(name: string): void {
        this.store.dispatch({ type: "book/sheet", name });
        this.store.dispatch({ type: "tiles/forget" });
        this.store.dispatch({ type: "page/enlarge", cell: null });
        void this.sync.book.request();
        this.client.reconnectNow();
    }

    /** Another workbook was opened: its sheets have other names. */
    private followSheet(): void {
        if (this.streamed !== this.sheetName()) this.client.reconnectNow();
    }

    private sheetName(): string {
        return currentSheet(this.store.get().book)?.name ?? "";
    }

    /** A connection that was lost or refused stays so until it works again: "connecting" would only flicker. */
    private setPhase(phase: "connecting" | "lost"): void {
        if (phase === "lost") this.sender.close();
        const now = this.store.get().connection.phase;
        if (now === "refused" || (phase === "connecting" && now === "lost")) return;
        this.store.dispatch({ type: "connection/phase", phase });
    }

    private received(message: StreamMessage): void {
        const { header } = message;
        switch (header.type) {
            case "hello":
                this.opened(String(header["stream"]), Number(header["version"]));
                break;
            case "workbook":
                void this.sync.book.request().then(() => this.followSheet());
                break;
            case "datasets":
                void this.sync.datasets.request();
                break;
            case "tile":
                this.painter.tile(message);
                break;
            case "tiles":
                this.painter.atlas(message);
                break;
            case "cell":
                this.painter.cell(message);
                break;
            case "status":
                this.status.offer(header as unknown as StreamStatus);
                break;
            case "rest":
                this.status.flush();
                this.levels.rested();
                this.painter.whenPainted(() =>
                    this.store.dispatch({ type: "connection/rest", rest: header as unknown as StreamRest }),
                );
                break;
            default:
                // "ping", and messages of later versions.
                break;
        }
    }

    private opened(stream: string, version: number): void {
        const again = this.store.get().connection.openings > 0;
        this.painter.streamOpened();
        this.sender.open(stream);
        this.store.dispatch({ type: "connection/phase", phase: "live" });
        if (!again) {
            // Edited after the page has asked for the workbook: nothing else will tell.
            if (version !== this.store.get().book.book?.version) void this.sync.book.request();
            return;
        }
        // The server may have been restarted, with other data or another version.
        void this.notices.attempt(() => this.sync.loadAbout());
        void this.sync.book.request();
        void this.sync.datasets.request();
    }

    /** An import or a formula has come further than the workbook's last answer says: ask again. */
    private catchUp(tiles: Record<string, Partial<TileInfo>>): void {
        const sheet = currentSheet(this.store.get().book);
        const behind = Object.entries(tiles).some(([name, { state }]) => {
            const known = cellOf(sheet, name)?.state;
            return known !== undefined && state !== undefined && known !== state;
        });
        if (behind) void this.sync.book.request();
    }

    private viewBody(): ViewBody {
        const { page, book, levels } = this.store.get();
        const sheet = currentSheet(book);
        const { style, cells } = viewOverrides(page.look, sheet, page.live);
        return {
            moving: isMoving(page),
            tiles: this.sizes.visibleTiles(formatAddress(page.selection.active)),
            // What is looked at keeps its full resolution longest.
            focus: page.enlarged ?? levels.hovered ?? formatAddress(page.selection.active),
            style,
            cells,
        };
    }

    /** Links carry sheet and view in the fragment, which never reaches a server. */
    private readAddress(): void {
        const parts = new URLSearchParams(window.location.hash.slice(1));
        const sheet = parts.get("sheet");
        if (sheet) this.store.dispatch({ type: "book/sheet", name: sheet });
        // URLSearchParams has decoded once already.
        const view = parts.get("view");
        const look = view === null ? null : lookFromText(encodeURIComponent(view));
        if (look) this.store.dispatch({ type: "page/look", look });
    }
}
