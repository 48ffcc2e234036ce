// Counts of what was really painted, for the status bar and for tests (window.voxsheet.stats).

/** At least so many records are kept, and at most twice as many: cutting the list at every paint costs more than painting. */
const kept = 8192;

export interface PaintRecord {
    seq: number;
    frame: number;
    cell: string;
    /** performance.now() */
    at: number;
    level: number;
    scale: number;
    final: boolean;
    format: string;
    bytes: number;
}

export class PaintStatistics {
    tilesPainted = 0;
    bytesPainted = 0;
    lastSeq = 0;
    lastFrame = 0;
    /** Tiles whose sequence number was not above the one before: must stay 0. */
    outOfOrder = 0;
    /** The newest paints, oldest first. */
    readonly recent: PaintRecord[] = [];

    add(record: PaintRecord): void {
        if (record.seq <= this.lastSeq) ++this.outOfOrder;
        this.lastSeq = record.seq;
        this.lastFrame = record.frame;
        ++this.tilesPainted;
        this.bytesPainted += record.bytes;
        this.recent.push(record);
        if (this.recent.length > 2 * kept) this.recent.splice(0, this.recent.length - kept);
    }

    /** Sequence numbers start again with every stream. */
    streamOpened(): void {
        this.lastSeq = 0;
        this.lastFrame = 0;
    }

    /** Distinct frames painted since a time of performance.now(). */
    framesSince(time: number): number {
        return new Set(this.recent.filter((record) => record.at >= time).map((record) => record.frame)).size;
    }
}
