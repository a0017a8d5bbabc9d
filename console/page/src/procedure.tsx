// Guided procedures (calibrations): what each is at, its picture, its question, and a person's answer.

import { h } from "preact";
import { inWords } from "./conditions";
import type { Link } from "./link";
import type { Procedure, Station } from "./site";
import { fixed, numberOf } from "./format";
import { Sure } from "./sure";
import { named, t } from "./words";

const SILENT_US = 6_000_000; // it says something each second
const RESULT_US = 120_000_000; // how long its end is shown
const HIGHEST_VH = 34; // of its picture: the answers are below it

export type ProcedureAnswer = { station: string; question: number; choice: string; pixel_px?: [number, number]; turn_deg?: [number, number] };
type Say = (answer: ProcedureAnswer) => void;

const isAtWork = (procedure: Procedure) => procedure.state === "running" || procedure.state === "asking";

function isShown(procedure: Procedure | undefined, now_us: number): procedure is Procedure {
  if (!procedure) return false;
  return now_us - procedure.utime_us < (isAtWork(procedure) ? SILENT_US : RESULT_US);
}

function pairOf(form: HTMLFormElement): [number, number] | null {
  const data = new FormData(form);
  const [a, b] = [numberOf(String(data.get("a"))), numberOf(String(data.get("b")))];
  return a == null || b == null ? null : [a, b];
}

// Two numbers and a button: whoever cannot point with a finger points by them.
function Pair({ labels, word, onPair }: { labels: [string, string]; word: string; onPair: (pair: [number, number]) => void }) {
  const submit = (event: Event) => {
    event.preventDefault();
    const pair = pairOf(event.currentTarget as HTMLFormElement);
    if (pair) onPair(pair);
  };
  return (
    <form onSubmit={submit}>
      {labels.map((label, i) => (
        <label>
          {label}
          <input name={i ? "b" : "a"} inputMode="decimal" required />
        </label>
      ))}
      <button>{word}</button>
    </form>
  );
}

type PictureProps = { station: string; procedure: Procedure; onPoint: ((pixel: [number, number]) => void) | null };

function ProcedurePicture({ station, procedure, onPoint }: PictureProps) {
  const [width, height] = procedure.full_px;
  const cross = procedure.crosshair_px;
  const click = (event: MouseEvent) => {
    if (!onPoint) return;
    const box = (event.currentTarget as HTMLElement).getBoundingClientRect();
    // (0, 0) is the centre of the first pixel.
    onPoint([((event.clientX - box.left) / box.width) * width - 0.5, ((event.clientY - box.top) / box.height) * height - 0.5]);
  };
  return (
    <div class={`procedure-picture ${onPoint ? "to-point" : ""}`} style={{ width: `min(100%, ${(HIGHEST_VH * width) / height}vh)` }} onClick={click}>
      <img src={`/api/procedures/${encodeURIComponent(station)}?picture=${procedure.picture}`} alt={inWords(procedure.step)} draggable={false} />
      {cross && (
        <i
          class="crosshair"
          role="img"
          aria-label={`${t("crosshair")} ${fixed(cross[0], 1)}, ${fixed(cross[1], 1)}`}
          style={{ left: `${((cross[0] + 0.5) / width) * 100}%`, top: `${((cross[1] + 0.5) / height) * 100}%` }}
        />
      )}
    </div>
  );
}

function Question({ station, procedure, onAnswer }: { station: string; procedure: Procedure; onAnswer: Say }) {
  const say = (choice: string, more: Partial<ProcedureAnswer> = {}) => onAnswer({ station, question: procedure.question, choice, ...more });
  const can = (choice: string) => procedure.choices.includes(choice);
  const plain = procedure.choices.filter((choice) => !["point", "exactly", "turn"].includes(choice));
  return (
    <div class="procedure-answers">
      <div class="buttons">
        {plain.map((choice) => (
          <button type="button" class={choice === "accept" || choice === "confirm" ? "primary" : ""} onClick={() => say(choice)}>
            {named("c", choice)}
          </button>
        ))}
      </div>
      {can("exactly") && <Pair labels={["x px", "y px"]} word={named("c", "exactly")} onPair={(pixel_px) => say("exactly", { pixel_px })} />}
      {can("turn") && <Pair labels={[t("pan"), t("tilt_angle")]} word={named("c", "turn")} onPair={(turn_deg) => say("turn", { turn_deg })} />}
    </div>
  );
}

function One({ station, procedure, mayCommand, onAnswer }: { station: Station; procedure: Procedure; mayCommand: boolean; onAnswer: Say }) {
  const isAsking = procedure.state === "asking" && mayCommand;
  const abort = () => onAnswer({ station: station.id, question: procedure.question, choice: "abort" });
  const point = (pixel_px: [number, number]) => onAnswer({ station: station.id, question: procedure.question, choice: "point", pixel_px });
  return (
    <article class="open procedure">
      <div class="procedure-head">
        <h3>
          <b>{station.id}</b> {named("m", procedure.procedure)}: {inWords(procedure.step) || named("p", procedure.state)}
        </h3>
        {mayCommand && isAtWork(procedure) && (
          <Sure word={named("c", "abort")} question={`${station.id}: ${t("abort_sure")}`} isDangerous onSure={abort} />
        )}
      </div>
      <progress max={1} value={procedure.progress ?? 0} aria-label={t("procedure")} />
      {procedure.lines.length > 0 && <p class="procedure-text">{procedure.lines.map(inWords).join("\n")}</p>}
      {procedure.picture > 0 && <ProcedurePicture station={station.id} procedure={procedure} onPoint={isAsking && procedure.choices.includes("point") ? point : null} />}
      {isAsking && <Question station={station.id} procedure={procedure} onAnswer={onAnswer} />}
    </article>
  );
}

export function Procedures({ link, mayCommand, onAnswer }: { link: Link; mayCommand: boolean; onAnswer: Say }) {
  const now_us = link.now_us();
  const stations = [...link.site.stations.values()].filter((one) => isShown(one.procedure, now_us));
  if (stations.length === 0) return null;
  return (
    <section class="procedures" aria-label={t("procedure")}>
      <header>
        <h2>{t("procedure")}</h2>
      </header>
      {stations.map((one) => (
        <One key={one.id} station={one} procedure={one.procedure!} mayCommand={mayCommand} onAnswer={onAnswer} />
      ))}
    </section>
  );
}
