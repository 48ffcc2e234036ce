// Access to the app from components; a component is drawn again only when what it selected has changed.
import { createContext } from "preact";
import { useContext, useLayoutEffect, useRef, useState } from "preact/hooks";
import type { App } from "../app/app";
import type { AppState } from "../state/app_state";

export const AppContext = createContext<App | null>(null);

export function useApp(): App {
    const app = useContext(AppContext);
    if (!app) throw new Error("AppContext is missing");
    return app;
}

export function useSelect<T>(select: (state: AppState) => T, same: (a: T, b: T) => boolean = Object.is): T {
    const { store } = useApp();
    const [, redraw] = useState(0);
    const latest = useRef({ select, same, value: select(store.get()) });
    latest.current.select = select;
    latest.current.same = same;
    const value = select(store.get());
    if (!same(value, latest.current.value)) latest.current.value = value;
    useLayoutEffect(() => {
        const check = (): void => {
            const { current } = latest;
            const next = current.select(store.get());
            if (current.same(next, current.value)) return;
            current.value = next;
            redraw((count) => count + 1);
        };
        check();
        return store.subscribe(check);
    }, [store]);
    return latest.current.value;
}

export function sameItems<T>(a: readonly T[], b: readonly T[]): boolean {
    return a.length === b.length && a.every((item, i) => Object.is(item, b[i]));
}
