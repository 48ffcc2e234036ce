// What the server answers, as far as the page reads it.
import type { StylePatch, StyleValue } from "../model/camera";
import type { CameraFrame } from "../model/projection";
import type { VolumeBox } from "../model/volume_box";

export type { StylePatch, StyleValue };

export interface DeviceInfo {
    renderer: string;
    vendor?: string;
    version?: string;
    platform?: string;
    reason?: string;
    software?: boolean;
    robust?: boolean;
}

export interface ServerInfo {
    name: string;
    version: string;
    device: DeviceInfo | null;
    budgets?: Record<string, number>;
    limits?: Record<string, number>;
    roots?: string[];
    /** The server can open the demo workbook. */
    demo?: boolean;
}

export interface StyleKey {
    name: string;
    type: string;
    unit?: string | null;
    min?: number | null;
    max?: number | null;
    default?: StyleValue;
    choices?: string[] | null;
    /** What some servers call `choices`. */
    values?: string[] | null;
    takesNone?: boolean;
    takesAuto?: boolean;
    doc?: string;
    group?: string;
    widget?: string | null;
    scope?: string;
    appliesWhen?: { key: string; values: string[] } | null;
    /** Of rows of numbers. */
    columns?: number;
    minRows?: number;
    maxRows?: number;
    columnNames?: string[];
}

/** Style values that are set together, with one press. */
export interface Preset {
    name: string;
    label: string;
    doc: string;
    style: StylePatch;
}

export type ColourStop = [number, number, number, number];

export interface ColourMap {
    name: string;
    label: string;
    kind: string;
    pivot?: number | null;
    stops: ColourStop[];
}

export interface FileEntry {
    name: string;
    path: string;
    kind: "folder" | "file";
    bytes?: number;
    format?: string | null;
    count?: number;
    files?: string[];
}

export interface FileListing {
    path: string;
    parent: string | null;
    roots: string[];
    entries: FileEntry[];
}

export type FilePreview = Record<string, unknown>;

export interface DatasetField {
    name: string;
    unit?: string;
    quantity?: string;
    range?: [number, number];
}

export interface Dataset {
    name: string;
    state: "queued" | "importing" | "ready" | "failed";
    progress?: number;
    error?: { kind?: string; message: string } | null;
    files?: string[];
    dims?: number[];
    spacing?: number[];
    type?: string;
    range?: [number, number];
    units?: { length?: string; value?: string };
    fields?: DatasetField[];
    steps?: number;
    levels?: unknown;
    format?: string;
    notes?: string[];
    bytes?: number;
    box?: VolumeBox;
}

export interface Histogram {
    low: number;
    high: number;
    counts: number[];
    mean?: number;
    min?: number;
    max?: number;
    stddev?: number;
    nan?: number;
}

export type Origin = "default" | "sheet" | "column" | "row" | "cell";

export interface ResolvedValue {
    value: StyleValue;
    origin: Origin;
}

export interface CellState {
    cell: string;
    title?: string;
    source?: { dataset?: string; formula?: string } | null;
    state: "ok" | "empty" | "importing" | "error";
    code?: string;
    message?: string;
    progress?: number;
    dataset?: string | null;
    orientation?: boolean;
    /** The drawn box of what the cell shows. */
    box?: VolumeBox | null;
    /** What the camera's lengths refer to (camera.frame). */
    frame?: CameraFrame | null;
    style: Record<string, ResolvedValue>;
}

export interface SheetState {
    name: string;
    rows: number;
    columns: number;
    title?: string;
    columnTitles?: Record<string, string>;
    rowTitles?: Record<string, string>;
    /** Of all cells, where their column, row or they themselves say nothing else. */
    style?: Record<string, ResolvedValue>;
    cells: CellState[];
}

export interface BookState {
    version: number;
    canUndo: boolean;
    canRedo: boolean;
    workbook?: { name?: string; title?: string } & Record<string, unknown>;
    sheets: SheetState[];
}

export interface HiddenEdit {
    cell: string;
    key: string;
    by: "cell" | "row" | "column";
}

export interface EditAnswer {
    version?: number;
    hidden?: HiddenEdit[];
}

export interface ColourBarTick {
    pos: number;
    label: string;
}

export interface BarIsovalue {
    value: number;
    /** 0 to 1 along the bar; null: outside it. */
    position: number | null;
    colour: [number, number, number];
    opacity: number;
}

export interface ColourBarInfo {
    stops: [number, number, number, number, number][];
    low: number;
    high: number;
    scale: string;
    unit?: string;
    quantity?: string;
    /** Red, green, blue, opacity of samples without a value; null: there are none. */
    nan?: [number, number, number, number] | null;
    /** Of values outside the range; null: as at its ends. */
    below?: [number, number, number, number] | null;
    above?: [number, number, number, number] | null;
    shared?: boolean;
    /** The opacity curve as drawn, also when it was chosen from the data. */
    opacity?: [number, number][];
    /** Of the isosurfaces as drawn, also when they were chosen from the data, with those that the mirror adds. */
    isovalues?: BarIsovalue[];
    /** Where another volume colours the surfaces: that one's bar. */
    colouredBy?: ColourBarInfo | null;
    ticks: ColourBarTick[];
    /** Of a label map: its legend. */
    labels?: LegendLabel[] | null;
    /** Volumes that are blended into the picture, or painted over a plane. */
    layers?: LayerBar[];
}

export interface LegendLabel {
    value: number;
    name: string;
    colour: [number, number, number];
    hidden: boolean;
}

export interface LayerBar {
    name: string;
    weight: number;
    labels?: LegendLabel[] | null;
    stops: [number, number, number, number, number][];
    low: number;
    high: number;
    scale: string;
    unit?: string;
}

export interface ProbeAnswer {
    /** Whose picture was probed. */
    cell?: string;
    world: [number, number, number] | null;
    values: ProbeValue[];
}

export interface ProbeValue {
    cell: string;
    value: number | null;
    /** What a label map calls the value. */
    label?: string | null;
    /** Symbol of the atom that is seen there. */
    atom?: string | null;
    index?: number[];
    unit?: string;
    note?: string;
    /** Of the volumes that are blended into the cell's picture. */
    layers?: { name: string; value: number | null; label?: string | null; unit?: string; note?: string }[];
}

export type LayerTarget =
    | { layer: "sheet" }
    | { layer: "column"; column: string }
    | { layer: "row"; row: string }
    | { layer: "cell"; cell: string };
