// What a file's header says, read by the server without its voxels.
import { useEffect, useState } from "preact/hooks";
import { previewFile } from "../api/files";
import { ApiProblem } from "../api/http";
import type { FilePreview } from "../api/types";
import { formatBytes, formatDims, formatNumber } from "../model/format";

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

/** \param count  files of the series that the file is the first of; 1: it stands alone */
export function FileFacts({ path, count, onFacts }: { path: string; count: number; onFacts: (path: string, facts: FilePreview) => void }) {
    const [preview, setPreview] = useState<FilePreview | null>(null);
    const [problem, setProblem] = useState("");
    useEffect(() => {
        setPreview(null);
        setProblem("");
        const abort = new AbortController();
        const show = (facts: FilePreview): void => {
            setPreview(facts);
            onFacts(path, facts);
        };
        previewFile(path, abort.signal).then(show, (reason: unknown) => {
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
            {count > 1 && (
                <div>
                    <dt>files</dt>
                    <dd>{count}, the first of which has</dd>
                </div>
            )}
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
