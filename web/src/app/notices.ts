// Short messages at the edge of the page; errors stay longer, and the newest few are kept.
import { ApiProblem } from "../api/http";
import type { AppStore } from "../state/app_state";

const infoMs = 4_000;
const errorMs = 12_000;

export class Notices {
    private nextId = 1;

    constructor(private readonly store: AppStore) {}

    info(text: string): void {
        this.show("info", text, infoMs);
    }

    error(text: string): void {
        this.show("error", text, errorMs);
    }

    /** Runs something that talks to the server; what goes wrong is told once, in the server's own words. */
    async attempt<T>(work: () => Promise<T>): Promise<T | null> {
        try {
            return await work();
        } catch (problem) {
            if (!(problem instanceof ApiProblem)) throw problem;
            this.error(problem.message);
            return null;
        }
    }

    private show(tone: "info" | "error", text: string, ms: number): void {
        const id = this.nextId++;
        this.store.dispatch({ type: "page/notice", notice: { id, tone, text } });
        setTimeout(() => this.store.dispatch({ type: "page/noticeGone", id }), ms);
    }
}
