// Small volumes written as NRRD files: a soft ball whose place tells the files apart.
import { writeFile } from "node:fs/promises";

/** Bytes of an n^3 8-bit NRRD; centre in parts of the box. */
export function ball(n, centre, radius = 0.3) {
    const header = `NRRD0004\ntype: uint8\ndimension: 3\nsizes: ${n} ${n} ${n}\nspacings: 1 1 1\nencoding: raw\n\n`;
    const data = Buffer.alloc(n * n * n);
    let at = 0;
    for (let z = 0; z < n; ++z) {
        for (let y = 0; y < n; ++y) {
            for (let x = 0; x < n; ++x) {
                const squared = ((x / n - centre[0]) ** 2 + (y / n - centre[1]) ** 2 + (z / n - centre[2]) ** 2) / radius ** 2;
                data[at++] = Math.round(255 * Math.exp(-squared));
            }
        }
    }
    return Buffer.concat([Buffer.from(header, "latin1"), data]);
}

/** A header that promises far more than there is. */
export function truncated() {
    return Buffer.from("NRRD0004\ntype: uint8\ndimension: 3\nsizes: 64 64 64\nencoding: raw\n\nshort", "latin1");
}

export async function writeBalls(folder, count, n) {
    const files = [];
    for (let i = 0; i < count; ++i) {
        const turn = (2 * Math.PI * i) / Math.max(1, count);
        const file = `${folder}/ball${i + 1}.nrrd`;
        await writeFile(file, ball(n, [0.5 + 0.2 * Math.cos(turn), 0.5 + 0.2 * Math.sin(turn), 0.35 + 0.05 * i]));
        files.push(file);
    }
    return files;
}
