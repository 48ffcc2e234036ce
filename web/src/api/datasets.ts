// Datasets: list, import from the server's folders, upload, removal, histogram.
import { ApiProblem, getJson, pathPart, sendJson, withQuery } from "./http";
import type { Dataset, Histogram } from "./types";

export async function listDatasets(): Promise<Dataset[]> {
    return (await getJson<{ datasets: Dataset[] }>("api/v1/datasets")).datasets;
}

export interface ImportOptions {
    /** One dataset from all files: slices of a volume, or steps of time. */
    series?: "stack" | "steps";
    name?: string;
}

export async function importFiles(files: string[], options: ImportOptions = {}): Promise<string[]> {
    const answer = await sendJson<{ datasets: string[] }>("POST", "api/v1/datasets", { files, ...options });
    return answer?.datasets ?? [];
}

export async function removeDataset(name: string): Promise<void> {
    await sendJson("DELETE", `api/v1/datasets/${pathPart(name)}`);
}

export async function cancelImport(name: string): Promise<void> {
    await sendJson("POST", `api/v1/datasets/${pathPart(name)}/cancel`);
}

export function getHistogram(name: string, field: string | number | null, step: number | null): Promise<Histogram> {
    return getJson<Histogram>(`api/v1/datasets/${pathPart(name)}/histogram`, { field, step });
}

/** XMLHttpRequest because fetch() reports no upload progress. Resolves to the dataset's name. */
export function uploadFile(name: string, file: File, onProgress: (part: number) => void): Promise<string> {
    return new Promise((resolve, reject) => {
        const request = new XMLHttpRequest();
        request.open("PUT", withQuery(`api/v1/datasets/${pathPart(name)}/content`, { filename: file.name }));
        request.setRequestHeader("Content-Type", "application/octet-stream");
        request.upload.onprogress = (event) => onProgress(event.lengthComputable ? event.loaded / event.total : 0);
        request.onerror = () =>
            reject(new ApiProblem(0, "Upload failed", "The connection broke during the upload; please try again.", null));
        request.onload = () => {
            let body: { name?: string; title?: string; detail?: string; field?: string } = {};
            try {
                body = JSON.parse(request.responseText) as typeof body;
            } catch {
                // An empty or foreign answer: the status decides below.
            }
            if (request.status >= 200 && request.status < 300) resolve(body.name ?? name);
            else {
                const title = body.title ?? `${request.status} ${request.statusText}`;
                reject(new ApiProblem(request.status, title, body.detail ?? title, body.field ?? null));
            }
        };
        request.send(file);
    });
}
