// Holds the page's one stream open: connects, reads, reconnects when it breaks, and closes it while the page is hidden.
import { problemOf } from "../api/http";
import { FrameDecoder, type StreamMessage } from "./frame_decoder";

export interface StreamEvents {
    url(): string;
    /** null: no sheet to stream yet. */
    ready(): boolean;
    connecting(): void;
    message(message: StreamMessage): void;
    lost(): void;
    refused(detail: string): void;
    paused(): void;
}

/** The server says something every 5 s at least. */
const silenceMs = 12_000;
const firstRetryMs = 250;
const longestRetryMs = 3_000;

export class StreamClient {
    private attempt: AbortController | null = null;
    private timer: ReturnType<typeof setTimeout> | undefined;
    private watchdog: ReturnType<typeof setTimeout> | undefined;
    private retryMs = firstRetryMs;
    private stream: string | null = null;
    private stopped = true;

    constructor(private readonly events: StreamEvents) {
        document.addEventListener("visibilitychange", () => this.visibilityChanged());
        window.addEventListener("online", () => this.reconnectNow());
        // A page that goes away must not leave its stream to a timeout.
        window.addEventListener("pagehide", () => this.close());
    }

    start(): void {
        this.stopped = false;
        this.retryMs = firstRetryMs;
        this.reconnectNow();
    }

    /** Closes what is open and opens anew: another sheet, or a stream that the server has forgotten. */
    reconnectNow(): void {
        if (this.stopped || document.hidden) return;
        clearTimeout(this.timer);
        this.close();
        const attempt = new AbortController();
        this.attempt = attempt;
        void this.run(attempt);
    }

    private visibilityChanged(): void {
        if (this.stopped) return;
        if (document.hidden) {
            clearTimeout(this.timer);
            this.close();
            this.events.paused();
        } else {
            this.retryMs = firstRetryMs;
            this.reconnectNow();
        }
    }

    private close(): void {
        clearTimeout(this.watchdog);
        this.attempt?.abort();
        this.attempt = null;
        if (this.stream !== null) {
            const path = `api/v1/streams/${encodeURIComponent(this.stream)}`;
            this.stream = null;
            // The answer does not matter: an aborted stream is noticed by the server sooner or later anyway.
            void fetch(path, { method: "DELETE", keepalive: true, credentials: "same-origin" }).catch(() => undefined);
        }
    }

    private async run(attempt: AbortController): Promise<void> {
        if (!this.events.ready()) return;
        this.events.connecting();
        try {
            const response = await fetch(this.events.url(), {
                signal: attempt.signal,
                credentials: "same-origin",
                cache: "no-store",
            });
            if (response.status === 401 || response.status === 403) {
                this.events.refused((await problemOf(response)).message);
            } else if (response.ok && response.body) {
                await this.read(response.body.getReader(), attempt);
            }
        } catch {
            // Broken or aborted: what follows is the same.
        }
        if (attempt === this.attempt) this.retryLater();
    }

    private async read(reader: ReadableStreamDefaultReader<Uint8Array>, attempt: AbortController): Promise<void> {
        const decoder = new FrameDecoder();
        this.watch(attempt);
        for (;;) {
            const { done, value } = await reader.read();
            if (done || attempt !== this.attempt) return;
            this.watch(attempt);
            for (const message of decoder.push(value)) {
                if (message.header.type === "hello") {
                    this.stream = String(message.header["stream"]);
                    this.retryMs = firstRetryMs;
                }
                this.events.message(message);
            }
        }
    }

    private watch(attempt: AbortController): void {
        clearTimeout(this.watchdog);
        this.watchdog = setTimeout(() => attempt.abort(), silenceMs);
    }

    private retryLater(): void {
        clearTimeout(this.watchdog);
        this.stream = null;
        this.attempt = null;
        this.events.lost();
        this.timer = setTimeout(() => this.reconnectNow(), this.retryMs);
        this.retryMs = Math.min(longestRetryMs, this.retryMs * 2);
    }
}
