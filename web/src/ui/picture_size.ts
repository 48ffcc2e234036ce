// How large the drawing over a picture is.
import { useEffect, useRef, useState } from "preact/hooks";

export function usePictureSize() {
    const svg = useRef<SVGSVGElement>(null);
    const [size, setSize] = useState({ width: 0, height: 0 });
    useEffect(() => {
        const observer = new ResizeObserver(([entry]) => {
            if (entry) setSize({ width: entry.contentRect.width, height: entry.contentRect.height });
        });
        observer.observe(svg.current!);
        return () => observer.disconnect();
    }, []);
    return { svg, size };
}
