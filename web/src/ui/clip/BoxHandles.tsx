// The clip box on a picture: its edges, and a handle on each face.
import type { BoxRow } from "../../model/clip/clip";
import { clipBoxInWorld, facePart, facePath, withFace } from "../../model/clip/clip_box";
import { formatNumber } from "../../model/format";
import { followPath, toPixel } from "../../model/projection";
import type { HandlesContext } from "./ClipHandles";
import { Handle, HandleDisc } from "./Handle";
import { boxPath } from "./outline";

const faceNames = ["x, low", "x, high", "y, low", "y, high", "z, low", "z, high"];

export function BoxHandles({ context, row }: { context: HandlesContext; row: BoxRow }) {
    const { view, box, clip } = context;
    const patch = (next: BoxRow) => ({ "clip.box": [...next] });
    return (
        <g>
            <path class="clip-outline" d={boxPath(view, clipBoxInWorld(row, clip.units, box))} />
            {faceNames.map((name, face) => {
                const path = facePath(row, face, clip.units, box);
                const part = facePart(row, face, clip.units, box);
                const disc = toPixel(view, path(part));
                if (!disc) return null;
                const moved = (to: number) => patch(withFace(row, face, Math.min(1, Math.max(0, to)), clip.units, box));
                return (
                    <Handle
                        key={name}
                        cell={context.cell}
                        styleKey="clip.box"
                        reachable={context.reachable}
                        name={`box-${face}`}
                        label={`Clip box, face ${name}: drag to move it; arrow keys; Delete removes the box`}
                        now={Number(part.toFixed(4))}
                        text={formatNumber(row[face])}
                        drag={(pressed) => {
                            const follow = followPath(view, path, part, pressed);
                            return (pointer) => moved(follow(pointer));
                        }}
                        keys={({ x, y }) => moved(part + x + y)}
                        remove={() => ({ "clip.box": "none" })}
                    >
                        <HandleDisc at={disc} mark="square" />
                    </Handle>
                );
            })}
        </g>
    );
}
