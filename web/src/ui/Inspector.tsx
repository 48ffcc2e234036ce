// The style panel, built from the key table: what each value is, where it comes from, and where an edit goes.
import { EllipsisVertical, RotateCcw, X } from "lucide-preact";
import { useState } from "preact/hooks";
import type { CellState, StyleKey, StylePatch, StyleValue } from "../api/types";
import { formatAddress } from "../model/address";
import { groupKeys, isWide, keyLabel } from "../model/keys";
import { planeMovedTo, positionOfPlane } from "../model/plane_position";
import { originLabel, scopesOf, targetLabel, type Scope } from "../model/scope";
import { describeSelection } from "../model/selection";
import { cellOf, currentSheet } from "../state/book";
import { useApp, useSelect } from "./app_context";
import { ClipTools } from "./clip/ClipTools";
import { IconButton } from "./IconButton";
import { IsovalueEditor } from "./IsovalueEditor";
import { KeyControl } from "./KeyControl";
import { LightBall } from "./LightBall";
import { Menu } from "./Menu";
import { PresetRow } from "./PresetRow";
import { RangeTools } from "./RangeTools";
import { TransferEditor } from "./TransferEditor";

function TitleField({ cell }: { cell: CellState }) {
    const app = useApp();
    return (
        <div class="title-field">
            <label for="cell-title">Title</label>
            <input
                id="cell-title"
                key={cell.cell}
                value={cell.title ?? ""}
                onChange={(event) => void app.cells.setTitle(cell.cell, event.currentTarget.value)}
            />
        </div>
    );
}

function ScopeChooser() {
    const app = useApp();
    const selection = useSelect((state) => state.page.selection);
    useSelect((state) => state.page.scope);
    const scopes = scopesOf(selection);
    const current = app.styles.scope();
    const label = (scope: Scope): string => {
        const targets = app.styles.targets(scope);
        if (scope === "sheet" || targets.length === 0) return scope;
        return targets.length === 1 ? targetLabel(targets[0]!) : `${targets.length} ${scope}s`;
    };
    return (
        <div class="scope" role="radiogroup" aria-label="Edits go to">
            {scopes.map((scope) => (
                <button
                    type="button"
                    key={scope}
                    role="radio"
                    aria-checked={scope === current}
                    data-scope={scope}
                    onClick={() => app.store.dispatch({ type: "page/scope", scope })}
                >
                    {label(scope)}
                </button>
            ))}
        </div>
    );
}

/** An edit that a nearer value hides says so, and offers to remove what hides it. */
function HiddenMessage() {
    const app = useApp();
    const hidden = useSelect((state) => state.page.hidden);
    if (hidden.length === 0) return null;
    const cells = [...new Set(hidden.map((edit) => edit.cell))];
    const keys = [...new Set(hidden.map((edit) => edit.key))];
    const layers = [...new Set(hidden.map((edit) => edit.by))].join(" and ");
    return (
        <div class="hidden-message" role="status">
            <p>
                The edit of {keys.join(", ")} does not show in {cells.length > 4 ? `${cells.length} cells` : cells.join(", ")}: a value
                of the {layers} is nearer.
            </p>
            <button type="button" class="button" onClick={() => void app.styles.clearHiding()}>
                clear the nearer values
            </button>
            <IconButton icon={X} label="Dismiss" onClick={() => app.store.dispatch({ type: "page/hidden", hidden: [] })} />
        </div>
    );
}

function sameJson(a: StyleValue | undefined, b: StyleValue | undefined): boolean {
    return JSON.stringify(a ?? null) === JSON.stringify(b ?? null);
}

/** Planes that pass through a crosshair are moved by moving that; others, and other keys, by their own value. */
function useKeyValue(spec: StyleKey, cell: CellState): { value: StyleValue | undefined; patchOf: (next: StyleValue) => StylePatch } {
    const live = useSelect((state) => state.page.live[cell.cell]);
    const shown = (key: string): StyleValue | undefined => live?.[key] ?? cell.style[key]?.value;
    const own = shown(spec.name) ?? spec.default;
    if (spec.name !== "plane.position") return { value: own, patchOf: (next) => ({ [spec.name]: next }) };
    return {
        value: positionOfPlane(cell, shown) ?? own,
        patchOf: (next) => (typeof next === "number" && planeMovedTo(cell, shown, next)) || { [spec.name]: next },
    };
}

