// Requests to the server that served the page. All addresses are relative, so that a base path (JupyterHub, Open OnDemand)
// works; the cookie that came with the page carries the token.

/** An answer of the server that is not success, or no answer at all (status 0). */
export class ApiProblem extends Error {
    constructor(
        readonly status: number,
        readonly title: string,
        detail: string,
        readonly field: string | null,
    ) {
        super(detail);
    }
}

export async function problemOf(response: Response): Promise<ApiProblem> {
    let title = `${response.status} ${response.statusText}`.trim();
    let detail = title;
    let field: string | null = null;
    try {
        const body = (await response.json()) as { title?: string; detail?: string; field?: string };
        title = body.title ?? title;
        detail = body.detail ?? title;
        field = body.field ?? null;
    } catch {
        // Not a problem document (a proxy's page, say): the status line has to do.
    }
    return new ApiProblem(response.status, title, detail, field);
}

async function answerTo(path: string, init: RequestInit): Promise<Response> {
    let response: Response;
    try {
        response = await fetch(path, { credentials: "same-origin", cache: "no-store", ...init });
    } catch {
        throw new ApiProblem(0, "No answer", "The server does not answer; the page reconnects by itself.", null);
    }
    if (!response.ok) throw await problemOf(response);
    return response;
}

export type Query = Record<string, string | number | boolean | null | undefined>;

export function withQuery(path: string, query: Query = {}): string {
    const parts = Object.entries(query)
        .filter(([, value]) => value !== null && value !== undefined && value !== "")
        .map(([key, value]) => `${encodeURIComponent(key)}=${encodeURIComponent(String(value))}`);
    return parts.length ? `${path}?${parts.join("&")}` : path;
}

export async function getJson<T>(path: string, query: Query = {}, signal?: AbortSignal): Promise<T> {
    const response = await answerTo(withQuery(path, query), signal ? { signal } : {});
    return (await response.json()) as T;
}

export async function sendJson<T>(method: "POST" | "PATCH" | "PUT" | "DELETE", path: string, body?: unknown): Promise<T | null> {
    const init: RequestInit = { method };
    if (body !== undefined) {
        init.body = JSON.stringify(body);
        init.headers = { "Content-Type": "application/json" };
    }
    const response = await answerTo(path, init);
    const text = await response.text();
    return text ? (JSON.parse(text) as T) : null;
}

export function pathPart(text: string): string {
    return encodeURIComponent(text);
}
