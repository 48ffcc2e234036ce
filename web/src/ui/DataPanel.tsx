// The datasets: search, progress, what each one is, putting them into cells, and the way to open more.
import { Box, CircleX, FolderOpen, Loader, Trash2, TriangleAlert, Upload as UploadIcon, X } from "lucide-preact";
import { useRef, useState } from "preact/hooks";
import type { Dataset } from "../api/types";
import { formatAddress } from "../model/address";
import { formatBytes, formatDims, formatNumber, formatPercent, naturalOrder, withUnit } from "../model/format";
import type { Upload } from "../state/book";
import type { LeftPanel } from "../state/page";
import { useApp, useSelect } from "./app_context";
import { IconButton } from "./IconButton";
import { OpenPanel } from "./OpenPanel";
import { SavePanel } from "./SavePanel";
import { datasetDragType } from "./Sheet";

function DatasetFacts({ dataset }: { dataset: Dataset }) {
    const facts: [string, string][] = [
        ["format", dataset.format ?? "–"],
        ["size", formatDims(dataset.dims)],
        ["type", dataset.type ?? "–"],
        ["spacing", withUnit((dataset.spacing ?? []).map((step) => formatNumber(step)).join(" × ") || "–", dataset.units?.length)],
        [
            "range",
            dataset.range
                ? withUnit(`${formatNumber(dataset.range[0])} to ${formatNumber(dataset.range[1])}`, dataset.units?.value)
                : "–",
        ],
    ];
    if ((dataset.fields?.length ?? 0) > 1) facts.push(["fields", dataset.fields!.map((field) => field.name).join(", ")]);
    if ((dataset.steps ?? 1) > 1) facts.push(["steps", String(dataset.steps)]);
    if (dataset.bytes) facts.push(["bytes", formatBytes(dataset.bytes)]);
    return (
        <dl class="facts">
            {facts.map(([name, value]) => (
                <div key={name}>
                    <dt>{name}</dt>
                    <dd>{value}</dd>
                </div>
            ))}
            {dataset.notes?.map((note) => (
                <div key={note} class="note">
                    {note}
                </div>
            ))}
        </dl>
    );
}

function DatasetIcon({ state }: { state: Dataset["state"] }) {
    if (state === "ready") return <Box size={14} aria-label="ready" />;
    if (state === "failed") return <TriangleAlert size={14} class="error-colour" aria-label="failed" />;
    return <Loader size={14} class="spin" aria-label={state} />;
}

function DatasetRow({ dataset }: { dataset: Dataset }) {
    const app = useApp();
    const active = useSelect((state) => formatAddress(state.page.selection.active));
    const [open, setOpen] = useState(false);
    const busy = dataset.state === "importing" || dataset.state === "queued";
    return (
        <li class="dataset" data-dataset={dataset.name} data-state={dataset.state}>
            <div
                class="dataset-row"
                draggable
                onDragStart={(event) => {
                    event.dataTransfer?.setData(datasetDragType, dataset.name);
                    event.dataTransfer?.setData("text/plain", dataset.name);
                }}
            >
                <button type="button" class="dataset-name" aria-expanded={open} title={dataset.name} onClick={() => setOpen(!open)}>
                    <DatasetIcon state={dataset.state} />
                    <span>{dataset.name}</span>
                    {busy && <small>{formatPercent(dataset.progress)}</small>}
                </button>
                {busy ? (
                    <IconButton icon={CircleX} label={`Cancel the import of ${dataset.name}`} onClick={() => void app.datasets.cancel(dataset.name)} />
                ) : (
                    <IconButton icon={Trash2} label={`Remove ${dataset.name}`} onClick={() => void app.datasets.remove(dataset.name)} />
                )}
            </div>
            {busy && (
                <div class="progress" role="progressbar" aria-label={`Import of ${dataset.name}`} aria-valuenow={Math.round(100 * (dataset.progress ?? 0))}>
                    <i style={{ width: `${100 * (dataset.progress ?? 0)}%` }} />
                </div>
            )}
            {dataset.error && (
                <p class="dataset-error" role="alert">
                    {dataset.error.message}
                </p>
            )}
            {open && dataset.state === "ready" && (
                <>
                    <DatasetFacts dataset={dataset} />
                    <button
                        type="button"
                        class="text-button"
                        onClick={() =>
                            void app.cells.setSource(active, dataset.name).then((objection) => {
                                if (objection) app.notices.error(objection);
                            })
                        }
                    >
                        put into {active}
                    </button>
                </>
            )}
        </li>
    );
}

