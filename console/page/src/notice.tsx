// What is said to the operator at the foot of the page, for a few seconds.

import { h } from "preact";
import { useEffect, useState } from "preact/hooks";

const NOTICE_MS = 6000;

type NoticeText = { text: string; isBad: boolean; ofStop?: boolean };
type Say = (text: string, isBad: boolean) => void;
export type Notices = { say: Say; sayOfStop: Say; sayLate: Say };

export function useNotice(): [NoticeText | null, Notices] {
  const [notice, setNotice] = useState<NoticeText | null>(null);
  useEffect(() => {
    if (!notice) return;
    const timer = setTimeout(() => setNotice(null), NOTICE_MS);
    return () => clearTimeout(timer);
  }, [notice]);
  const say: Say = (text, isBad) => setNotice({ text, isBad });
  const sayOfStop: Say = (text, isBad) => setNotice({ text, isBad, ofStop: true });
  // What was given before a stop is answered after it: that does not cover what is said of the stop.
  const sayLate: Say = (text, isBad) => setNotice((now) => (now?.ofStop ? now : { text, isBad }));
  return [notice, { say, sayOfStop, sayLate }];
}

export function Notice({ notice }: { notice: NoticeText | null }) {
  return (
    <output class={`notice ${notice ? "shown" : ""} ${notice?.isBad ? "bad" : ""}`} aria-live="polite">
      {notice?.text}
    </output>
  );
}
