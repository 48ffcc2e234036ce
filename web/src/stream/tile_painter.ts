// Paints tiles into their canvases, in the order in which they came; decoding runs in parallel.
import type { TileInfo } from "../state/tiles";
import type { StreamMessage } from "./frame_decoder";
import { PaintStatistics } from "./paint_statistics";

export interface PaintEvents {
    /** After the last tile of a frame is on its canvas. */
    framePainted(frame: number, tiles: Record<string, Partial<TileInfo>>): void;
}

function numberOf(value: unknown, fallback = 0): number {
    return typeof value === "number" ? value : fallback;
}

const mimeTypes: Record<string, string> = { jpeg: "image/jpeg", jpg: "image/jpeg", png: "image/png", webp: "image/webp" };

/** A tile's part of an encoded picture, or all of it. */
interface Place {
    x: number;
    y: number;
    width: number;
    height: number;
}

/** A cell's picture as it came; many cells may share one. */
interface Picture {
    encoded: Blob;
    place: Place | null;
}

/** The picture keeps its own size; CSS stretches it over the tile while the resolution is reduced. */
function draw(canvas: HTMLCanvasElement, bitmap: ImageBitmap, place: Place | null): void {
    const { x, y, width, height } = place ?? { x: 0, y: 0, width: bitmap.width, height: bitmap.height };
    const context = canvas.getContext("2d");
    // Setting a size clears.
    if (canvas.width !== width || canvas.height !== height) {
        canvas.width = width;
        canvas.height = height;
    } else if (!place) {
        context?.clearRect(0, 0, width, height);
    }
    context?.drawImage(bitmap, x, y, width, height, 0, 0, width, height);
}

export class TilePainter {
    readonly statistics = new PaintStatistics();
    private readonly canvases = new Map<string, HTMLCanvasElement>();
    private order: Promise<void> = Promise.resolve();
    private opening = 0;
    private pending: Record<string, Partial<TileInfo>> = {};
    /** The last picture of each cell: the server does not send again what it knows to be on show. */
    private readonly newest = new Map<string, Picture>();

    constructor(private readonly events: PaintEvents) {}

    register(cell: string, canvas: HTMLCanvasElement): void {
        this.canvases.set(cell, canvas);
        const picture = this.newest.get(cell);
        if (!picture) return;
        this.inOrder(this.opening, async () => {
            if (this.canvases.get(cell) !== canvas || this.newest.get(cell) !== picture) return;
            const bitmap = await createImageBitmap(picture.encoded);
            draw(canvas, bitmap, picture.place);
            bitmap.close();
        });
    }

    unregister(cell: string, canvas: HTMLCanvasElement): void {
        if (this.canvases.get(cell) === canvas) this.canvases.delete(cell);
    }

    /** What is still being decoded for an older stream is dropped. */
    streamOpened(): void {
        ++this.opening;
        this.pending = {};
        this.newest.clear();
        this.statistics.streamOpened();
    }

    /** One picture of one cell. */
    tile(message: StreamMessage): void {
        this.pictures(message, [{ header: message.header, place: null }]);
    }

    /** Pictures of many cells in one: decoded once. JPEG, so that nothing needs to be cleared under them. */
    atlas(message: StreamMessage): void {
        const { header } = message;
        const tiles = Array.isArray(header["tiles"]) ? (header["tiles"] as Record<string, unknown>[]) : [];
        this.pictures(
            message,
            tiles.map((tile) => ({
                header: { ...header, ...tile },
                place: { x: numberOf(tile["x"]), y: numberOf(tile["y"]), width: numberOf(tile["width"]), height: numberOf(tile["height"]) },
            })),
        );
    }

    private pictures({ header, payload }: StreamMessage, tiles: { header: Record<string, unknown>; place: Place | null }[]): void {
        const opening = this.opening;
        const type = mimeTypes[String(header["format"])] ?? "image/png";
        // Copied: the decoder's buffer goes on with the next messages.
        const encoded = new Blob([payload.slice()], { type });
        const decoded = createImageBitmap(encoded);
        this.inOrder(opening, async () => {
            let bitmap: ImageBitmap | null = null;
            try {
                bitmap = await decoded;
            } catch {
                // A picture that cannot be decoded leaves the old one; the frame still counts as seen, or the stream would stall.
            }
            if (opening !== this.opening) return bitmap?.close();
            if (bitmap) {
                for (const tile of tiles) {
                    this.newest.set(String(tile.header["cell"]), { encoded, place: tile.place });
                    this.paint(tile.header, bitmap, tile.place, encoded.size / tiles.length);
                }
                bitmap.close();
            }
            this.endOfFrame(header);
        });
    }

    cell({ header }: StreamMessage): void {
        const state = String(header["state"]) as TileInfo["state"];
        this.inOrder(this.opening, () => {
            this.pending[String(header["cell"])] = {
                state,
                code: String(header["code"] ?? ""),
                message: String(header["message"] ?? ""),
                progress: numberOf(header["progress"], 1),
                final: state !== "importing",
            };
            this.endOfFrame(header);
        });
    }

    /** Once everything that has come so far is on its canvas. */
    whenPainted(step: () => void): void {
        this.inOrder(this.opening, step);
    }

    private inOrder(opening: number, step: () => void | Promise<void>): void {
        this.order = this.order.then(() => (opening === this.opening ? step() : undefined));
    }

    private paint(header: Record<string, unknown>, bitmap: ImageBitmap, place: Place | null, bytes: number): void {
        const cell = String(header["cell"]);
        const canvas = this.canvases.get(cell);
        if (canvas) draw(canvas, bitmap, place);
        const info: Partial<TileInfo> = {
            painted: true,
            state: "ok",
            code: "",
            message: "",
            progress: 1,
            level: numberOf(header["level"]),
            scale: numberOf(header["scale"], 1),
            final: header["final"] === true,
        };
        // What holds for the picture at rest stays through the coarse ones of a gesture.
        if (info.final) info.note = String(header["note"] ?? "");
        this.pending[cell] = info;
        this.statistics.add({
            seq: numberOf(header["seq"]),
            frame: numberOf(header["frame"]),
            cell,
            at: performance.now(),
            level: info.level ?? 0,
            scale: info.scale ?? 1,
            final: info.final ?? false,
            format: String(header["format"]),
            bytes,
        });
    }

    private endOfFrame(header: StreamMessage["header"]): void {
        if (header["frameEnd"] !== true) return;
        const tiles = this.pending;
        this.pending = {};
        this.events.framePainted(numberOf(header["frame"]), tiles);
    }
}
