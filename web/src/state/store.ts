// A store of one immutable state: actions go in, reducers give the next state, subscribers are told once per change.

export type Reducer<S, A> = (state: S, action: A) => S;

export class Store<S, A> {
    private readonly listeners = new Set<() => void>();

    constructor(
        private state: S,
        private readonly reducer: Reducer<S, A>,
    ) {}

    get(): S {
        return this.state;
    }

    dispatch(action: A): void {
        const next = this.reducer(this.state, action);
        if (next === this.state) return;
        this.state = next;
        for (const listener of [...this.listeners]) listener();
    }

    /** Returns the function that ends the subscription. */
    subscribe(listener: () => void): () => void {
        this.listeners.add(listener);
        return () => this.listeners.delete(listener);
    }
}
