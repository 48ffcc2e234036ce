// Browses the folders that the server may open; a panel, so that the sheet stays in sight.
import { ArrowLeft, ArrowUp } from "lucide-preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { listFiles } from "../api/files";
import { ApiProblem } from "../api/http";
import type { FileListing, FilePreview } from "../api/types";
import {
    allChosen,
    countFiles,
    extendedTo,
    fileRows,
    nothingChosen,
    openAsLabels,
    openRequests,
    suggestedAs,
    toggled,
    type Choice,
    type FileRow,
    type OpenAs,
} from "../model/file_choice";
import { naturalOrder } from "../model/format";
import { useApp } from "./app_context";
import { FileFacts } from "./FileFacts";
import { FileLine } from "./FileLine";
import { IconButton } from "./IconButton";

/** A folder's listing, folders first, names in natural order. */
function useFolder() {
    const [listing, setListing] = useState<FileListing | null>(null);
    const [problem, setProblem] = useState("");
    const browse = async (path: string): Promise<void> => {
        try {
            const next = await listFiles(path, "");
            // With one root there is nothing to choose.
            if (path === "" && next.entries.length === 1) return await browse(next.entries[0]!.path);
            next.entries.sort((a, b) => (a.kind === b.kind ? naturalOrder(a.name, b.name) : a.kind === "folder" ? -1 : 1));
            setListing(next);
            setProblem("");
        } catch (reason) {
            if (!(reason instanceof ApiProblem)) throw reason;
            setProblem(reason.message);
        }
    };
    useEffect(() => void browse(""), []);
    return { listing, problem, browse };
}

export function OpenPanel() {
    const app = useApp();
    const { listing, problem, browse } = useFolder();
    const [filter, setFilter] = useState("");
    const [expanded, setExpanded] = useState<ReadonlySet<string>>(new Set());
    const [choice, setChoice] = useState<Choice>(nothingChosen);
    const [looked, setLooked] = useState<FileRow | null>(null);
    const [suggested, setSuggested] = useState<ReadonlyMap<string, OpenAs>>(new Map());
    const [asked, setAsked] = useState<OpenAs | null>(null);
    const list = useRef<HTMLUListElement>(null);

    const rows = fileRows(listing?.entries ?? [], expanded, filter);
    const groups = openRequests(rows, choice, "stack").filter((group) => group.files.length > 1);
    // A series says by its first file what it is; loose files are compared unless asked otherwise.
    const guess = groups.every((group) => group.name !== undefined) && groups[0] ? suggested.get(groups[0].files[0]!) : undefined;
    const as = asked ?? guess ?? "each";
    const requests = openRequests(rows, choice, as);
    const count = countFiles(requests);

    const enter = (path: string): void => {
        setChoice(nothingChosen);
        setLooked(null);
        void browse(path);
    };
    const close = (): void => app.store.dispatch({ type: "page/leftPanel", panel: "datasets" });
    const open = async (wanted = requests): Promise<void> => {
        if (await app.datasets.open(wanted)) close();
    };
    const learn = (path: string, facts: FilePreview): void => setSuggested((known) => new Map(known).set(path, suggestedAs(facts.dims)));
    const expand = (path: string): void => {
        const next = new Set(expanded);
        if (!next.delete(path)) next.add(path);
        setExpanded(next);
    };

    const keyDown = (event: KeyboardEvent): void => {
        const at = rows.findIndex((row) => row.key === (event.target as HTMLElement).dataset.row);
        if (at < 0) return;
        const row = rows[at]!;
        const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
        if (step) {
            const next = rows[at + step];
            if (!next) return event.preventDefault();
            if (event.shiftKey) setChoice(extendedTo(choice.anchor === null ? { ...choice, anchor: row.key } : choice, rows, next.key));
            list.current?.querySelectorAll<HTMLElement>("[data-row]")[at + step]?.focus();
        } else if ((event.ctrlKey || event.metaKey) && event.key.toLowerCase() === "a") setChoice(allChosen(rows));
        else if (event.key === "Enter" && row.files.length > 0) {
            void open(count > 0 ? requests : openRequests(rows, toggled(nothingChosen, row.key), as));
        } else return;
        event.preventDefault();
        event.stopPropagation();
    };

    return (
        <>
            <div class="panel-head">
                <IconButton icon={ArrowLeft} label="Back to the data" onClick={close} />
                <h2>Open from the server</h2>
            </div>
            <div class="path-row">
                <IconButton icon={ArrowUp} label="Folder above" disabled={!listing || listing.path === ""} onClick={() => enter(listing?.parent ?? "")} />
                <span class="path" title={listing?.path}>
                    {listing?.path || "folders"}
                </span>
            </div>
            <input
                type="search"
                class="panel-search"
                placeholder="filter by name"
                aria-label="Filter files by name"
                value={filter}
                onInput={(event) => setFilter(event.currentTarget.value)}
            />
            {problem && (
                <p class="dataset-error" role="alert">
                    {problem}
                </p>
            )}
            <ul class="file-list" aria-label="Files" ref={list} onKeyDown={keyDown}>
                {rows.map((row) => (
                    <FileLine
                        key={row.key}
                        row={row}
                        checked={choice.chosen.has(row.key)}
                        expanded={expanded.has(row.entry.path)}
                        onChoose={(extend) => setChoice(extend ? extendedTo(choice, rows, row.key) : toggled(choice, row.key))}
                        onEnter={() => enter(row.entry.path)}
                        onExpand={() => expand(row.entry.path)}
                        onLook={() => setLooked(row)}
                    />
                ))}
                {listing && rows.length === 0 && <li class="hint">Nothing here that matches.</li>}
            </ul>
            {looked && <FileFacts path={looked.files[0]!} count={looked.files.length} onFacts={learn} />}
            <div class="panel-foot">
                {groups.length > 0 && (
                    <select aria-label="Open several files as" value={as} onChange={(event) => setAsked(event.currentTarget.value as OpenAs)}>
                        {Object.entries(openAsLabels).map(([value, label]) => (
                            <option key={value} value={value}>
                                {label}
                            </option>
                        ))}
                    </select>
                )}
                <button type="button" class="button primary" disabled={count === 0} onClick={() => void open()}>
                    open {count > 0 ? `${count} file${count > 1 ? "s" : ""}` : ""}
                </button>
            </div>
        </>
    );
}
