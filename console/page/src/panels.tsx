// Targets, stations and history: tables and details beside the map.

import { h, Fragment } from "preact";
import { useState } from "preact/hooks";
import type { Link } from "./link";
import type { Cue, SiteEvent, Station, Target } from "./site";
import { adviceFor } from "./advice";
import { calibrationText } from "./calibration";
import { bearing, clockError, DASH, fixed, utc } from "./format";
import { named, t, Word } from "./words";

// ---- targets ----------------------------------------------------------------------------------

type Column = { word: Word; of: (target: Target) => string | number | null; text: (target: Target, link: Link) => string };

const age_s = (utime_us: number, link: Link) => Math.max(0, (link.now_us() - utime_us) / 1e6);
const used = (target: Target) => target.stations?.filter((s) => s.used).length ?? 0;

const COLUMNS: Column[] = [
  { word: "name", of: (x) => Number(x.id), text: (x) => x.id },
  { word: "state", of: (x) => x.state, text: (x) => named("s", x.state) },
  { word: "height", of: (x) => x.height_m, text: (x) => fixed(x.height_m, 1, " m") },
  { word: "speed", of: (x) => x.speed_m_s, text: (x) => fixed(x.speed_m_s, 1, " m/s") },
  { word: "course", of: (x) => x.course_deg, text: (x) => bearing(x.course_deg, 0) },
  { word: "sigma", of: (x) => x.sd_enu_m?.[0] ?? null, text: (x) => (x.sd_enu_m ?? []).map((v) => fixed(v, 2)).join("  ") + " m" },
  { word: "seen_by", of: used, text: (x) => `${used(x)} ${t("of")} ${x.stations?.length ?? 0}` },
  { word: "age", of: (x) => -x.utime_us, text: (x, link) => fixed(age_s(x.utime_us, link), 1, " s") },
  { word: "position", of: (x) => x.latitude_deg, text: (x) => `${fixed(x.latitude_deg, 6)}° ${fixed(x.longitude_deg, 6)}°` },
];
const STATES = ["confirmed", "born", "coasted"];

type TargetsProps = { link: Link; selected: string; mayCommand: boolean; onSelect: (pick: string) => void; onCue: (cue: string, allow: boolean) => void };

// What others know of targets, and the operator's word on it.
function CueRow({ cue, mayCommand, onCue }: { cue: Cue; mayCommand: boolean; onCue: TargetsProps["onCue"] }) {
  const isAllowed = cue.state === "searched" || cue.state === "found";
  return (
    <tr class="line">
      <td>{cue.target || DASH}</td>
      <td colSpan={COLUMNS.length - 1}>
        {t("cue")} {cue.id} {cue.label}: {named("s", cue.state)}, {fixed(cue.height_m, 0, " m")} ±{fixed(cue.horizontal_sd_m, 0, " m")}{" "}
        <button type="button" disabled={!mayCommand} onClick={() => onCue(cue.id, !isAllowed)}>
          {t(isAllowed ? "cue_forbid" : "cue_allow")}
        </button>
      </td>
    </tr>
  );
}

