// Fetching again after every "something changed", without piling up: one request under way, and one more when anything
// changed meanwhile.

export class Refresher {
    private running: Promise<void> | null = null;
    private again = false;

    constructor(private readonly fetchOnce: () => Promise<void>) {}

    /** Resolves when an answer that was asked for after this call has arrived (or failed). */
    request(): Promise<void> {
        if (this.running) {
            this.again = true;
            return this.running;
        }
        this.running = this.run();
        return this.running;
    }

    private async run(): Promise<void> {
        try {
            do {
                this.again = false;
                await this.fetchOnce();
            } while (this.again);
        } finally {
            this.running = null;
        }
    }
}
