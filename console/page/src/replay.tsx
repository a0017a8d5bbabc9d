// A replay's timeline: where it is, how fast it goes, and what happened when. Everybody who looks at the
// same replay sees the same instant of it.

import { h, Fragment } from "preact";
import { useEffect, useState } from "preact/hooks";
import type { Link } from "./link";
import type { Said } from "./site";
import { conditionInWords, inWords, textOfEvent } from "./conditions";
import { utc } from "./format";
import { named, t } from "./words";

// Of the server, with each message.
export type ReplayState = {
  file: string;
  at_us: number;
  first_us: number;
  last_us: number; // as far as the recording was read
  read: number; // 0..1
  playing: boolean;
  speed: number;
  marks: number; // grows with the timeline
  problem: string;
};

export type TimelineMark = { utime_us: number; kind: string; station: string; who: string; text: string; said: Said | null; refusal: Said | null };
type Recorded = { station: string; name: string; first_us: number; last_us: number; frames: number };
type Timeline = { marks: TimelineMark[]; marks_left_out: number; recorded: Recorded[] };

const SPEEDS = [0.25, 0.5, 1, 2, 5, 10, 30];
const STEP_MS = 1000;
const KINDS = ["alarm", "error", "command", "birth", "end"];

function describe(mark: TimelineMark): string {
  const outcome = mark.refusal ? ` → ${conditionInWords(mark.refusal)}` : "";
  return [utc(mark.utime_us), named("k", mark.kind), mark.station, textOfEvent(mark) + outcome].filter(Boolean).join(" · ");
}

function useTimeline(changes: number): Timeline {
  const [timeline, setTimeline] = useState<Timeline>({ marks: [], marks_left_out: 0, recorded: [] });
  useEffect(() => {
    let isOver = false;
    void fetch("/api/replay")
      .then((response) => (response.ok ? response.json() : null))
      .then((got) => got && !isOver && setTimeline(got))
      .catch(() => null);
    return () => void (isOver = true);
  }, [changes]);
  return timeline;
}

function Marks({ marks, place }: { marks: TimelineMark[]; place: (utime_us: number) => number }) {
  return (
    <div class="marks" aria-hidden="true">
      {marks.map((mark) => (
        <i class={mark.kind} style={{ left: `${100 * place(mark.utime_us)}%` }} title={describe(mark)} />
      ))}
    </div>
  );
}

type ScrubProps = { state: ReplayState; at_us: number; marks: TimelineMark[]; onDrag: (utime_us: number) => void; onDragged: () => void };

// The timeline, with what happened on it.
function Scrub({ state, at_us, marks, onDrag, onDragged }: ScrubProps) {
  const length_us = Math.max(1, state.last_us - state.first_us);
  const place = (utime_us: number) => Math.max(0, Math.min(1, (utime_us - state.first_us) / length_us));
  return (
    <div class="scrub">
      <Marks marks={marks} place={place} />
      <input
        type="range"
        aria-label={t("instant")}
        aria-valuetext={utc(at_us, true)}
        min={state.first_us / 1000}
        max={Math.max(state.last_us, state.first_us + 1) / 1000}
        step={STEP_MS / 10}
        value={at_us / 1000}
        onInput={(e) => onDrag(Number(e.currentTarget.value) * 1000)}
        onChange={onDragged}
        onBlur={onDragged}
      />
    </div>
  );
}

type StepsProps = { at_us: number; marks: TimelineMark[]; go: (utime_us: number) => void };

// To what happened before and after this instant.
function Steps({ at_us, marks, go }: StepsProps) {
  const toMark = (step: 1 | -1) => {
    const others = marks.filter((mark) => (step > 0 ? mark.utime_us > at_us + 1e4 : mark.utime_us < at_us - 5e5));
    const next = step > 0 ? others[0] : others[others.length - 1];
    if (next) go(next.utime_us);
  };
  return (
    <Fragment>
      <button type="button" onClick={() => toMark(-1)} aria-label={t("mark_before")} title={t("mark_before")}>
        ◂
      </button>
      <button type="button" onClick={() => toMark(1)} aria-label={t("mark_after")} title={t("mark_after")}>
        ▸
      </button>
    </Fragment>
  );
}

function GoTo({ recorded, marks, go }: { recorded: Recorded[] | undefined; marks: TimelineMark[]; go: (utime_us: number) => void }) {
  return (
    <select aria-label={t("go_to")} value="" onChange={(e) => e.currentTarget.value && go(Number(e.currentTarget.value))}>
      <option value="">{t("go_to")} …</option>
      {recorded?.map((one) => (
        <option value={String(one.first_us)}>{`${utc(one.first_us)} · ${t("frames")} ${one.station} ${one.name} (${one.frames})`}</option>
      ))}
      {marks.map((mark) => (
        <option value={String(mark.utime_us)}>{describe(mark)}</option>
      ))}
    </select>
  );
}

function WhatOf({ state, left_out }: { state: ReplayState; left_out: number }) {
  return (
    <p class="replay-of">
      <b>{t("replay")}</b> {state.file} <span>{t("replay_hint")}</span>
      {state.read < 1 && <span> · {t("being_read")} {Math.floor(100 * state.read)} %</span>}
      {left_out > 0 && <span> · {left_out} {t("marks_left_out")}</span>}
    </p>
  );
}

export function ReplayBar({ link }: { link: Link }) {
  const state = link.replay!;
  const timeline = useTimeline(state.marks);
  const [dragged, setDragged] = useState<number | null>(null);
  const at_us = dragged ?? Math.min(link.now_us(), Math.max(state.last_us, state.at_us));
  const say = (what: object) => link.send({ do: "replay", ...what });
  const go = (utime_us: number) => say({ at_us: Math.round(utime_us) });
  const marks = timeline.marks.filter((mark) => KINDS.includes(mark.kind));
  const isAtEnd = state.read >= 1 && state.at_us >= state.last_us;
  const play = () => say(state.playing ? { playing: false } : isAtEnd ? { playing: true, at_us: state.first_us } : { playing: true });
  const drag = (utime_us: number) => {
    setDragged(utime_us);
    go(utime_us);
  };
  return (
    <section class="replay" aria-label={t("replay")}>
      <WhatOf state={state} left_out={timeline.marks_left_out} />
      {state.problem && <p class="replay-problem" role="alert">{state.problem.split("; ").map(inWords).join("; ")}</p>}
      <div class="replay-tools">
        <button type="button" class="play" onClick={play}>
          {state.playing ? t("pause") : t("play")}
        </button>
        <Steps at_us={at_us} marks={marks} go={go} />
        <label>
          {t("rate")}
          <select value={String(state.speed)} onChange={(e) => say({ speed: Number(e.currentTarget.value) })}>
            {SPEEDS.map((speed) => (
              <option value={String(speed)}>{speed}×</option>
            ))}
          </select>
        </label>
        <time>{utc(at_us, true)}</time>
        <Scrub state={state} at_us={at_us} marks={marks} onDrag={drag} onDragged={() => setDragged(null)} />
        <GoTo recorded={timeline.recorded} marks={marks} go={go} />
      </div>
    </section>
  );
}
