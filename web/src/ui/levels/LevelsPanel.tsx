// Levels of detail and the time-N curve, under the sheet: what is drawn how finely, why, and how long it takes.
import { Timer, X } from "lucide-preact";
import type { LevelSettings } from "../../api/levels";
import { policyLimits, policyWords } from "../../model/levels";
import { useApp, useSelect } from "../app_context";
import { IconButton } from "../IconButton";
import { TextField } from "../TextField";
import { TimeNPlot } from "./TimeNPlot";

function PolicyChooser({ settings }: { settings: LevelSettings }) {
    const app = useApp();
    const words = policyWords[settings.policy];
    const limit = policyLimits[settings.policy];
    return (
        <div class="level-policy">
            <label for="level-policy">Levels</label>
            <select id="level-policy" value={settings.policy} onChange={(event) => void app.levels.choose({ policy: event.currentTarget.value })}>
                {settings.policies.map((policy) => (
                    <option key={policy} value={policy}>
                        {policyWords[policy]?.label ?? policy}
                    </option>
                ))}
            </select>
            {limit && (
                <>
                    <label for="level-limit">{limit.unit}</label>
                    <TextField
                        id="level-limit"
                        numeric
                        value={String(Number((settings[limit.member] / limit.scale).toPrecision(6)))}
                        set={(text) => void app.levels.choose({ [limit.member]: Number(text) * limit.scale })}
                    />
                </>
            )}
            <p class="hint">{words?.doc}</p>
        </div>
    );
}

function OneClick({ settings }: { settings: LevelSettings }) {
    const app = useApp();
    const slope = settings.policy === "slope";
    return (
        <button type="button" class="text-button" aria-pressed={slope} onClick={() => void app.levels.choose({ policy: slope ? "focus" : "slope" })}>
            {slope ? "Back to a level per cell" : "Use the slope rule for all cells"}
        </button>
    );
}

/** The workbook's own policy can be given up for the one that the server was started with. */
function ServersOwn({ settings }: { settings: LevelSettings }) {
    const app = useApp();
    if (settings.from === "server") return null;
    return (
        <button type="button" class="text-button" title="The policy is kept in the workbook; without one, the server's --dr holds" onClick={() => void app.levels.choose({ policy: null })}>
            Reset to the server's policy
        </button>
    );
}

export function LevelsPanel() {
    const app = useApp();
    const { open, timings, measuring } = useSelect((state) => state.levels);
    if (!open) return null;
    return (
        <section class="levels-panel" aria-label="Levels of detail and timings" onKeyDown={(event) => event.key === "Escape" && app.levels.toggle()}>
            <div class="panel-head">
                <h2>Levels and timings</h2>
                <IconButton
                    icon={Timer}
                    label={measuring ? "Measuring …" : "Measure T_N now"}
                    text={measuring ? "Measuring …" : "Measure now"}
                    disabled={measuring}
                    onClick={() => void app.levels.measure()}
                />
                <IconButton icon={X} label="Close levels and timings" onClick={() => app.levels.toggle()} />
            </div>
            {timings ? (
                <div class="levels-body">
                    <TimeNPlot points={timings.points} />
                    <div class="levels-side">
                        <PolicyChooser settings={timings.settings} />
                        <OneClick settings={timings.settings} />
                        <ServersOwn settings={timings.settings} />
                        <p class="levels-reason" data-policy={timings.policy}>
                            {timings.shown} cells on show, coarsest level {timings.level}: {timings.reason}. Times are for tiles of 256 × 256 pixels.
                        </p>
                    </div>
                </div>
            ) : (
                <p class="hint">Loading …</p>
            )}
        </section>
    );
}
