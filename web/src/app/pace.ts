// Figures that come with every frame are told a few times a second: people read them no faster, and every changed text makes the
// browser arrange the pictures of all cells anew.

export class Pace<T> {
    private newest: { value: T } | null = null;
    private timer: ReturnType<typeof setTimeout> | undefined;

    constructor(
        private readonly tell: (value: T) => void,
        private readonly everyMs = 250,
    ) {}

    /** Told now if the last one was told long enough ago; else then, unless a newer one comes meanwhile. */
    offer(value: T): void {
        if (this.timer !== undefined) {
            this.newest = { value };
            return;
        }
        this.tell(value);
        this.timer = setTimeout(() => {
            this.timer = undefined;
            this.flush();
        }, this.everyMs);
    }

    /** What waits is told now. */
    flush(): void {
        const waiting = this.newest;
        this.newest = null;
        if (!waiting) return;
        clearTimeout(this.timer);
        this.timer = undefined;
        this.offer(waiting.value);
    }
}
