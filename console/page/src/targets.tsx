// The table of targets, lines of sight and cues beside the map.

import { h, Fragment } from "preact";
import { useState } from "preact/hooks";
import { bearing, DASH, fixed } from "./format";
import type { Link } from "./link";
import { length, position, speed } from "./measures";
import { MeasuresChoice } from "./measureschoice";
import { isTarget, nameOf, targetState, type Cue, type HandoverMode, type Line, type Target } from "./site";
import { named, t, Word } from "./words";

type Column = { word: Word; of: (target: Target) => string | number | null; text: (target: Target, link: Link) => string };

const age_s = (utime_us: number, link: Link) => Math.max(0, (link.now_us() - utime_us) / 1e6);
const used = (target: Target) => target.stations?.filter((s) => s.used).length ?? 0;

// Of east, north and up, with their unit once.
function sigmas({ sd_enu_m }: Target): string {
  const texts = (sd_enu_m ?? []).map((v) => length(v, 2));
  return texts.map((text, i) => (i < texts.length - 1 ? text.replace(/ .*/, "") : text)).join(" ");
}

const COLUMNS: Column[] = [
  { word: "name", of: (x) => Number(x.id), text: nameOf },
  { word: "state", of: targetState, text: (x) => named("s", targetState(x)) },
  { word: "height", of: (x) => x.height_m, text: (x) => length(x.height_m, 1) },
  { word: "speed", of: (x) => x.speed_m_s, text: (x) => speed(x.speed_m_s, 1) },
  { word: "course", of: (x) => x.course_deg, text: (x) => bearing(x.course_deg, 0) },
  { word: "sigma", of: (x) => x.sd_enu_m?.[0] ?? null, text: sigmas },
  { word: "seen_by", of: used, text: (x) => `${used(x)} ${t("of")} ${x.stations?.length ?? 0}` },
  { word: "age", of: (x) => -x.utime_us, text: (x, link) => fixed(age_s(x.utime_us, link), 1, " s") },
  { word: "position", of: (x) => x.latitude_deg, text: (x) => position(x) },
];
const STATES = ["confirmed", "tentative", "coasted", "stale"];

type TargetsProps = {
  link: Link;
  selected: string;
  mayCommand: boolean;
  onSelect: (pick: string) => void;
  onCue: (cue: string, allow: boolean) => void;
  onHandover: (mode: HandoverMode) => void;
};
const HANDOVER: HandoverMode[] = ["off", "propose", "automatic"];

// Which targets of detections lead stations. A choice alone changes nothing: stations may begin to turn.
function Handover({ mode, mayCommand, onHandover }: { mode: HandoverMode; mayCommand: boolean; onHandover: TargetsProps["onHandover"] }) {
  const [wanted, setWanted] = useState<HandoverMode | null>(null);
  const set = () => {
    onHandover(wanted!);
    setWanted(null);
  };
  return (
    <span class="handover">
      <label>
        {t("handover_mode")}
        <select value={wanted ?? mode} disabled={!mayCommand} onChange={(e) => setWanted(e.currentTarget.value as HandoverMode)}>
          {HANDOVER.map((one) => (
            <option value={one}>{named("ho", one)}</option>
          ))}
        </select>
      </label>
      {mayCommand && wanted && wanted !== mode && (
        <button type="button" onClick={set}>
          {t("handover_set")}
        </button>
      )}
    </span>
  );
}

// The operator's word on what others know of a target, or on a target that detectors have found.
export function WordOn({ cue, mayCommand, onCue }: { cue: Cue; mayCommand: boolean; onCue: TargetsProps["onCue"] }) {
  const isAllowed = cue.state === "searched" || cue.state === "found";
  const button = (word: Word, allow: boolean) => (
    <button type="button" disabled={!mayCommand} onClick={() => onCue(cue.id, allow)}>
      {t(word)}
    </button>
  );
  if (!isTarget(cue)) return button(isAllowed ? "cue_forbid" : "cue_allow", !isAllowed);
  return (
    <Fragment>
      {!isAllowed && button("handover_allow", true)} {cue.state !== "forbidden" && button("handover_dismiss", false)}
    </Fragment>
  );
}

