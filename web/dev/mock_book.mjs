// The mock server's workbook: datasets, styles in layers, undo. Enough for the page, no more.

const ramp = (from, to) => Array.from({ length: 9 }, (_, i) => [i / 8, ...from.map((v, c) => v + ((to[c] - v) * i) / 8)]);

export const maps = [
    { name: "viridis", label: "Viridis", kind: "sequential", stops: [[0, 0.27, 0, 0.33], [0.25, 0.23, 0.32, 0.55], [0.5, 0.13, 0.57, 0.55], [0.75, 0.37, 0.79, 0.38], [1, 0.99, 0.91, 0.14]] },
    { name: "grey", label: "Grey", kind: "sequential", stops: ramp([0, 0, 0], [1, 1, 1]) },
    { name: "cool-warm", label: "Cool–warm", kind: "diverging", pivot: 0.5, stops: [[0, 0.23, 0.3, 0.75], [0.5, 0.86, 0.86, 0.86], [1, 0.7, 0.02, 0.15]] },
];

const number = (name, group, min, max, initial, unit = "", extra = {}) => ({ name, type: "number", group, min, max, default: initial, unit, widget: "slider", doc: `${name}.`, ...extra });
const choice = (name, group, choices, initial, extra = {}) => ({ name, type: "choice", group, choices, default: initial, widget: "select", doc: `${name}.`, ...extra });

export const keys = [
    choice("technique", "Technique", ["slices", "raycast", "mip"], "raycast"),
    choice("transfer.map", "Transfer function", maps.map((map) => map.name), "viridis"),
    { name: "transfer.opacity", type: "opacityPoints", group: "Transfer function", default: "auto", takesAuto: true, widget: "curve", doc: "Opacity points." },
    choice("transfer.shape", "Transfer function", ["piecewise", "linear", "exponential", "parabolic"], "piecewise"),
    number("transfer.cut1", "Transfer function", 0, 1, 0.25, "of the range", { appliesWhen: { key: "transfer.shape", values: ["linear", "exponential", "parabolic"] } }),
    { name: "transfer.nanColor", type: "colour", group: "Transfer function", default: "transparent", widget: "swatch", doc: "Absent samples." },
    choice("range.mode", "Range", ["auto", "own", "shared", "fixed", "percentile", "symmetric"], "auto"),
    number("range.min", "Range", -1e300, 1e300, "none", "", { widget: "number", takesNone: true, appliesWhen: { key: "range.mode", values: ["fixed", "percentile"] } }),
    number("range.max", "Range", -1e300, 1e300, "none", "", { widget: "number", takesNone: true, appliesWhen: { key: "range.mode", values: ["fixed", "percentile"] } }),
    choice("range.scale", "Range", ["linear", "log", "symlog"], "linear"),
    number("sampling.distance", "Picture", 0.05, 64, 0.5, "voxels"),
    { name: "background", type: "colour", group: "Picture", default: "#101316", widget: "swatch", doc: "Behind the volume." },
    choice("annotations", "Picture", ["none", "names", "all"], "all"),
    { name: "field", type: "fieldName", group: "Data", default: 0, widget: "text", doc: "Field." },
    { name: "time", type: "integer", group: "Data", min: 0, max: 1e6, default: 0, widget: "slider", doc: "Step." },
    number("camera.azimuth", "Camera", -36000, 36000, 150, "degrees"),
    number("camera.elevation", "Camera", -90, 90, 20, "degrees"),
    number("camera.roll", "Camera", -36000, 36000, 0, "degrees"),
    number("camera.distance", "Camera", 0.001, 1000, 3.9, "bounding radii"),
    { name: "camera.target", type: "vector3", group: "Camera", min: -100, max: 100, default: [0, 0, 0], widget: "vector", unit: "bounding radii", doc: "Point looked at." },
    number("camera.fov", "Camera", 1, 150, 30, "degrees"),
    choice("camera.projection", "Camera", ["perspective", "orthographic"], "perspective"),
];

export const columnName = (column) => String.fromCharCode(65 + column);
const layersOf = (cell) => [["cell", cell], ["row", cell.slice(1)], ["column", cell[0]], ["sheet", ""]];

export class Book {
    constructor(names, columns) {
        this.doc = { version: 1, columns, rows: Math.ceil(names.length / columns), sources: {}, styles: {} };
        names.forEach((name, i) => (this.doc.sources[this.address(i)] = name));
        this.past = [];
        this.future = [];
        this.gesture = "";
    }

    address(i) {
        return columnName(i % this.doc.columns) + (Math.floor(i / this.doc.columns) + 1);
    }

    edit(gesture, change) {
        if (!gesture || gesture !== this.gesture) this.past.push(structuredClone(this.doc));
        this.gesture = gesture;
        this.future = [];
        change(this.doc);
        ++this.doc.version;
    }

    travel(from, to) {
        const next = from.pop();
        if (!next) return;
        to.push(structuredClone(this.doc));
        this.doc = { ...next, version: this.doc.version + 1 };
        this.gesture = "";
    }

    resolve(cell) {
        const style = {};
        for (const key of keys) {
            style[key.name] = { value: key.default, origin: "default" };
            for (const [layer, name] of layersOf(cell)) {
                const value = this.doc.styles[`${layer} ${name}`]?.[key.name];
                if (value === undefined) continue;
                style[key.name] = { value, origin: layer };
                break;
            }
        }
        return style;
    }

    patch(layer, name, patch, gesture) {
        this.edit(gesture, (doc) => {
            const own = (doc.styles[`${layer} ${name}`] ??= {});
            for (const [key, value] of Object.entries(patch)) {
                if (value === null) delete own[key];
                else own[key] = value;
            }
        });
        const order = ["sheet", "column", "row", "cell"];
        const hidden = [];
        for (const cell of this.cells()) {
            if (layer === "column" && cell[0] !== name) continue;
            if (layer === "row" && cell.slice(1) !== name) continue;
            if (layer === "cell" && cell !== name) continue;
            for (const key of Object.keys(patch)) {
                const { origin } = this.resolve(cell)[key] ?? { origin: "default" };
                if (order.indexOf(origin) > order.indexOf(layer)) hidden.push({ cell, key, by: origin });
            }
        }
        return { version: this.doc.version, hidden };
    }

    cells() {
        const { rows, columns } = this.doc;
        return Array.from({ length: rows * columns }, (_, i) => this.address(i));
    }
}
