// A line in the list of the server's files: a folder, a file, or a numbered series of files.
import { ChevronDown, ChevronRight, File as FileIcon, Files, Folder } from "lucide-preact";
import { useRef } from "preact/hooks";
import type { FileRow } from "../model/file_choice";
import { formatBytes } from "../model/format";
import { IconButton } from "./IconButton";

interface Props {
    row: FileRow;
    checked: boolean;
    expanded: boolean;
    /** extend: from the last one on, as with Shift. */
    onChoose: (extend: boolean) => void;
    onEnter: () => void;
    onExpand: () => void;
    onLook: () => void;
}

export function FileLine({ row, checked, expanded, onChoose, onEnter, onExpand, onLook }: Props) {
    const { entry } = row;
    const withShift = useRef(false);
    const press = (event: PointerEvent): void => void (withShift.current = event.shiftKey);
    if (entry.kind === "folder") {
        return (
            <li>
                <button type="button" class="file-entry" data-row={row.key} onClick={onEnter} title={entry.path}>
                    <Folder size={14} aria-hidden="true" /> <span>{entry.name}</span>
                </button>
            </li>
        );
    }
    const series = row.files.length > 1;
    const choose = (): void => {
        onChoose(withShift.current);
        withShift.current = false;
    };
    return (
        <li class={row.member ? "file-member" : undefined}>
            <label class="file-entry" data-chosen={checked} title={entry.path} onPointerDown={press} onPointerEnter={onLook} onFocusCapture={onLook}>
                <input type="checkbox" data-row={row.key} checked={checked} onChange={choose} />
                {series ? <Files size={14} aria-hidden="true" /> : <FileIcon size={14} aria-hidden="true" />}
                <span>{entry.name}</span>
                {series && <small>{row.files.length} files</small>}
                <small>{entry.format ?? ""}</small>
                <small>{formatBytes(entry.bytes)}</small>
            </label>
            {series && <IconButton icon={expanded ? ChevronDown : ChevronRight} label={expanded ? "Hide its files" : "Show its files"} onClick={onExpand} />}
        </li>
    );
}