function CueRow({ cue, mayCommand, onCue }: { cue: Cue; mayCommand: boolean; onCue: TargetsProps["onCue"] }) {
  return (
    <tr class="line">
      <td>{cue.target || DASH}</td>
      <td colSpan={COLUMNS.length - 1}>
        {t(isTarget(cue) ? "target" : "cue")} {cue.id} {cue.label}: {named(isTarget(cue) ? "h" : "s", cue.state)}, {length(cue.height_m)} ±{length(cue.horizontal_sd_m)}{" "}
        <WordOn cue={cue} mayCommand={mayCommand} onCue={onCue} />
      </td>
    </tr>
  );
}

function LineRow({ line }: { line: Line }) {
  return (
    <tr class="line">
      <td>{DASH}</td>
      <td colSpan={COLUMNS.length - 1}>
        {line.id}: {t("line_only")}, {t("azimuth")} {bearing(line.azimuth_deg, 2)} {t("elevation")} {fixed(line.elevation_deg, 2, "°")}
      </td>
    </tr>
  );
}

type TargetRowProps = { target: Target; link: Link; isSelected: boolean; onSelect: () => void };

function TargetRow({ target, link, isSelected, onSelect }: TargetRowProps) {
  return (
    <tr aria-selected={isSelected} class={target.stale ? "stale" : ""} onClick={onSelect}>
      <td>
        <button type="button" class={`tag ${targetState(target)}`} aria-pressed={isSelected}>
          {COLUMNS[0].text(target, link)}
        </button>
      </td>
      {COLUMNS.slice(1).map((column) => (
        <td class={`of-${column.word}`}>{column.text(target, link)}</td>
      ))}
    </tr>
  );
}

type Sort = { column: number; down: boolean };

// In place; what is not known counts as the greatest.
function sorted(targets: Target[], sort: Sort): Target[] {
  const key = COLUMNS[sort.column].of;
  return targets.sort((a, b) => {
    const [x, y] = [key(a), key(b)];
    const order = x == null ? 1 : y == null ? -1 : x < y ? -1 : x > y ? 1 : 0;
    return sort.down ? -order : order;
  });
}

function Heads({ sort, onSort }: { sort: Sort; onSort: (sort: Sort) => void }) {
  return (
    <tr>
      {COLUMNS.map((column, i) => (
        <th class={`of-${column.word}`} aria-sort={sort.column !== i ? "none" : sort.down ? "descending" : "ascending"}>
          <button type="button" onClick={() => onSort({ column: i, down: sort.column === i && !sort.down })}>
            {t(column.word)}
            <span aria-hidden="true">{sort.column === i ? (sort.down ? " ▾" : " ▴") : ""}</span>
          </button>
        </th>
      ))}
    </tr>
  );
}

export function Targets({ link, selected, mayCommand, onSelect, onCue, onHandover }: TargetsProps) {
  const [sort, setSort] = useState<Sort>({ column: 0, down: false });
  const [state, setState] = useState("");
  const targets = sorted([...link.site.targets.values()].filter((one) => !state || targetState(one) === state), sort);
  const lines = [...link.site.lines.values()].filter((line) => !line.stale);
  const fusion = link.site.fusion?.stale ? null : link.site.fusion;
  const cues = fusion?.cues ?? [];
  return (
    <section class="targets" aria-label={t("targets")}>
      <header>
        <h2>{t("targets")}</h2>
        <span class="gap" />
        {fusion?.handover && <Handover mode={fusion.handover} mayCommand={mayCommand} onHandover={onHandover} />}
        <MeasuresChoice />
        <label>
          {t("filter")}
          <select value={state} onChange={(e) => setState(e.currentTarget.value)}>
            <option value="">{t("all")}</option>
            {STATES.map((one) => (
              <option value={one}>{named("s", one)}</option>
            ))}
          </select>
        </label>
      </header>
      <div class="scroll" tabIndex={0} role="group" aria-label={t("targets")}>
        <table>
          <thead>
            <Heads sort={sort} onSort={setSort} />
          </thead>
          <tbody>
            {targets.map((target) => {
              const pick = `target:${target.id}`;
              return <TargetRow key={target.id} target={target} link={link} isSelected={selected === pick} onSelect={() => onSelect(pick)} />;
            })}
            {lines.map((line) => (
              <LineRow key={`line:${line.id}`} line={line} />
            ))}
            {cues.map((cue) => (
              <CueRow key={`cue:${cue.id}`} cue={cue} mayCommand={mayCommand} onCue={onCue} />
            ))}
          </tbody>
        </table>
        {targets.length + lines.length + cues.length === 0 && <p class="nothing">{t("no_target")}</p>}
      </div>
    </section>
  );
}
