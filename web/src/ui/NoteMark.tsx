// A quiet mark on a cell's title strip when the server has something to say about its picture.
import { Info } from "lucide-preact";
import { useSelect } from "./app_context";

export function NoteMark({ cell }: { cell: string }) {
    const note = useSelect((state) => state.tiles[cell]?.note ?? "");
    if (!note) return null;
    return (
        <span class="badge note-mark" role="note" data-note-of={cell} title={note} aria-label={`Note on ${cell}: ${note}`}>
            <Info size={12} aria-hidden="true" />
        </span>
    );
}
