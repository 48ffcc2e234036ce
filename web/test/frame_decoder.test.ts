import assert from "node:assert/strict";
import { test } from "node:test";
import { FrameDecoder } from "../src/stream/frame_decoder";
import { PaintStatistics } from "../src/stream/paint_statistics";

function frame(header: object, payload: number[] = []): Uint8Array {
    const text = new TextEncoder().encode(JSON.stringify(header));
    const bytes = new Uint8Array(8 + text.length + payload.length);
    const view = new DataView(bytes.buffer);
    view.setUint32(0, text.length, true);
    view.setUint32(4, payload.length, true);
    bytes.set(text, 8);
    bytes.set(payload, 8 + text.length);
    return bytes;
}

const stream = (): Uint8Array => {
    const parts = [frame({ type: "hello", stream: "é" }), frame({ type: "tile", seq: 1 }, [1, 2, 3]), frame({ type: "ping" })];
    const bytes = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
    let at = 0;
    for (const part of parts) {
        bytes.set(part, at);
        at += part.length;
    }
    return bytes;
};

test("messages come out whole, however the bytes are cut", () => {
    const bytes = stream();
    for (let size = 1; size <= bytes.length; ++size) {
        const decoder = new FrameDecoder();
        const messages = [];
        for (let at = 0; at < bytes.length; at += size) messages.push(...decoder.push(bytes.slice(at, at + size)));
        assert.deepEqual(messages.map((message) => message.header.type), ["hello", "tile", "ping"], `pieces of ${size}`);
        assert.deepEqual([...messages[1]!.payload], [1, 2, 3]);
        assert.equal(messages[0]!.header["stream"], "é");
    }
});

test("bytes that cannot be the format are refused", () => {
    assert.throws(() => new FrameDecoder().push(new Uint8Array(16).fill(255)));
    assert.throws(() => new FrameDecoder().push(frame([1, 2])));
});

test("statistics notice tiles out of order and count distinct frames", () => {
    const statistics = new PaintStatistics();
    const paint = { frame: 1, cell: "A1", level: 0, scale: 1, final: true, format: "png", bytes: 10 };
    statistics.add({ ...paint, seq: 1, at: 5 });
    statistics.add({ ...paint, seq: 2, at: 6 });
    statistics.add({ ...paint, seq: 3, frame: 2, at: 7 });
    assert.equal(statistics.framesSince(0), 2);
    assert.equal(statistics.framesSince(7), 1);
    assert.equal(statistics.outOfOrder, 0);
    statistics.add({ ...paint, seq: 3, at: 8 });
    assert.equal(statistics.outOfOrder, 1);
});
