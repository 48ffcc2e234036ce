// What the server is and what it understands: read once per connection.
import { getJson } from "./http";
import type { ColourMap, ServerInfo, StyleKey } from "./types";

export function getInfo(): Promise<ServerInfo> {
    return getJson<ServerInfo>("api/v1");
}

export async function getStyleKeys(): Promise<StyleKey[]> {
    return (await getJson<{ keys: StyleKey[] }>("api/v1/keys")).keys;
}

export async function getColourMaps(): Promise<ColourMap[]> {
    return (await getJson<{ maps: ColourMap[] }>("api/v1/colourmaps")).maps;
}
