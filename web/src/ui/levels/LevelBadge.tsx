// A cell's level of detail on its title strip, only while it is not 0; its menu pins a level.
import { Pin } from "lucide-preact";
import { cellOf, currentSheet } from "../../state/book";
import { newTile } from "../../state/tiles";
import { useApp, useSelect } from "../app_context";
import { Menu, type MenuItem } from "../Menu";

const levelsOffered = 5;

export function LevelBadge({ cell }: { cell: string }) {
    const app = useApp();
    const level = useSelect((state) => state.tiles[cell]?.level ?? newTile.level);
    const pinned = useSelect((state) => {
        const value = cellOf(currentSheet(state.book), cell)?.style["level"]?.value;
        return typeof value === "number" ? value : null;
    });
    if (level === 0 && pinned === null) return null;
    const items: MenuItem[] = [
        { label: "By policy", hint: pinned === null ? "now" : "", onChoose: () => void app.levels.pin(cell, null) },
        ...Array.from({ length: levelsOffered }, (_, each) => ({
            label: each === 0 ? "Pin level 0 (every voxel)" : `Pin level ${each}`,
            hint: pinned === each ? "now" : "",
            onChoose: () => void app.levels.pin(cell, each),
        })),
        { label: "Levels and timings …", onChoose: () => app.levels.show() },
    ];
    const why = pinned !== null ? "pinned" : "chosen by the sheet's policy";
    return (
        <Menu class="level-badge" label={`Level of detail of ${cell}: ${level}, ${why}`} items={items}>
            <span data-level={level}>
                {pinned !== null && <Pin size={10} aria-hidden="true" />} <i class="level-word">level </i>
                {level}
            </span>
        </Menu>
    );
}
