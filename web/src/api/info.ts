// What the server is and what it understands: read once per connection.
import { getJson } from "./http";
import type { ColourMap, Preset, ServerInfo, StyleKey } from "./types";

export function getInfo(): Promise<ServerInfo> {
    return getJson<ServerInfo>("api/v1");
}

export async function getStyleKeys(): Promise<StyleKey[]> {
    return (await getJson<{ keys: StyleKey[] }>("api/v1/keys")).keys;
}

export async function getColourMaps(): Promise<ColourMap[]> {
    return (await getJson<{ maps: ColourMap[] }>("api/v1/colourmaps")).maps;
}

export async function getPresets(): Promise<Preset[]> {
    return (await getJson<{ presets: Preset[] }>("api/v1/presets")).presets;
}
