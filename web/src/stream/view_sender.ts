// Sends the newest view and the newest acknowledgement. Input never waits for pictures: a changed view leaves with the next
// animation frame, and at most a few requests are under way, so that a slow link coalesces views instead of queueing them.

export interface ViewTile {
    cell: string;
    width: number;
    height: number;
}

export interface ViewBody {
    moving: boolean;
    tiles: ViewTile[];
    focus: string | null;
    style: Record<string, unknown>;
    cells: Record<string, Record<string, unknown>>;
}

export interface SenderEvents {
    answered(ms: number): void;
    /** The server no longer knows the stream, or cannot be reached. */
    failed(): void;
    /** The server does not accept the view; says why. */
    rejected(detail: string): void;
}

const mostUnderWay = 3;

export class ViewSender {
    private stream: string | null = null;
    private viewId = 0;
    private lastView = "";
    private viewChanged = false;
    private ack: number | null = null;
    private underWay = 0;
    private frameRequested = false;

    constructor(
        private readonly currentView: () => ViewBody,
        private readonly events: SenderEvents,
    ) {}

    open(stream: string): void {
        this.stream = stream;
        this.lastView = "";
        this.ack = null;
        this.viewChanged = true;
        this.flush();
    }

    close(): void {
        this.stream = null;
    }

    streamId(): string | null {
        return this.stream;
    }

    /** The view that the server took last; null while something is on its way. */
    viewTaken(): number | null {
        return this.underWay > 0 || this.frameRequested || this.viewChanged || this.ack !== null ? null : this.viewId;
    }

    /** Something that the view is made of may have changed. */
    touch(): void {
        this.viewChanged = true;
        if (this.frameRequested) return;
        this.frameRequested = true;
        requestAnimationFrame(() => {
            this.frameRequested = false;
            this.flush();
        });
    }

    acknowledge(frame: number): void {
        this.ack = Math.max(frame, this.ack ?? 0);
        this.flush();
    }

    private takeBody(): Record<string, unknown> | null {
        const body: Record<string, unknown> = {};
        if (this.viewChanged) {
            this.viewChanged = false;
            const view = this.currentView();
            const text = JSON.stringify(view);
            if (text !== this.lastView) {
                this.lastView = text;
                body["view"] = { id: ++this.viewId, ...view };
            }
        }
        if (this.ack !== null) {
            body["ack"] = this.ack;
            this.ack = null;
        }
        return Object.keys(body).length ? body : null;
    }

    private flush(): void {
        if (this.stream === null || this.underWay >= mostUnderWay) return;
        const body = this.takeBody();
        if (body) void this.post(this.stream, body);
    }

    private async post(stream: string, body: Record<string, unknown>): Promise<void> {
        ++this.underWay;
        const started = performance.now();
        try {
            const response = await fetch(`api/v1/streams/${encodeURIComponent(stream)}`, {
                method: "POST",
                body: JSON.stringify(body),
                headers: { "Content-Type": "application/json" },
                credentials: "same-origin",
            });
            if (stream !== this.stream) return;
            if (response.ok) this.events.answered(performance.now() - started);
            else if (response.status === 404) this.events.failed();
            else this.events.rejected(await detailOf(response));
        } catch {
            if (stream === this.stream) this.events.failed();
        } finally {
            --this.underWay;
            this.flush();
        }
    }
}

async function detailOf(response: Response): Promise<string> {
    try {
        return ((await response.json()) as { detail?: string }).detail ?? response.statusText;
    } catch {
        return response.statusText;
    }
}
