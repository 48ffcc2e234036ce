// What a sheet with nothing in it says: three ways to begin.
import { FolderOpen, Sparkles } from "lucide-preact";
import { openDemo } from "../api/workbook";
import { isEmptyBook } from "../state/book";
import { useApp, useSelect } from "./app_context";
import { UploadButton } from "./DataPanel";

export function EmptyState() {
    const app = useApp();
    const empty = useSelect((state) => isEmptyBook(state.book) && state.book.datasets.length === 0);
    const hasDemo = useSelect((state) => state.connection.info?.demo === true);
    if (!empty) return null;
    return (
        <div class="empty-state">
            <h1>A sheet of volumes</h1>
            <p>Drop files here, {hasDemo ? "open from the server, or look at the demo" : "or open some from the server"}.</p>
            <div class="button-row">
                <button
                    type="button"
                    class="button primary"
                    onClick={() => app.store.dispatch({ type: "page/leftPanel", panel: "open" })}
                >
                    <FolderOpen size={16} aria-hidden="true" /> open from the server
                </button>
                <UploadButton text="upload files" />
                {hasDemo && (
                    <button type="button" class="button" onClick={() => void app.notices.attempt(openDemo).then(() => app.sync.book.request())}>
                        <Sparkles size={16} aria-hidden="true" /> look at the demo
                    </button>
                )}
            </div>
        </div>
    );
}
