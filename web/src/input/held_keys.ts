// Which letter keys are down right now: "w" turns a drag into window/level.

const held = new Set<string>();

export function isHeld(key: string): boolean {
    return held.has(key);
}

export function watchHeldKeys(): void {
    window.addEventListener("keydown", (event) => held.add(event.key.toLowerCase()));
    window.addEventListener("keyup", (event) => held.delete(event.key.toLowerCase()));
    window.addEventListener("blur", () => held.clear());
}