export function Targets({ link, selected, mayCommand, onSelect, onCue }: TargetsProps) {
  const [sort, setSort] = useState({ column: 0, down: false });
  const [state, setState] = useState("");
  const targets = [...link.site.targets.values()].filter((one) => !state || one.state === state);
  const key = COLUMNS[sort.column].of;
  targets.sort((a, b) => {
    const [x, y] = [key(a), key(b)];
    const order = x == null ? 1 : y == null ? -1 : x < y ? -1 : x > y ? 1 : 0;
    return sort.down ? -order : order;
  });
  const lines = [...link.site.lines.values()].filter((line) => !line.stale);
  const cues = link.site.fusion?.stale ? [] : (link.site.fusion?.cues ?? []);
  return (
    <section class="targets" aria-label={t("targets")}>
      <header>
        <h2>{t("targets")}</h2>
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
            <tr>
              {COLUMNS.map((column, i) => (
                <th aria-sort={sort.column !== i ? "none" : sort.down ? "descending" : "ascending"}>
                  <button type="button" onClick={() => setSort({ column: i, down: sort.column === i && !sort.down })}>
                    {t(column.word)}
                    <span aria-hidden="true">{sort.column === i ? (sort.down ? " ▾" : " ▴") : ""}</span>
                  </button>
                </th>
              ))}
            </tr>
          </thead>
          <tbody>
            {targets.map((target) => {
              const pick = `target:${target.id}`;
              const name = COLUMNS[0].text(target, link);
              return (
                <tr key={target.id} aria-selected={selected === pick} class={target.stale ? "stale" : ""} onClick={() => onSelect(pick)}>
                  <td>
                    <button type="button" class={`tag ${target.state}`} aria-pressed={selected === pick}>
                      {name}
                    </button>
                  </td>
                  {COLUMNS.slice(1).map((column) => (
                    <td>{column.text(target, link)}</td>
                  ))}
                </tr>
              );
            })}
            {lines.map((line) => (
              <tr key={`line:${line.id}`} class="line">
                <td>{DASH}</td>
                <td colSpan={COLUMNS.length - 1}>
                  {line.id}: {t("line_only")}, {t("azimuth")} {bearing(line.azimuth_deg, 2)} {t("elevation")} {fixed(line.elevation_deg, 2)}°
                </td>
              </tr>
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

// ---- stations ---------------------------------------------------------------------------------

export type Command = (station: string, command: string, more?: object) => void;
export type Control = (station: string, take: boolean) => void;

type StationProps = { link: Link; station: Station; mayCommand: boolean; onCommand: Command; onControl: Control };

function Row({ word, children }: { word: Word; children: any }) {
  return (
    <Fragment>
      <dt>{t(word)}</dt>
      <dd>{children}</dd>
    </Fragment>
  );
}

function Alarms({ alarms }: { alarms: string[] }) {
  if (!alarms?.length) return <p class="fine">{t("no_alarm")}</p>;
  return (
    <ul class="alarms">
      {alarms.map((alarm) => {
        const advice = adviceFor(alarm);
        return (
          <li>
            <b>{alarm}</b>
            {advice && (
              <p>
                {advice.meaning && <span lang="en">{advice.meaning}. </span>}
                <em>
                  {t("what_to_do")}: <span lang="en">{advice.action}</span>
                </em>
              </p>
            )}
          </li>
        );
      })}
    </ul>
  );
}

function Commands({ link, station, mayCommand, onCommand, onControl }: StationProps) {
  const [pan, setPan] = useState("0");
  const [tilt, setTilt] = useState("0");
  const [name, setName] = useState("event");
  const id = station.id;
  const holder = station.control;
  const isMine = holder?.viewer === link.viewer;
  const ask = (question: Word, command: string) => confirm(`${id}: ${t(question)}`) && onCommand(id, command);
  const number = (text: string) => (isFinite(Number(text)) && text.trim() !== "" ? Number(text) : null);
  return (
    <div class="commands">
      <p class="holder">
        {t("control")}: {!holder ? t("control_free") : isMine ? t("control_you") : `${holder.by} ${t("control_other")}`}
        {mayCommand && holder && !isMine && <button onClick={() => onControl(id, true)}>{t("take")}</button>}
        {isMine && <button onClick={() => onControl(id, false)}>{t("give_up")}</button>}
      </p>
      <div class="buttons">
        {!link.replay && (
          <button class="danger" onClick={() => onCommand(id, "stop")}>
            {t("stop")}
          </button>
        )}
        {mayCommand && (
          <Fragment>
            <button onClick={() => onCommand(id, "release")}>{t("release")}</button>
            <button onClick={() => ask("home_sure", "home")}>{t("home")}</button>
            <button onClick={() => onCommand(id, "rearm")}>{t("rearm")}</button>
            <button onClick={() => ask("reference_sure", "reference_ok")}>{t("reference_ok")}</button>
          </Fragment>
        )}
      </div>
      {mayCommand && (
        <Fragment>
          <form
            onSubmit={(e) => {
              e.preventDefault();
              const [p, l] = [number(pan), number(tilt)];
              if (p != null && l != null) onCommand(id, "point", { pan_deg: p, tilt_deg: l });
            }}
          >
            <label>
              {t("pan")}
              <input inputMode="decimal" value={pan} onInput={(e) => setPan(e.currentTarget.value)} />
            </label>
            <label>
              {t("tilt_angle")}
              <input inputMode="decimal" value={tilt} onInput={(e) => setTilt(e.currentTarget.value)} />
            </label>
            <button>{t("point")}</button>
          </form>
          <form
            onSubmit={(e) => {
              e.preventDefault();
              onCommand(id, "record", { before_s: 5, after_s: 5, label: name });
            }}
          >
            <label>
              {t("label")}
              <input value={name} maxLength={40} onInput={(e) => setName(e.currentTarget.value)} />
            </label>
            <button>{t("record")} ±5 s</button>
          </form>
        </Fragment>
      )}
    </div>
  );
}

function Numbers({ word, values }: { word: Word; values: Record<string, number | null> }) {
  return (
    <details>
      <summary>{t(word)}</summary>
      <table class="numbers">
        <tbody>
          {Object.entries(values ?? {}).map(([name, value]) => (
            <tr key={name}>
              <th scope="row">{name}</th>
              <td>{value == null ? DASH : Number(value.toPrecision(8))}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </details>
  );
}

function Details(props: StationProps) {
  const { station: s, link } = props;
  const quarantine = link.site.fusion?.stations?.find((one) => one.id === s.id)?.quarantine;
  return (
    <div class="details">
      <Alarms alarms={s.alarms} />
      {quarantine && (
        <p class="quarantine">
          {t("quarantine")}: {quarantine}
        </p>
      )}
      <Commands {...props} />
      <dl>
        <Row word="pointing">
          {t("azimuth")} {bearing(s.azimuth_deg, 2)} {t("elevation")} {fixed(s.elevation_deg, 2, "°")} · {t("pan")} {fixed(s.pan_deg, 2)} {t("tilt_angle")} {fixed(s.tilt_deg, 2)}
        </Row>
        <Row word="position">
          {fixed(s.latitude_deg, 7)}° {fixed(s.longitude_deg, 7)}° {fixed(s.height_m, 1, " m")}, ±{fixed(s.position_sd_m?.[0], 2, " m")} ({named("v", s.position_source)})
        </Row>
        <Row word="heading">
          {fixed(s.heading_deg, 3, "°")} ±{fixed(s.heading_sd_deg, 4, "°")}
        </Row>
        <Row word="tilt">
          {fixed(s.tilt_x_deg, 3, "°")} {fixed(s.tilt_y_deg, 3, "°")} ±{fixed(s.tilt_sd_deg, 4, "°")} ({named("v", s.tilt_source)})
        </Row>
        <Row word="clock">
          {named("v", s.clock?.state ?? "unknown")} {clockError(s.clock?.error_s ?? null)}
        </Row>
        <Row word="calibration">{calibrationText(s.calibration)}</Row>
        <Row word="latency">{fixed(s.frame_latency_s == null ? null : s.frame_latency_s * 1000, 0, " ms")}</Row>
        <Row word="devices">
          <ul class="devices">
            {s.devices?.map((device) => (
              <li>
                <i class={`dot ${device.state}`} aria-hidden="true" />
                <b>{device.name}</b> {named("v", device.state)}
                {device.text ? `: ${device.text}` : ""}
              </li>
            ))}
          </ul>
        </Row>
        {s.last_error && (
          <Row word="last_error">
            {utc(s.last_error_utime_us)} {s.last_error}
          </Row>
        )}
      </dl>
      <Numbers word="readings" values={s.readings} />
      <Numbers word="counters" values={s.counters} />
    </div>
  );
}

type StationsProps = { link: Link; selected: string; mayCommand: boolean; onSelect: (pick: string) => void; onCommand: Command; onControl: Control };

export function Stations({ link, selected, onSelect, ...rest }: StationsProps) {
  const stations = [...link.site.stations.values()].sort((a, b) => a.id.localeCompare(b.id));
  return (
    <section class="stations" aria-label={t("stations")}>
      <header>
        <h2>{t("stations")}</h2>
      </header>
      <div class="scroll" tabIndex={0} role="group" aria-label={t("stations")}>
        {stations.length === 0 && <p class="nothing">{t("no_station")}</p>}
        {stations.map((s) => {
          const isOpen = selected === s.id;
          const state = s.stale ? "silent" : s.state;
          return (
            <article key={s.id} class={isOpen ? "open" : ""}>
              <h3>
                <button type="button" aria-expanded={isOpen} onClick={() => onSelect(isOpen ? "" : s.id)}>
                  <span class="who">{s.id}</span>
                  <span class={`state ${state}`}>{named("s", state)}</span>
                  <span class="aim">
                    {bearing(s.azimuth_deg)} {fixed(s.elevation_deg, 1, "°")}
                  </span>
                  <span class="belief">
                    <meter min={0} max={1} value={s.belief ?? 0} aria-label={t("belief")} />
                  </span>
                  {s.alarms?.length > 0 && <span class="badge">{s.alarms.length}</span>}
                  {s.control && <span class="hand">{s.control.viewer === link.viewer ? "●" : s.control.by}</span>}
                </button>
              </h3>
              {isOpen && <Details link={link} station={s} {...rest} />}
            </article>
          );
        })}
      </div>
    </section>
  );
}

// ---- history ----------------------------------------------------------------------------------

const KINDS = ["command", "alarm", "error", "site", "console"];

// What was refused is a sentence of its own; of a word to the fusion only the sending is known.
const inOrder = (outcome: string): outcome is "sent" | "done" => outcome === "sent" || outcome === "done";

function EventRow({ event }: { event: SiteEvent }) {
  const kind = event.kind === "alarm_over" ? "alarm" : event.kind;
  return (
    <tr class={`${event.kind} ${event.kind === "command" && event.outcome && !inOrder(event.outcome) ? "refused" : ""}`}>
      <td>{utc(event.utime_us)}</td>
      <td>
        <span class={`kind ${kind}`}>{named("k", event.kind)}</span>
      </td>
      <td>{event.station || DASH}</td>
      <td>
        {event.who && <b>{event.who} </b>}
        {event.text}
        {event.times > 1 && <span class="times"> ×{event.times}</span>}
        {event.kind === "command" && <span class="outcome"> → {inOrder(event.outcome) ? t(event.outcome) : event.outcome || "…"}</span>}
      </td>
    </tr>
  );
}

export function History({ link }: { link: Link }) {
  const [kind, setKind] = useState("");
  const events = link.site.events.filter((e) => !kind || e.kind === kind || (kind === "alarm" && e.kind === "alarm_over")).slice(0, 200);
  return (
    <section class="history" aria-label={t("history")}>
      <header>
        <h2>{t("history")}</h2>
        <label>
          {t("filter")}
          <select value={kind} onChange={(e) => setKind(e.currentTarget.value)}>
            <option value="">{t("all")}</option>
            {KINDS.map((one) => (
              <option value={one}>{named("k", one)}</option>
            ))}
          </select>
        </label>
      </header>
      <div class="scroll" tabIndex={0} role="group" aria-label={t("history")}>
        <table>
          <thead>
            <tr>
              <th>{t("time")}</th>
              <th>{t("kind")}</th>
              <th>{t("station")}</th>
              <th>{t("what")}</th>
            </tr>
          </thead>
          <tbody>
            {events.map((event) => (
              <EventRow key={event.number} event={event} />
            ))}
          </tbody>
        </table>
        {events.length === 0 && <p class="nothing">{t("no_event")}</p>}
      </div>
    </section>
  );
}
