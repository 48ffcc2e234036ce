// The address box and the formula of the active cell. While a formula is typed, a click on a cell puts its address in.
import { useEffect, useRef } from "preact/hooks";
import { formatAddress, parseAddress } from "../model/address";
import { describeSelection, moveSelection, selectCell } from "../model/selection";
import { cellOf, currentSheet, sourceText } from "../state/book";
import { useApp, useSelect } from "./app_context";

export const formulaInputId = "formula-input";

/** True when a cell's address may follow: at the start of an operand. */
export function takesReference(text: string, caret: number): boolean {
    return text.startsWith("=") && /[=(+\-*/,]\s*$/.test(text.slice(0, caret));
}

function AddressBox() {
    const app = useApp();
    const selection = useSelect((state) => state.page.selection);
    const label = describeSelection(selection);
    const commit = (input: HTMLInputElement): void => {
        const address = parseAddress(input.value);
        const sheet = currentSheet(app.store.get().book);
        if (address && sheet && address.column < sheet.columns && address.row < sheet.rows) {
            app.store.dispatch({ type: "page/select", selection: selectCell(selection, address) });
        } else if (input.value !== label) {
            app.notices.error(`There is no cell ${input.value} on this sheet; type an address such as B2.`);
        }
        input.value = describeSelection(app.store.get().page.selection);
    };
    return (
        <input
            class="address-box"
            aria-label="Selected cell; type an address to go there"
            value={label}
            spellcheck={false}
            onFocus={(event) => event.currentTarget.select()}
            onKeyDown={(event) => {
                if (event.key === "Enter") commit(event.currentTarget);
                if (event.key === "Escape") event.currentTarget.blur();
            }}
        />
    );
}

export function FormulaBar() {
    const app = useApp();
    const { store } = app;
    const input = useRef<HTMLInputElement>(null);
    const active = useSelect((state) => formatAddress(state.page.selection.active));
    const committed = useSelect((state) => sourceText(cellOf(currentSheet(state.book), active)));
    const typed = useSelect((state) => state.page.formula);
    const error = useSelect((state) => state.page.formulaError);
    const datasets = useSelect((state) => state.book.datasets);

    const cancel = (): void => {
        store.dispatch({ type: "page/formula", text: null });
        input.current?.blur();
    };
    /** Returns false when the server objects; the text then stays for correction. */
    const commit = async (): Promise<boolean> => {
        const text = store.get().page.formula;
        if (text !== null && text !== committed) {
            const objection = await app.cells.setSource(active, text);
            if (objection !== null) {
                store.dispatch({ type: "page/formula", text, error: objection });
                return false;
            }
        }
        store.dispatch({ type: "page/formula", text: null });
        return true;
    };
    const commitAndMove = async (columns: number, rows: number): Promise<void> => {
        if (!(await commit())) return;
        const sheet = currentSheet(store.get().book);
        if (!sheet) return;
        const selection = moveSelection(store.get().page.selection, columns, rows, false, sheet);
        store.dispatch({ type: "page/select", selection });
        focusTitle(formatAddress(selection.active));
    };

    useEffect(() => {
        if (error) input.current?.focus();
    }, [error]);

    return (
        <div class="formula-bar">
            <AddressBox />
            <span class="formula-sign" aria-hidden="true">
                fx
            </span>
            <div class="formula-field">
                <input
                    id={formulaInputId}
                    ref={input}
                    aria-label={`Source of cell ${active}: a dataset's name, or a formula such as =B1-A1`}
                    aria-invalid={error !== ""}
                    aria-describedby={error ? "formula-error" : undefined}
                    placeholder="dataset, or a formula such as =B1-A1"
                    list="dataset-names"
                    spellcheck={false}
                    autocomplete="off"
                    value={typed ?? committed}
                    onInput={(event) => store.dispatch({ type: "page/formula", text: event.currentTarget.value })}
                    onBlur={() => {
                        if (store.get().page.formula !== null && !store.get().page.formulaError) void commit();
                    }}
                    onKeyDown={(event) => {
                        if (event.key === "Enter") void commitAndMove(0, 0);
                        else if (event.key === "Tab" && typed !== null) {
                            event.preventDefault();
                            void commitAndMove(event.shiftKey ? -1 : 1, 0);
                        } else if (event.key === "Escape") cancel();
                        event.stopPropagation();
                    }}
                />
                <datalist id="dataset-names">
                    {datasets.map((dataset) => (
                        <option key={dataset.name} value={dataset.name} />
                    ))}
                </datalist>
                {error && (
                    <div class="formula-error" id="formula-error" role="alert">
                        {error}
                    </div>
                )}
            </div>
        </div>
    );
}

/** A tile that was scrolled out of view comes into the page with the next frame: a selected one is always there. */
function focusSoon(selector: string): void {
    const focus = (): boolean => {
        const element = document.querySelector<HTMLElement>(selector);
        element?.focus();
        return element !== null;
    };
    if (!focus()) requestAnimationFrame(focus);
}

export function focusTitle(cell: string): void {
    focusSoon(`[data-title-of="${cell}"]`);
}

export function focusPicture(cell: string): void {
    focusSoon(`[data-picture-of="${cell}"]`);
}

export function focusHeading(name: string): void {
    focusSoon(`[data-header="${name}"]`);
}

/** Starts editing; `text`: what the bar begins with instead of the cell's source. */
export function focusFormula(text?: string): void {
    const input = document.getElementById(formulaInputId) as HTMLInputElement | null;
    if (!input) return;
    input.focus();
    if (text !== undefined) {
        input.value = text;
        input.dispatchEvent(new Event("input", { bubbles: true }));
    }
    input.setSelectionRange(input.value.length, input.value.length);
}

/** While a formula is being typed: puts a reference where the caret is. Returns whether it did. */
export function insertReference(cell: string): boolean {
    const input = document.getElementById(formulaInputId) as HTMLInputElement | null;
    if (!input || document.activeElement !== input) return false;
    const caret = input.selectionStart ?? input.value.length;
    if (!takesReference(input.value, caret)) return false;
    input.setRangeText(cell, caret, input.selectionEnd ?? caret, "end");
    input.dispatchEvent(new Event("input", { bubbles: true }));
    return true;
}
