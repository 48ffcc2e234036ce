// Where the workbook is written on the server: asked for when it has no file yet.
import { ArrowLeft } from "lucide-preact";
import { useState } from "preact/hooks";
import { useApp, useSelect } from "./app_context";
import { IconButton } from "./IconButton";

export function SavePanel() {
    const app = useApp();
    const reason = useSelect((state) => state.page.saveReason);
    const root = useSelect((state) => state.connection.info?.roots?.[0] ?? "");
    const [path, setPath] = useState(`${root}/workbook.json`);
    const close = (): void => app.store.dispatch({ type: "page/leftPanel", panel: "datasets" });
    const save = async (): Promise<void> => {
        if (await app.cells.saveAs(path)) close();
    };
    return (
        <form
            class="save-form"
            onSubmit={(event) => {
                event.preventDefault();
                void save();
            }}
        >
            <div class="panel-head">
                <IconButton icon={ArrowLeft} label="Back to the data" onClick={close} />
                <h2>Save the workbook on the server</h2>
            </div>
            {reason && <p class="hint">{reason}</p>}
            <label class="hint" for="save-path">
                File, in a folder that the server may open
            </label>
            <input
                id="save-path"
                class="panel-search"
                value={path}
                spellcheck={false}
                onInput={(event) => setPath(event.currentTarget.value)}
            />
            <div class="panel-foot">
                <button type="submit" class="button primary">
                    save
                </button>
            </div>
        </form>
    );
}
