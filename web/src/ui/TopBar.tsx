// Name, undo and redo, address, formula, view link, export, theme, help.
import {
    CircleHelp,
    Download,
    Link,
    Moon,
    PanelLeft,
    PanelRight,
    Redo2,
    Save,
    Scissors,
    Sun,
    Undo2,
} from "lucide-preact";
import { cellImageUrl, sheetImageUrl } from "../api/sheets";
import type { Query } from "../api/http";
import { formatAddress } from "../model/address";
import type { StylePatch } from "../model/camera";
import { viewOverrides } from "../model/look";
import { currentSheet } from "../state/book";
import { useApp, useSelect } from "./app_context";
import { FormulaBar } from "./FormulaBar";
import { IconButton } from "./IconButton";
import { Menu, type MenuItem } from "./Menu";

const exportPixels = { cellWidth: 640, cellHeight: 480 };

/** Style values as queries take them: vectors as "0,0,1". */
function styleQuery(style: StylePatch): Query {
    return Object.fromEntries(
        Object.entries(style).map(([key, value]) => [key, Array.isArray(value) ? value.join(",") : value]),
    ) as Query;
}

function ExportMenu() {
    const app = useApp();
    const sheet = useSelect((state) => currentSheet(state.book));
    const active = useSelect((state) => formatAddress(state.page.selection.active));
    const look = useSelect((state) => state.page.look);
    if (!sheet) return null;
    const size = { width: exportPixels.cellWidth * sheet.columns, height: exportPixels.cellHeight * sheet.rows };
    const view = viewOverrides(look, sheet, {});
    const cell = {
        width: exportPixels.cellWidth,
        height: exportPixels.cellHeight,
        ...styleQuery({ ...view.style, ...view.cells[active] }),
    };
    const items: MenuItem[] = [
        {
            label: "Sheet as PNG",
            hint: "this view",
            href: sheetImageUrl(sheet.name, "png", { ...size, ...styleQuery(view.style) }),
            download: `${sheet.name}.png`,
        },
        {
            label: `Cell ${active} as PNG`,
            hint: "this view",
            href: cellImageUrl(sheet.name, active, "png", cell),
            download: `${active}.png`,
        },
        {
            label: `Copy address of ${active}'s picture`,
            onChoose: () => {
                const url = new URL(cellImageUrl(sheet.name, active, "png", cell), document.baseURI).href;
                void navigator.clipboard.writeText(url).then(
                    () => app.notices.info("Address of the picture copied."),
                    () => app.notices.error(`Copying is not allowed here; the address is ${url}`),
                );
            },
        },
        { label: "Workbook as JSON", href: "api/v1/workbook", download: "workbook.json" },
        { label: "Save the workbook on the server", hint: "Ctrl+S", onChoose: () => void app.cells.save() },
    ];
    return (
        <Menu label="Export" items={items}>
            <Download size={16} aria-hidden="true" />
        </Menu>
    );
}

function ThemeButton() {
    const app = useApp();
    const theme = useSelect((state) => state.page.theme);
    const next = theme === "dark" ? "light" : "dark";
    return (
        <IconButton
            icon={theme === "dark" ? Sun : Moon}
            label={`Use the ${next} theme`}
            onClick={() => app.store.dispatch({ type: "page/theme", theme: next })}
        />
    );
}

export function TopBar() {
    const app = useApp();
    const { store, view } = app;
    const book = useSelect((state) => state.book.book);
    const leftPanel = useSelect((state) => state.page.leftPanel);
    const inspector = useSelect((state) => state.page.inspector);
    const help = useSelect((state) => state.page.help);
    const clipHandles = useSelect((state) => state.page.clipHandles);
    const name = book?.workbook?.title || book?.workbook?.name || "";
    return (
        <header class="top-bar">
            <IconButton
                icon={PanelLeft}
                label={leftPanel ? "Hide data" : "Show data"}
                pressed={leftPanel !== null}
                onClick={() => store.dispatch({ type: "page/leftPanel", panel: leftPanel ? null : "datasets" })}
            />
            <strong class="brand">Voxsheet</strong>
            {name && <span class="book-name">{name}</span>}
            <div class="button-group">
                <IconButton icon={Undo2} label="Undo" keys="Ctrl+Z" disabled={!book?.canUndo} onClick={() => void app.undo()} />
                <IconButton icon={Redo2} label="Redo" keys="Ctrl+Shift+Z" disabled={!book?.canRedo} onClick={() => void app.redo()} />
            </div>
            <FormulaBar />
            <div class="button-group">
                <IconButton
                    icon={Scissors}
                    label={clipHandles ? "Hide clip handles" : "Show clip handles"}
                    keys="c"
                    pressed={clipHandles}
                    onClick={() => app.clips.toggleHandles()}
                />
                <IconButton icon={Save} label="Save view into the workbook" onClick={() => void view.save()} />
                <IconButton icon={Link} label="Copy a link to this view" onClick={() => void view.copyLink()} />
                <ExportMenu />
                <ThemeButton />
                <IconButton
                    icon={CircleHelp}
                    label="Help"
                    keys="?"
                    pressed={help}
                    onClick={() => store.dispatch({ type: "page/help", open: !help })}
                />
                <IconButton
                    icon={PanelRight}
                    label={inspector ? "Hide inspector" : "Show inspector"}
                    pressed={inspector}
                    onClick={() => store.dispatch({ type: "page/inspector", open: !inspector })}
                />
            </div>
        </header>
    );
}
