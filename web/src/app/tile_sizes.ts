// Which tiles are on show, and how large they are in device pixels: the stream draws just these.
import type { ViewTile } from "../stream/view_sender";

const largestPixelRatio = 2;
const largestSidePixels = 4096;

export class TileSizes {
    private readonly elements = new Map<Element, string>();
    private readonly visible = new Set<Element>();
    private readonly sizes = new Map<Element, { width: number; height: number }>();
    private readonly resize: ResizeObserver;
    private readonly intersection: IntersectionObserver;

    constructor(private readonly changed: () => void) {
        this.resize = new ResizeObserver((entries) => {
            for (const { target, contentRect } of entries) {
                this.sizes.set(target, { width: contentRect.width, height: contentRect.height });
            }
            this.changed();
        });
        this.intersection = new IntersectionObserver(
            (entries) => {
                for (const { target, isIntersecting } of entries) {
                    if (isIntersecting) this.visible.add(target);
                    else this.visible.delete(target);
                }
                this.changed();
            },
            // A little beyond the edge, so that scrolling finds pictures already there.
            { rootMargin: "120px" },
        );
    }

    watch(cell: string, element: Element): void {
        this.elements.set(element, cell);
        this.resize.observe(element);
        this.intersection.observe(element);
    }

    unwatch(element: Element): void {
        this.resize.unobserve(element);
        this.intersection.unobserve(element);
        this.elements.delete(element);
        this.visible.delete(element);
        this.sizes.delete(element);
        this.changed();
    }

    /** The active cell first: it is drawn first. */
    visibleTiles(active: string): ViewTile[] {
        const ratio = Math.min(largestPixelRatio, window.devicePixelRatio || 1);
        const pixels = (length: number): number => Math.min(largestSidePixels, Math.max(1, Math.round(length * ratio)));
        const tiles: ViewTile[] = [];
        for (const [element, cell] of this.elements) {
            const size = this.sizes.get(element);
            if (!size || !this.visible.has(element) || size.width < 2 || size.height < 2) continue;
            const tile = { cell, width: pixels(size.width), height: pixels(size.height) };
            if (cell === active) tiles.unshift(tile);
            else tiles.push(tile);
        }
        return tiles;
    }
}
