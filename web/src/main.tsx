// Entry point of the page.
import { render } from "preact";
import { App } from "./app/app";
import { rememberTheme } from "./app/theme";
import { watchHeldKeys } from "./input/held_keys";
import { watchShortcuts } from "./input/shortcuts";
import "./styles/app.css";
import { AppContext } from "./ui/app_context";
import { focusFormula, focusPicture } from "./ui/FormulaBar";
import { Page } from "./ui/Page";

declare global {
    interface Window {
        /** For tests and for the curious: painted frames, and the state behind the page. */
        voxsheet: { stats: App["painter"]["statistics"]; store: App["store"]; app: App };
    }
}

const narrowPixels = 900;

/** The token has become a cookie by now; it must not stay in the address bar, in history or in copied links. */
function forgetToken(): void {
    const url = new URL(window.location.href);
    if (!url.searchParams.has("token")) return;
    url.searchParams.delete("token");
    window.history.replaceState(null, "", url);
}

const app = new App();
window.voxsheet = { stats: app.painter.statistics, store: app.store, app };
forgetToken();
rememberTheme(app.store);
watchHeldKeys();
watchShortcuts(app, { editFormula: focusFormula, focusPicture });
if (window.innerWidth < narrowPixels) {
    app.store.dispatch({ type: "page/leftPanel", panel: null });
    app.store.dispatch({ type: "page/inspector", open: false });
}
render(
    <AppContext.Provider value={app}>
        <Page />
    </AppContext.Provider>,
    document.getElementById("app")!,
);
void app.start();
