// One quiet line: device, what is drawn, how fast, how full, and whether the server is there.
import { ChartLine, Cpu, Wifi, WifiOff } from "lucide-preact";
import { formatMs, formatNumber } from "../model/format";
import type { ConnectionPhase } from "../state/connection";
import { useApp, useSelect } from "./app_context";

const phases: Record<ConnectionPhase, string> = {
    connecting: "connecting …",
    live: "connected",
    lost: "connection lost, trying again …",
    paused: "paused while hidden",
    refused: "not allowed",
};

function megabytes(bytes: number): string {
    return String(Math.round(bytes / 1e6));
}

function Connection() {
    const phase = useSelect((state) => state.connection.phase);
    const restored = useSelect((state) => state.connection.openings > 1);
    const message = useSelect((state) => state.connection.message);
    const latency = useSelect((state) => state.connection.latencyMs);
    const live = phase === "live";
    return (
        <span class={`connection ${live ? "" : "connection-bad"}`} role="status" data-phase={phase} title={message}>
            {live ? <Wifi size={14} aria-hidden="true" /> : <WifiOff size={14} aria-hidden="true" />}
            {live && latency !== null ? `${formatMs(latency)} to server` : phases[phase]}
            {live && restored && <span class="visually-hidden">connection restored</span>}
        </span>
    );
}

/** The coarsest level of the last frame; opens the panel that says why. */
function LevelButton({ level }: { level: number }) {
    const app = useApp();
    const open = useSelect((state) => state.levels.open);
    return (
        <button
            type="button"
            class="status-button"
            aria-expanded={open}
            title="Coarsest level of detail of the last frame. Click for levels, timings and the policy"
            onClick={() => app.levels.toggle()}
        >
            <ChartLine size={14} aria-hidden="true" /> level {level}
        </button>
    );
}

export function StatusBar() {
    const device = useSelect((state) => state.connection.info?.device ?? null);
    const version = useSelect((state) => state.connection.info?.version ?? "");
    const status = useSelect((state) => state.connection.status);
    const world = useSelect((state) => state.page.probe?.world ?? null);
    return (
        <footer class="status-bar">
            {device && (
                <span class="device" title={[device.vendor, device.version, device.reason].filter(Boolean).join("\n")}>
                    <Cpu size={14} aria-hidden="true" /> {device.renderer}
                </span>
            )}
            {status && (
                <>
                    <span data-status="final">
                        {status.finalCells} of {status.cells} cells final
                    </span>
                    <span title="Time that the last whole frame took to draw">
                        T<sub>N</sub> {formatMs(status.frameMs)}
                    </span>
                    <LevelButton level={status.level} />
                    <span title="Textures on the device, of its budget">
                        textures {megabytes(status.residentBytes)} of {megabytes(status.budgetBytes)} MB
                    </span>
                </>
            )}
            {world && <span class="world">({world.map((part) => formatNumber(part)).join(", ")})</span>}
            <span class="spacer" />
            <Connection />
            <span title="Version of the server">{version && `v${version}`}</span>
        </footer>
    );
}