function KeyRow({ spec, cell }: { spec: StyleKey; cell: CellState }) {
    const app = useApp();
    const { value, patchOf } = useKeyValue(spec, cell);
    const resolved = cell.style[spec.name];
    const origin = resolved?.origin ?? "default";
    const overridden = origin !== "default" && origin !== "sheet";
    const id = `key-${spec.name.replaceAll(".", "-")}`;
    const changed = origin !== "default";
    return (
        <div class={`key-row ${overridden ? "overridden" : ""} ${isWide(spec) ? "wide" : ""}`} data-key={spec.name} data-origin={origin}>
            <label for={id} title={`${spec.name}${spec.unit ? ` (${spec.unit})` : ""}: ${spec.doc ?? ""}`}>
                {keyLabel(spec.name, spec.group)}
            </label>
            <KeyControl
                id={id}
                spec={spec}
                value={value}
                set={(next) => {
                    const patch = patchOf(next);
                    const changes = Object.entries(patch).some(([key, each]) => !sameJson(each, cell.style[key]?.value));
                    if (changes || app.styles.targets().length > 1) void app.styles.set(patch);
                    else app.styles.cancelPreview();
                }}
                preview={(next) => app.styles.preview(patchOf(next))}
                nudge={(next) => app.keyEdits.show(spec.name, app.styles.targets(), patchOf(next))}
            />
            <span class={`origin origin-${origin}`} title={`This value comes from: ${originLabel(origin, cell.cell)}`}>
                {originLabel(origin, cell.cell)}
            </span>
            {changed ? (
                <IconButton
                    icon={RotateCcw}
                    class="small reset"
                    label={`Reset ${spec.name} of the ${originLabel(origin, cell.cell)} to inherited`}
                    onClick={() => void app.styles.reset(spec.name, origin, cell.cell)}
                />
            ) : (
                <span />
            )}
            <Menu
                class="small"
                label={`Apply ${spec.name} to …`}
                items={scopesOf(app.store.get().page.selection).map((scope) => ({
                    label: `Apply to ${app.styles.targets(scope).map(targetLabel).slice(0, 3).join(", ")}`,
                    onChoose: () => void app.styles.setAtScope(scope, patchOf(value ?? null)),
                }))}
            >
                <EllipsisVertical size={14} aria-hidden="true" />
            </Menu>
        </div>
    );
}

/** Groups that most edits never touch start closed. */
const closedGroups = /camera|sampling|quality|advanced/i;

function Group({ name, keys, cell }: { name: string; keys: StyleKey[]; cell: CellState }) {
    const [open, setOpen] = useState(!closedGroups.test(name));
    const overrides = keys.filter((key) => {
        const origin = cell.style[key.name]?.origin ?? "default";
        return origin !== "default" && origin !== "sheet";
    }).length;
    const has = (key: string): boolean => keys.some(({ name: each }) => each === key);
    const isosurface = cell.style["technique"]?.value === "isosurface";
    return (
        <section class="key-group" data-group={name}>
            <h3>
                <button type="button" aria-expanded={open} onClick={() => setOpen(!open)}>
                    {name}
                    {overrides > 0 && <small title="Values that stand above the sheet's">{overrides} own</small>}
                </button>
            </h3>
            {open && has("isovalue") && isosurface && <IsovalueEditor cell={cell} />}
            {open && has("clip.planes") && <ClipTools />}
            {open && has("light.direction") && <LightBall cell={cell} />}
            {open && has("transfer.opacity") && !isosurface && <TransferEditor cell={cell} />}
            {open && has("range.mode") && cell.state === "ok" && <RangeTools cell={cell} />}
            {open && keys.map((key) => <KeyRow key={key.name} spec={key} cell={cell} />)}
        </section>
    );
}

export function Inspector() {
    const app = useApp();
    const open = useSelect((state) => state.page.inspector);
    const title = useSelect((state) => describeSelection(state.page.selection));
    const keys = useSelect((state) => state.connection.keys);
    const cells = useSelect((state) => state.page.selection.kind === "cells");
    const cell = useSelect((state) => {
        const sheet = currentSheet(state.book);
        const { active } = state.page.selection;
        const exact = cellOf(sheet, formatAddress(active));
        if (exact && exact.state !== "empty") return exact;
        // A header's own first cell may be empty; any drawn cell of the sheet then shows what applies.
        return exact ?? sheet?.cells[0];
    });
    if (!open) return null;
    return (
        <aside class="panel inspector" aria-label="Inspector">
            <div class="panel-head">
                <h2>{title}</h2>
                <IconButton
                    icon={X}
                    label="Close"
                    class="phone-only"
                    onClick={() => app.store.dispatch({ type: "page/inspector", open: false })}
                />
            </div>
            <ScopeChooser />
            <HiddenMessage />
            <div class="key-groups">
                {cell && <PresetRow />}
                {cells && cell && cell.state !== "empty" && <TitleField cell={cell} />}
                {cell && groupKeys(keys, cell).map((group) => <Group key={group.name} name={group.name} keys={group.keys} cell={cell} />)}
                {!cell && <p class="hint">Nothing to set yet.</p>}
            </div>
        </aside>
    );
}
