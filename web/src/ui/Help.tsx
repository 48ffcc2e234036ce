// All gestures and keys, beside the sheet rather than over it.
import { X } from "lucide-preact";
import { useEffect, useRef } from "preact/hooks";
import { useApp, useSelect } from "./app_context";
import { IconButton } from "./IconButton";

const gestures: [string, string][] = [
    ["left drag, arrow keys", "turn (linked cells follow); Alt: this cell only"],
    ["right drag, Shift + left drag, Shift + arrows", "pan"],
    ["wheel, pinch, + and −", "zoom to the pointer; on planes with Ctrl or Shift + wheel"],
    ["wheel on a plane, [ and ], Page Up and Down", "step by one voxel, in all cells that share the position; Alt: this cell only"],
    ["p", "axial, coronal and sagittal planes beside the selected cells"],
    ["x; Shift + x", "the crosshair to what lies under the pointer; off"],
    ["click on a plane", "takes the crosshair there, and with it the other planes; Alt: this cell only"],
    ["Ctrl + left drag", "roll"],
    ["r, double-click on the title", "reset the view"],
    ["f", "fit"],
    ["Enter, double-click on a picture; Esc", "enlarge the cell; back"],
    ["z, Shift + z, 0; Ctrl + wheel on a header", "larger tiles, smaller ones (more cells in the window), as many as fit"],
    ["middle drag, w + drag", "window (across) and level (up, down)"],
    ["c", "show or hide the handles of clip planes, box and object"],
    ["drag a clip handle", "move, turn or scale it, in all cells that share it; Alt: this cell only; Esc: as it was"],
    ["Tab to a clip handle, arrow keys", "move by 1 % (Shift: 10 %); Page Up and Down: along the line of sight; Delete: remove"],
    ["Shift + drag the clip object", "move it along the line of sight"],
    ["drag an isovalue on the histogram, arrow keys", "move it; double-click adds one, Delete removes it"],
    ["click, Shift, Ctrl, Shift + arrows on headers and titles", "select cells, rows, columns"],
    ["F2 or =", "edit the formula; a click on a cell puts its address in"],
    ["Tab, Enter, Esc", "accept and go right, accept, cancel"],
    ["Ctrl+Z, Ctrl+Shift+Z", "undo, redo"],
    ["Ctrl+C, Ctrl+X, Ctrl+V, Delete", "copy, cut, paste, empty cells"],
    ["space, comma, full stop", "play, step back, step forward"],
    ["hover", "the value under the pointer, in every cell"],
    ["drop files on the page", "upload them; a .json file is opened as a workbook"],
    ["?", "this help"],
];

export function Help() {
    const { store } = useApp();
    const open = useSelect((state) => state.page.help);
    const panel = useRef<HTMLElement>(null);
    useEffect(() => {
        if (open) panel.current?.focus();
    }, [open]);
    if (!open) return null;
    return (
        <aside class="panel help" aria-label="Help" ref={panel} tabIndex={-1}>
            <div class="panel-head">
                <h2>Gestures and keys</h2>
                <IconButton icon={X} label="Close" keys="Esc" onClick={() => store.dispatch({ type: "page/help", open: false })} />
            </div>
            <table>
                <tbody>
                    {gestures.map(([gesture, effect]) => (
                        <tr key={gesture}>
                            <th scope="row">{gesture}</th>
                            <td>{effect}</td>
                        </tr>
                    ))}
                </tbody>
            </table>
            <p class="hint">
                Values are inherited: cell before row before column before sheet. The inspector shows where each value comes from and
                writes to the layer that is chosen at its top.
            </p>
        </aside>
    );
}
