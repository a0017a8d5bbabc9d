// The key Escape: it closes what was opened last or cancels what a hand holds. Only with nothing open
// does it stop the site.

import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";

type Close = () => void;

// What is open now, the newest last.
export class Opened {
  private closes: { close: Close }[] = [];

  // Open until the returned function is called.
  add(close: Close): () => void {
    const entry = { close };
    this.closes.push(entry);
    return () => void (this.closes = this.closes.filter((one) => one !== entry));
  }

  get isEmpty(): boolean {
    return this.closes.length === 0;
  }

  // False: nothing was open.
  closeNewest(): boolean {
    const newest = this.closes.pop();
    newest?.close();
    return newest !== undefined;
  }
}

const opened = new Opened();

// Escape calls `close`, once, while `isOpen`: at once, since the key may follow before the next frame.
export function useEscape(isOpen: boolean, close: Close) {
  const now = useRef(close);
  now.current = close;
  useLayoutEffect(() => (isOpen ? opened.add(() => now.current()) : undefined), [isOpen]);
}

// From a press until it is let go, wherever that is, Escape calls `cancel`. Returns the handler of presses.
export function useHeld(cancel: Close): () => void {
  const [isHeld, setHeld] = useState(false);
  useEscape(isHeld, () => {
    setHeld(false);
    cancel();
  });
  useLayoutEffect(() => {
    if (!isHeld) return;
    const end = (event: PointerEvent) => event.buttons === 0 && setHeld(false); // a menu of the browser hides the end
    const ends = ["pointerup", "pointercancel", "pointermove"] as const;
    ends.forEach((name) => window.addEventListener(name, end, { capture: true }));
    return () => ends.forEach((name) => window.removeEventListener(name, end, { capture: true }));
  }, [isHeld]);
  return () => setHeld(true);
}

type Key = Pick<KeyboardEvent, "key" | "repeat" | "isComposing" | "ctrlKey" | "altKey" | "metaKey" | "shiftKey">;
export type Meant = "nothing" | "closed" | "stop";

// A person who writes or chooses in a field (`field`) leaves it by Escape.
export function press(event: Key, what: Opened, field: { blur(): void } | null): Meant {
  const isPlain = event.key === "Escape" && !event.repeat && !event.isComposing;
  if (!isPlain || event.ctrlKey || event.altKey || event.metaKey || event.shiftKey) return "nothing";
  if (what.closeNewest()) return "closed";
  field?.blur();
  return field ? "closed" : "stop";
}

function fieldInFocus(): HTMLElement | null {
  const focused = document.activeElement;
  return focused instanceof HTMLElement && focused.matches("input, select, textarea") ? focused : null;
}

// Wherever on the page it is pressed. `isAll`: the next press stops the site.
export function useEscapeKey(onStop: () => void, onClosed: (isAll: boolean) => void) {
  const now = useRef({ onStop, onClosed });
  now.current = { onStop, onClosed };
  useEffect(() => {
    const key = (event: KeyboardEvent) => {
      const meant = press(event, opened, fieldInFocus());
      if (meant === "stop") now.current.onStop();
      if (meant !== "closed") return;
      event.preventDefault();
      now.current.onClosed(opened.isEmpty && !fieldInFocus());
    };
    window.addEventListener("keydown", key, { capture: true });
    return () => window.removeEventListener("keydown", key, { capture: true });
  }, []);
}