function UploadRow({ upload }: { upload: Upload }) {
    const app = useApp();
    return (
        <li class="dataset" data-upload={upload.name}>
            <div class="dataset-row">
                <span class="dataset-name">
                    <UploadIcon size={14} aria-hidden="true" />
                    <span>{upload.name}</span>
                    {!upload.error && <small>{formatPercent(upload.progress)}</small>}
                </span>
                {upload.error && <IconButton icon={X} label="Dismiss" onClick={() => app.datasets.dismissUpload(upload.id)} />}
            </div>
            {upload.error ? (
                <p class="dataset-error" role="alert">
                    {upload.error}
                </p>
            ) : (
                <div class="progress" role="progressbar" aria-label={`Upload of ${upload.name}`} aria-valuenow={Math.round(100 * upload.progress)}>
                    <i style={{ width: `${100 * upload.progress}%` }} />
                </div>
            )}
        </li>
    );
}

export function UploadButton({ text = "upload", class: extra = "button" }: { text?: string; class?: string }) {
    const app = useApp();
    const input = useRef<HTMLInputElement>(null);
    return (
        <>
            <button type="button" class={extra} onClick={() => input.current?.click()}>
                <UploadIcon size={16} aria-hidden="true" /> {text}
            </button>
            <input
                ref={input}
                type="file"
                multiple
                hidden
                aria-label="Files to upload"
                onChange={(event) => {
                    const files = [...(event.currentTarget.files ?? [])];
                    event.currentTarget.value = "";
                    void app.datasets.upload(files);
                }}
            />
        </>
    );
}

function DatasetList() {
    const { store } = useApp();
    const datasets = useSelect((state) => state.book.datasets);
    const uploads = useSelect((state) => state.book.uploads);
    const [search, setSearch] = useState("");
    const wanted = search.trim().toLowerCase();
    const shown = datasets
        .filter((dataset) => dataset.name.toLowerCase().includes(wanted))
        .sort((a, b) => naturalOrder(a.name, b.name));
    return (
        <>
            <div class="panel-head">
                <h2>Data</h2>
                <IconButton icon={X} label="Close" class="phone-only" onClick={() => store.dispatch({ type: "page/leftPanel", panel: null })} />
            </div>
            <input
                type="search"
                class="panel-search"
                placeholder="search"
                aria-label="Search datasets"
                value={search}
                onInput={(event) => setSearch(event.currentTarget.value)}
            />
            <ul class="dataset-list" aria-label="Datasets">
                {uploads.map((upload) => (
                    <UploadRow key={upload.id} upload={upload} />
                ))}
                {shown.map((dataset) => (
                    <DatasetRow key={dataset.name} dataset={dataset} />
                ))}
                {shown.length === 0 && uploads.length === 0 && (
                    <li class="hint">{datasets.length ? "Nothing matches." : "No data yet: drop files here, or open some."}</li>
                )}
            </ul>
            <div class="panel-foot">
                <button type="button" class="button" onClick={() => store.dispatch({ type: "page/leftPanel", panel: "open" })}>
                    <FolderOpen size={16} aria-hidden="true" /> open
                </button>
                <UploadButton />
            </div>
        </>
    );
}

const panelNames: Record<LeftPanel, string> = { datasets: "Data", open: "Open from the server", save: "Save the workbook" };

export function DataPanel() {
    const panel = useSelect((state) => state.page.leftPanel);
    if (panel === null) return null;
    return (
        <aside class={`panel left-panel ${panel === "datasets" ? "" : "wide"}`} aria-label={panelNames[panel]}>
            {panel === "open" && <OpenPanel />}
            {panel === "save" && <SavePanel />}
            {panel === "datasets" && <DatasetList />}
        </aside>
    );
}
