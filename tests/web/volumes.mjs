// Small volumes written as NRRD files: a soft ball whose place tells the files apart.
import { writeFile } from "node:fs/promises";

/** Bytes of an n^3 8-bit NRRD; centre in parts of the box. */
export function ball(n, centre, radius = 0.3) {
    const header = `NRRD0004\ntype: uint8\ndimension: 3\nsizes: ${n} ${n} ${n}\nspacings: 1 1 1\nencoding: raw\n\n`;
    const data = Buffer.alloc(n * n * n);
    // A bell curve along each axis, multiplied: an exponential for each voxel would take minutes for large sheets.
    const curve = (middle) => Float64Array.from({ length: n }, (_, i) => Math.exp(-(((i / n - middle) / radius) ** 2)));
    const [alongX, alongY, alongZ] = centre.map(curve);
    let at = 0;
    for (let z = 0; z < n; ++z) {
        for (let y = 0; y < n; ++y) {
            const row = 255 * alongZ[z] * alongY[y];
            for (let x = 0; x < n; ++x) data[at++] = Math.round(row * alongX[x]);
        }
    }
    return Buffer.concat([Buffer.from(header, "latin1"), data]);
}

/** Bytes of an n^3 32-bit float NRRD with values of both signs: a soft ball of +1 and, on the other side, one of -1. */
export function twoSigns(n) {
    const header = `NRRD0004\ntype: float\nendian: little\ndimension: 3\nsizes: ${n} ${n} ${n}\nspacings: 1 1 1\nencoding: raw\n\n`;
    const data = Buffer.alloc(4 * n * n * n);
    const soft = (x, y, z, centre) => Math.exp(-((x - centre) ** 2 + (y - 0.5) ** 2 + (z - 0.5) ** 2) / 0.15 ** 2);
    let at = 0;
    for (let z = 0; z < n; ++z) {
        for (let y = 0; y < n; ++y) {
            for (let x = 0; x < n; ++x) {
                const value = soft(x / n, y / n, z / n, 0.7) - soft(x / n, y / n, z / n, 0.3);
                at = data.writeFloatLE(value, at);
            }
        }
    }
    return Buffer.concat([Buffer.from(header, "latin1"), data]);
}

/** Bytes of an 8^3 8-bit NRRD of two time steps: 10 x, and 100 more in the second. */
export function twoSteps() {
    const header = `NRRD0004\ntype: uint8\ndimension: 4\nsizes: 8 8 8 2\nkinds: domain domain domain time\nspacings: 1 1 1 1\nencoding: raw\n\n`;
    const data = Buffer.alloc(2 * 512, 0).map((_, at) => 10 * (at % 8) + (at < 512 ? 0 : 100));
    return Buffer.concat([Buffer.from(header, "latin1"), data]);
}

/** A header that promises far more than there is. */
export function truncated() {
    return Buffer.from("NRRD0004\ntype: uint8\ndimension: 3\nsizes: 64 64 64\nencoding: raw\n\nshort", "latin1");
}

/** No two balls in one place, and all within the box. \param spread  how far from the middle they stand, in parts of the box */
export async function writeBalls(folder, count, n, spread = 0.2) {
    const files = [];
    const rise = Math.min(0.05, 0.4 / Math.max(1, count - 1));
    for (let i = 0; i < count; ++i) {
        const turn = (2 * Math.PI * i) / Math.max(1, count);
        const file = `${folder}/ball${i + 1}.nrrd`;
        await writeFile(file, ball(n, [0.5 + spread * Math.cos(turn), 0.5 + spread * Math.sin(turn), 0.35 + rise * i]));
        files.push(file);
    }
    return files;
}

/** Bytes of an uncompressed 8-bit grey TIFF of n x n pixels: a soft disc of brightness `peak`. */
export function discTiff(n, peak) {
    const entries = [[256, n], [257, n], [258, 8], [259, 1], [262, 1], [273, 8], [277, 1], [278, n], [279, n * n]];
    const bytes = Buffer.alloc(8 + n * n + 2 + 12 * entries.length + 4);
    bytes.write("II*\0", 0, "latin1");
    bytes.writeUInt32LE(8 + n * n, 4);
    for (let i = 0; i < n * n; ++i) {
        const squared = (((i % n) / n - 0.5) ** 2 + (Math.floor(i / n) / n - 0.5) ** 2) / 0.3 ** 2;
        bytes[8 + i] = Math.round(peak * Math.exp(-squared));
    }
    let at = bytes.writeUInt16LE(entries.length, 8 + n * n);
    for (const [tag, value] of entries) {
        at = bytes.writeUInt16LE(tag, at);
        at = bytes.writeUInt16LE(4, at); // LONG
        at = bytes.writeUInt32LE(1, at);
        at = bytes.writeUInt32LE(value, at);
    }
    return bytes;
}
