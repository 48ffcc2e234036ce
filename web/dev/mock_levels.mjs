// Levels of detail and the time-N curve of the mock: a line with a bend where textures would begin to be swapped.

const bendAfter = 6;
const msPerCell = 12;

export class Levels {
    settings = {
        policy: "focus", frame_ms: 1000, frames_per_second: 1, datasets: 25, bytes: 1_073_741_824, up_fraction: 0.8,
        policies: ["off", "focus", "slope", "slope-first", "time", "rate", "count", "bytes"],
        from: "server",
    };

    /** The error's field and sentence, or null when the settings were taken. */
    change(patch) {
        if (patch.policy === null) {
            this.settings = new Levels().settings;
            return null;
        }
        for (const [name, value] of Object.entries(patch)) {
            if (!(name in this.settings) || name === "policies" || name === "from") return { field: name, detail: `There is no member ${name}; leave it out.` };
            if (name === "policy" ? !this.settings.policies.includes(value) : !(value > 0)) return { field: name, detail: `${name} cannot be ${value}; give a value above 0, or one of the policies.` };
        }
        Object.assign(this.settings, patch, { from: "workbook" });
        return null;
    }

    timings(cells) {
        const points = Array.from({ length: cells }, (_, i) => this.point(i + 1));
        const now = points.at(-1);
        return {
            n: cells, shown: cells, level: 0, policy: this.settings.policy, settings: this.settings, reason: `the mock's policy is ${this.settings.policy}`,
            t_n: now?.ms ?? null, t_n_low: now?.ms_low ?? null, t_n_high: now?.ms_high ?? null,
            r_raw: now?.r_raw ?? null, r: now?.r ?? null, r_low: now?.r_low ?? null, r_high: now?.r_high ?? null,
            resident_bytes: now?.resident_bytes ?? 0, budget_bytes: 268_435_456, points,
        };
    }

    point(n) {
        const ms = msPerCell * (n + 2 * Math.max(0, n - bendAfter));
        const r = n < 3 ? null : n === bendAfter + 1 ? 3 : 1;
        return { n, level: 0, ms, ms_low: 0.95 * ms, ms_high: 1.05 * ms, frames: 5, partly: false, r_raw: r, r, r_low: r && 0.9 * r, r_high: r && 1.1 * r, resident_bytes: 25_000_000 * Math.min(n, bendAfter) };
    }
}
