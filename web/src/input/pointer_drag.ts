// One press of a pointer, followed until it is let go: everything goes to the element that was pressed.

export interface DragHandlers {
    move(event: PointerEvent): void;
    /** cancelled: the browser took the pointer away, or Esc was pressed. */
    end(cancelled: boolean): void;
}

export function followPointer(press: PointerEvent, element: Element, handlers: DragHandlers): void {
    const own = (event: Event): boolean => (event as PointerEvent).pointerId === press.pointerId;
    const move = (event: Event): void => {
        event.stopPropagation();
        if (own(event)) handlers.move(event as PointerEvent);
    };
    const stop = (cancelled: boolean): void => {
        element.removeEventListener("pointermove", move);
        element.removeEventListener("pointerup", up);
        element.removeEventListener("pointercancel", taken);
        document.removeEventListener("keydown", key, true);
        handlers.end(cancelled);
    };
    const up = (event: Event): void => {
        if (own(event)) stop(false);
    };
    const taken = (event: Event): void => {
        if (own(event)) stop(true);
    };
    const key = (event: KeyboardEvent): void => {
        if (event.key !== "Escape") return;
        event.preventDefault();
        event.stopPropagation();
        stop(true);
    };
    element.setPointerCapture(press.pointerId);
    element.addEventListener("pointermove", move);
    element.addEventListener("pointerup", up);
    element.addEventListener("pointercancel", taken);
    document.addEventListener("keydown", key, true);
}
