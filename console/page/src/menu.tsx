// What opens below a word, and is closed by the word or by Escape.

import { h, type ComponentChildren } from "preact";
import { useState } from "preact/hooks";
import { useEscape } from "./escape";

type Props = { class: string; word: string; children: ComponentChildren };

export function Menu({ class: kind, word, children }: Props) {
  const [isOpen, setOpen] = useState(false);
  useEscape(isOpen, () => setOpen(false));
  // Not by the browser: it opens at once and tells later, and Escape between the two would stop the site.
  const toggle = (event: Event) => {
    event.preventDefault();
    setOpen(!isOpen);
  };
  return (
    <details class={kind} open={isOpen}>
      <summary onClick={toggle}>{word}</summary>
      {children}
    </details>
  );
}
