// Adding and removing what clips, and showing its handles on the pictures.
import { Box, Plus, Scissors, Shapes, Trash2 } from "lucide-preact";
import { shapeNames } from "../../model/clip/shape_outline";
import { useApp, useSelect } from "../app_context";
import { IconButton } from "../IconButton";
import { Menu } from "../Menu";

export function ClipTools() {
    const { clips } = useApp();
    const shown = useSelect((state) => state.page.clipHandles);
    return (
        <div class="clip-tools" role="group" aria-label="Clipping">
            <IconButton icon={Plus} text="plane" label="Add a clip plane that faces the viewer" onClick={() => void clips.addPlane()} />
            <IconButton icon={Box} text="box" label="Clip by a box" onClick={() => void clips.addBox()} />
            <Menu
                label="Clip by an object"
                align="left"
                items={shapeNames.map((shape) => ({ label: shape, onChoose: () => void clips.addObject(shape) }))}
            >
                <Shapes size={16} aria-hidden="true" />
                <span>object</span>
            </Menu>
            <span class="spacer" />
            <IconButton icon={Trash2} label="Remove all clipping" onClick={() => void clips.removeAll()} />
            <IconButton
                icon={Scissors}
                label={shown ? "Hide the handles on the pictures" : "Show handles on the pictures"}
                keys="c"
                pressed={shown}
                onClick={() => clips.toggleHandles()}
            />
        </div>
    );
}
