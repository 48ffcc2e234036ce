// Browses the folders that the server may open; a panel, so that the sheet stays in sight.
import { ArrowLeft, ArrowUp, File as FileIcon, Files, Folder } from "lucide-preact";
import { useEffect, useState } from "preact/hooks";
import { listFiles, previewFile } from "../api/files";
import { ApiProblem } from "../api/http";
import type { FileEntry, FileListing, FilePreview } from "../api/types";
import { formatBytes, formatDims, formatNumber, naturalOrder } from "../model/format";
import { useApp } from "./app_context";
import { IconButton } from "./IconButton";

function asText(value: unknown): string {
    if (value === null || value === undefined) return "";
    if (typeof value === "number") return formatNumber(value);
    if (Array.isArray(value)) {
        if (value.every((part) => typeof part === "number")) {
            return value.every(Number.isInteger) ? formatDims(value as number[]) : value.map((part) => formatNumber(part as number)).join(" × ");
        }
        return value.map(asText).filter(Boolean).join(", ");
    }
    if (typeof value === "object") {
        const named = (value as { name?: unknown }).name;
        if (typeof named === "string") return named;
        return Object.entries(value)
            .filter(([, part]) => asText(part) !== "")
            .map(([key, part]) => `${key} ${asText(part)}`)
            .join(", ");
    }
    return String(value);
}

const previewKeys = ["format", "dims", "spacing", "type", "range", "fields", "steps", "units", "bytes"];

function Preview({ path }: { path: string }) {
    const [preview, setPreview] = useState<FilePreview | null>(null);
    const [problem, setProblem] = useState("");
    useEffect(() => {
        setPreview(null);
        setProblem("");
        const abort = new AbortController();
        previewFile(path, abort.signal).then(setPreview, (reason: unknown) => {
            if (!abort.signal.aborted) setProblem(reason instanceof ApiProblem ? reason.message : "No preview.");
        });
        return () => abort.abort();
    }, [path]);
    if (problem) {
        return (
            <p class="dataset-error" role="alert">
                {problem}
            </p>
        );
    }
    if (!preview) return <p class="hint">Reading the header …</p>;
    return (
        <dl class="facts" aria-label="Preview">
            {previewKeys
                .filter((key) => asText(preview[key]) !== "")
                .map((key) => (
                    <div key={key}>
                        <dt>{key === "dims" ? "size" : key}</dt>
                        <dd>{key === "bytes" ? formatBytes(preview[key] as number) : asText(preview[key])}</dd>
                    </div>
                ))}
        </dl>
    );
}

/** A numbered series arrives as one entry that names its files, beside the files themselves. */
function filesOf(entry: FileEntry): string[] {
    return entry.files?.length ? entry.files : [entry.path];
}

function keyOf(entry: FileEntry): string {
    return entry.files?.length ? `series ${entry.path}` : entry.path;
}

function Entry({
    entry,
    checked,
    onCheck,
    onEnter,
    onLook,
}: {
    entry: FileEntry;
    checked: boolean;
    onCheck: (checked: boolean) => void;
    onEnter: () => void;
    onLook: () => void;
}) {
    if (entry.kind === "folder") {
        return (
            <li>
                <button type="button" class="file-entry" onClick={onEnter} title={entry.path}>
                    <Folder size={14} aria-hidden="true" /> <span>{entry.name}</span>
                </button>
            </li>
        );
    }
    const series = (entry.files?.length ?? 0) > 1;
    return (
        <li>
            <label class="file-entry" title={entry.path} onPointerEnter={onLook} onFocusCapture={onLook}>
                <input type="checkbox" checked={checked} onChange={(event) => onCheck(event.currentTarget.checked)} />
                {series ? <Files size={14} aria-hidden="true" /> : <FileIcon size={14} aria-hidden="true" />}
                <span>{series ? `${entry.name} (${entry.files!.length} files)` : entry.name}</span>
                <small>{entry.format ?? ""}</small>
                <small>{formatBytes(entry.bytes)}</small>
            </label>
        </li>
    );
}

export function OpenPanel() {
    const app = useApp();
    const [listing, setListing] = useState<FileListing | null>(null);
    const [problem, setProblem] = useState("");
    const [filter, setFilter] = useState("");
    const [chosen, setChosen] = useState<ReadonlyMap<string, string[]>>(new Map());
    const [looked, setLooked] = useState<string | null>(null);
    const [series, setSeries] = useState(false);

    const browse = async (path: string): Promise<void> => {
        try {
            const next = await listFiles(path, "");
            // With one root there is nothing to choose.
            if (path === "" && next.entries.length === 1) return await browse(next.entries[0]!.path);
            setListing(next);
            setProblem("");
            setLooked(null);
        } catch (reason) {
            if (!(reason instanceof ApiProblem)) throw reason;
            setProblem(reason.message);
        }
    };
    useEffect(() => void browse(""), []);

    const close = (): void => app.store.dispatch({ type: "page/leftPanel", panel: "datasets" });
    const check = (entry: FileEntry, checked: boolean): void => {
        const next = new Map(chosen);
        if (checked) next.set(keyOf(entry), filesOf(entry));
        else next.delete(keyOf(entry));
        setChosen(next);
    };
    const open = async (): Promise<void> => {
        const files = [...new Set([...chosen.values()].flat())];
        if (await app.datasets.open(files, series)) close();
    };

    const wanted = filter.trim().toLowerCase();
    const entries = (listing?.entries ?? [])
        .filter((entry) => entry.name.toLowerCase().includes(wanted))
        .sort((a, b) => (a.kind === b.kind ? naturalOrder(a.name, b.name) : a.kind === "folder" ? -1 : 1));
    const count = new Set([...chosen.values()].flat()).size;

    return (
        <>
            <div class="panel-head">
                <IconButton icon={ArrowLeft} label="Back to the data" onClick={close} />
                <h2>Open from the server</h2>
            </div>
            <div class="path-row">
                <IconButton
                    icon={ArrowUp}
                    label="Folder above"
                    disabled={!listing || listing.path === ""}
                    onClick={() => void browse(listing?.parent ?? "")}
                />
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
            <ul class="file-list" aria-label="Files">
                {entries.map((entry) => (
                    <Entry
                        key={keyOf(entry)}
                        entry={entry}
                        checked={chosen.has(keyOf(entry))}
                        onCheck={(checked) => check(entry, checked)}
                        onEnter={() => void browse(entry.path)}
                        onLook={() => setLooked(filesOf(entry)[0]!)}
                    />
                ))}
                {listing && entries.length === 0 && <li class="hint">Nothing here that matches.</li>}
            </ul>
            {looked && <Preview path={looked} />}
            <div class="panel-foot">
                <label class="check" title="One dataset with a step per file, instead of a dataset per file">
                    <input type="checkbox" checked={series} disabled={count < 2} onChange={(event) => setSeries(event.currentTarget.checked)} />
                    as one series
                </label>
                <button type="button" class="button primary" disabled={count === 0} onClick={() => void open()}>
                    open {count > 0 ? `${count} file${count > 1 ? "s" : ""}` : ""}
                </button>
            </div>
        </>
    );
}
