// The page's layout: bar, data, sheet, inspector, status.
import { useEffect } from "preact/hooks";
import { useSelect } from "./app_context";
import { DataPanel } from "./DataPanel";
import { DropArea } from "./DropArea";
import { EmptyState } from "./EmptyState";
import { Help } from "./Help";
import { Inspector } from "./Inspector";
import { Notices } from "./Notices";
import { Sheet } from "./Sheet";
import { StatusBar } from "./StatusBar";
import { TopBar } from "./TopBar";

function Refused() {
    const refused = useSelect((state) => state.connection.phase === "refused");
    const message = useSelect((state) => state.connection.message);
    if (!refused) return null;
    return (
        <div class="refused" role="alert">
            <h1>This page may not talk to the server</h1>
            <p>{message}</p>
            <p>The server prints a link with a token when it starts: please open that link.</p>
        </div>
    );
}

export function Page() {
    const theme = useSelect((state) => state.page.theme);
    useEffect(() => {
        document.documentElement.dataset["theme"] = theme;
    }, [theme]);
    return (
        <div class="page">
            <TopBar />
            <div class="middle">
                <DataPanel />
                <div class="centre">
                    <Sheet />
                    <EmptyState />
                    <Refused />
                </div>
                <Inspector />
                <Help />
            </div>
            <StatusBar />
            <Notices />
            <DropArea />
        </div>
    );
}
