// Pictures for the mock server: a tumbling box of points as PNG, so that one sees what a camera does.
import { deflateSync, crc32 as zlibCrc32 } from "node:zlib";

const crcTable = Uint32Array.from({ length: 256 }, (_, n) => {
    let c = n;
    for (let k = 0; k < 8; ++k) c = c & 1 ? 0xedb88320 ^ (c >>> 1) : c >>> 1;
    return c >>> 0;
});

function crc32(bytes) {
    if (zlibCrc32) return zlibCrc32(bytes);
    let crc = 0xffffffff;
    for (const byte of bytes) crc = crcTable[(crc ^ byte) & 255] ^ (crc >>> 8);
    return (crc ^ 0xffffffff) >>> 0;
}

function chunk(type, data) {
    const body = Buffer.concat([Buffer.from(type, "latin1"), data]);
    const out = Buffer.alloc(body.length + 8);
    out.writeUInt32BE(data.length, 0);
    body.copy(out, 4);
    out.writeUInt32BE(crc32(body), body.length + 4);
    return out;
}

function png(width, height, rgb) {
    const header = Buffer.alloc(13);
    header.writeUInt32BE(width, 0);
    header.writeUInt32BE(height, 4);
    header.set([8, 2, 0, 0, 0], 8);
    const lines = Buffer.alloc(height * (1 + 3 * width));
    for (let y = 0; y < height; ++y) rgb.copy(lines, y * (1 + 3 * width) + 1, y * 3 * width, (y + 1) * 3 * width);
    return Buffer.concat([
        Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]),
        chunk("IHDR", header),
        chunk("IDAT", deflateSync(lines, { level: 1 })),
        chunk("IEND", Buffer.alloc(0)),
    ]);
}

function basis(style) {
    const rad = Math.PI / 180;
    const az = style["camera.azimuth"] * rad;
    const el = style["camera.elevation"] * rad;
    const roll = style["camera.roll"] * rad;
    const eye = [Math.cos(el) * Math.sin(az), -Math.cos(el) * Math.cos(az), Math.sin(el)];
    const level = [Math.cos(az), Math.sin(az), 0];
    const upright = [
        eye[1] * level[2] - eye[2] * level[1],
        eye[2] * level[0] - eye[0] * level[2],
        eye[0] * level[1] - eye[1] * level[0],
    ];
    const mix = (a, b, c, s) => a.map((value, i) => c * value + s * b[i]);
    return {
        right: mix(level, upright, Math.cos(roll), -Math.sin(roll)),
        up: mix(upright, level, Math.cos(roll), Math.sin(roll)),
        eye,
    };
}

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** style: resolved plain values; seed: which cell; gain: overall opacity. */
export function picture(width, height, style, seed, stops, gain) {
    const rgb = Buffer.alloc(width * height * 3);
    for (let i = 0; i < rgb.length; i += 3) rgb.set([0x10, 0x13, 0x16], i);
    const { right, up, eye } = basis(style);
    const scale = height / (2 * style["camera.distance"] * Math.tan((style["camera.fov"] * Math.PI) / 360));
    const target = style["camera.target"];
    const steps = 26;
    const radius = Math.max(1, Math.round(scale / steps / 1.6));
    for (let i = 0; i <= steps; ++i) {
        for (let j = 0; j <= steps; ++j) {
            for (let k = 0; k <= steps; ++k) {
                const p = [i, j, k].map((n) => (2 * n) / steps - 1).map((v, n) => 0.577 * v - 0 * n);
                const wave = Math.sin((4 + seed) * p[0]) * Math.cos((5 + 0.5 * seed) * p[1]) * Math.sin(4 * p[2] + seed);
                const value = 0.5 + 0.5 * wave;
                if (value < 0.62) continue;
                const q = p.map((v, n) => v - target[n]);
                const x = Math.round(width / 2 + scale * dot(q, right));
                const y = Math.round(height / 2 - scale * dot(q, up));
                const light = 0.5 + 0.5 * (dot(q, eye) / 1.2);
                const stop = stops[Math.min(stops.length - 1, Math.floor(value * stops.length))];
                for (let dy = 0; dy < radius; ++dy) {
                    for (let dx = 0; dx < radius; ++dx) {
                        const px = x + dx;
                        const py = y + dy;
                        if (px < 0 || py < 0 || px >= width || py >= height) continue;
                        const at = 3 * (py * width + px);
                        for (let c = 0; c < 3; ++c) {
                            const colour = 255 * stop[c + 1] * (0.4 + 0.6 * light);
                            rgb[at + c] += Math.round((colour - rgb[at + c]) * Math.min(1, 0.5 * gain));
                        }
                    }
                }
            }
        }
    }
    return png(width, height, rgb);
}
