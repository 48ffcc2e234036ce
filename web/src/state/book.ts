// The workbook and the datasets as the server last told them; never edited here, always fetched again.
import type { BookState, CellState, ColourBarInfo, Dataset, SheetState } from "../api/types";

export interface Upload {
    id: number;
    name: string;
    progress: number;
    error: string | null;
}

export interface BookSlice {
    book: BookState | null;
    /** Name of the sheet on show; empty: the first. */
    sheetName: string;
    datasets: Dataset[];
    uploads: Upload[];
    /** Colour bars of the sheet on show, by cell. */
    bars: Record<string, ColourBarInfo>;
}

export const noBook: BookSlice = { book: null, sheetName: "", datasets: [], uploads: [], bars: {} };

export type BookAction =
    | { type: "book/loaded"; book: BookState }
    | { type: "book/sheet"; name: string }
    | { type: "book/datasets"; datasets: Dataset[] }
    | { type: "book/upload"; upload: Upload }
    | { type: "book/uploadDone"; id: number }
    | { type: "book/bars"; bars: Record<string, ColourBarInfo> };

export function reduceBook(state: BookSlice, action: BookAction): BookSlice {
    switch (action.type) {
        case "book/loaded":
            return { ...state, book: action.book };
        case "book/sheet":
            return { ...state, sheetName: action.name, bars: {} };
        case "book/datasets":
            return { ...state, datasets: action.datasets };
        case "book/upload":
            return {
                ...state,
                uploads: state.uploads.some((upload) => upload.id === action.upload.id)
                    ? state.uploads.map((upload) => (upload.id === action.upload.id ? action.upload : upload))
                    : [...state.uploads, action.upload],
            };
        case "book/uploadDone":
            return { ...state, uploads: state.uploads.filter((upload) => upload.id !== action.id) };
        case "book/bars":
            return { ...state, bars: action.bars };
    }
}

export function currentSheet(state: BookSlice): SheetState | undefined {
    return state.book?.sheets.find((sheet) => sheet.name === state.sheetName) ?? state.book?.sheets[0];
}

/** Every element of every tile looks its cell up whenever anything changes. */
const cellsByName = new WeakMap<SheetState, Map<string, CellState>>();

export function cellOf(sheet: SheetState | undefined, cell: string): CellState | undefined {
    if (!sheet) return undefined;
    let cells = cellsByName.get(sheet);
    if (!cells) {
        cells = new Map(sheet.cells.map((each) => [each.cell, each]));
        cellsByName.set(sheet, cells);
    }
    return cells.get(cell);
}

/** What the formula bar shows and takes: a formula with "=", or a dataset's name. */
export function sourceText(cell: CellState | undefined): string {
    return cell?.source?.formula ?? cell?.source?.dataset ?? "";
}

export function cellTitle(cell: CellState | undefined): string {
    return cell?.title || sourceText(cell);
}

/** Nothing in any cell of any sheet. */
export function isEmptyBook(state: BookSlice): boolean {
    return state.book !== null && state.book.sheets.every((sheet) => sheet.cells.every((cell) => cell.state === "empty"));
}
