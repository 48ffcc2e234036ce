// Files dropped anywhere on the page: volumes are uploaded, a workbook is opened.
import { useEffect, useState } from "preact/hooks";
import { isWorkbookFile } from "../app/dataset_actions";
import { useApp } from "./app_context";

function hasFiles(event: DragEvent): boolean {
    return event.dataTransfer?.types.includes("Files") ?? false;
}

export function DropArea() {
    const app = useApp();
    const [over, setOver] = useState(false);
    useEffect(() => {
        const dragOver = (event: DragEvent): void => {
            if (!hasFiles(event)) return;
            event.preventDefault();
            setOver(true);
        };
        const leave = (event: DragEvent): void => {
            // Only when the pointer leaves the window, not at every element on the way.
            if (event.relatedTarget === null) setOver(false);
        };
        const drop = (event: DragEvent): void => {
            if (!hasFiles(event)) return;
            event.preventDefault();
            setOver(false);
            const files = [...(event.dataTransfer?.files ?? [])];
            const workbook = files.length === 1 && isWorkbookFile(files[0]!) ? files[0]! : null;
            if (workbook) void app.cells.loadWorkbook(workbook);
            else void app.datasets.upload(files);
        };
        document.addEventListener("dragover", dragOver);
        document.addEventListener("dragleave", leave);
        document.addEventListener("drop", drop);
        return () => {
            document.removeEventListener("dragover", dragOver);
            document.removeEventListener("dragleave", leave);
            document.removeEventListener("drop", drop);
        };
    }, [app]);
    return over ? <div class="drop-area">Drop to upload</div> : null;
}
