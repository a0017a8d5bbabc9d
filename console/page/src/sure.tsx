// A button that asks first. In the page, not by the browser's own question, which would hold up the
// pictures and the stop for as long as it stands.

import { h } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { useEscape } from "./escape";
import { t } from "./words";

type Props = { word: string; question: string; label?: string; isDangerous?: boolean; onSure: () => void };

export function Sure({ word, question, label, isDangerous, onSure }: Props) {
  const [asks, setAsks] = useState(false);
  useEscape(asks, () => setAsks(false));
  const no = useRef<HTMLButtonElement>(null);
  const button = useRef<HTMLButtonElement>(null);
  const wasAsked = useRef(false);
  useEffect(() => {
    if (asks) no.current!.focus();
    else if (wasAsked.current) button.current!.focus();
    wasAsked.current = asks;
  }, [asks]);
  if (!asks) {
    return (
      <button ref={button} type="button" class={isDangerous ? "danger" : ""} aria-label={label} onClick={() => setAsks(true)}>
        {word}
      </button>
    );
  }
  const yes = () => {
    setAsks(false);
    onSure();
  };
  return (
    <span class="sure" role="group" aria-label={question}>
      <span role="alert">{question}</span>
      <button type="button" class="danger" onClick={yes}>
        {word}
      </button>
      <button ref={no} type="button" onClick={() => setAsks(false)}>
        {t("no")}
      </button>
    </span>
  );
}
