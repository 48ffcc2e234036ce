// The framing of the picture stream: u32le header bytes, u32le payload bytes, header (UTF-8 JSON), payload.

export interface StreamMessage {
    header: Record<string, unknown> & { type: string };
    payload: Uint8Array;
}

const prefixBytes = 8;
const maxHeaderBytes = 1 << 20;
const maxPayloadBytes = 1 << 28;

/** Takes the stream's bytes in pieces of any size and gives whole messages. */
export class FrameDecoder {
    private chunks: Uint8Array[] = [];
    private buffered = 0;
    private readonly text = new TextDecoder();

    /** Throws if the bytes cannot be this format. */
    push(chunk: Uint8Array): StreamMessage[] {
        this.chunks.push(chunk);
        this.buffered += chunk.byteLength;
        const messages: StreamMessage[] = [];
        for (;;) {
            const length = this.messageBytes();
            if (length === null || this.buffered < length) return messages;
            messages.push(this.parse(this.take(length)));
        }
    }

    private messageBytes(): number | null {
        if (this.buffered < prefixBytes) return null;
        this.joinFirst(prefixBytes);
        const first = this.chunks[0]!;
        const view = new DataView(first.buffer, first.byteOffset, first.byteLength);
        const header = view.getUint32(0, true);
        const payload = view.getUint32(4, true);
        if (header > maxHeaderBytes || payload > maxPayloadBytes) throw new Error("The picture stream is damaged.");
        return prefixBytes + header + payload;
    }

    /** Makes the first chunk at least `length` bytes long. */
    private joinFirst(length: number): void {
        if (this.chunks[0]!.byteLength >= length) return;
        let size = 0;
        let count = 0;
        while (size < length) size += this.chunks[count++]!.byteLength;
        const joined = new Uint8Array(size);
        let at = 0;
        for (const chunk of this.chunks.splice(0, count)) {
            joined.set(chunk, at);
            at += chunk.byteLength;
        }
        this.chunks.unshift(joined);
    }

    private take(length: number): Uint8Array {
        this.joinFirst(length);
        const first = this.chunks[0]!;
        const message = first.subarray(0, length);
        if (first.byteLength === length) this.chunks.shift();
        else this.chunks[0] = first.subarray(length);
        this.buffered -= length;
        return message;
    }

    private parse(message: Uint8Array): StreamMessage {
        const view = new DataView(message.buffer, message.byteOffset, message.byteLength);
        const headerEnd = prefixBytes + view.getUint32(0, true);
        const header: unknown = JSON.parse(this.text.decode(message.subarray(prefixBytes, headerEnd)));
        if (typeof header !== "object" || header === null || typeof (header as { type?: unknown }).type !== "string") {
            throw new Error("The picture stream is damaged.");
        }
        return { header: header as StreamMessage["header"], payload: message.subarray(headerEnd) };
    }
}
