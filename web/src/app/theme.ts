// The chosen theme is remembered on this machine; a browser that forbids storage just forgets it.
import type { AppStore } from "../state/app_state";
import type { Theme } from "../state/page";

const storageKey = "voxsheet.theme";

function stored(): Theme | null {
    try {
        const value = window.localStorage.getItem(storageKey);
        return value === "light" || value === "dark" ? value : null;
    } catch {
        return null;
    }
}

export function rememberTheme(store: AppStore): void {
    const before = stored();
    if (before) store.dispatch({ type: "page/theme", theme: before });
    let last = store.get().page.theme;
    store.subscribe(() => {
        const { theme } = store.get().page;
        if (theme === last) return;
        last = theme;
        try {
            window.localStorage.setItem(storageKey, theme);
        } catch {
            // Not remembered, then.
        }
    });
}
