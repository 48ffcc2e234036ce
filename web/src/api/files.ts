// Browsing the folders that the server may open.
import { getJson } from "./http";
import type { FileListing, FilePreview } from "./types";

export function listFiles(path: string, glob: string): Promise<FileListing> {
    return getJson<FileListing>("api/v1/files", { path, glob });
}

export function previewFile(path: string, signal?: AbortSignal): Promise<FilePreview> {
    return getJson<FilePreview>("api/v1/files/preview", { path }, signal);
}
