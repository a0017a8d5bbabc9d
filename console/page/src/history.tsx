// What happened: commands, alarms and errors, the newest first; an alarm is one row from its beginning to its
// end.

import { h, Fragment } from "preact";
import { useState } from "preact/hooks";
import { Acknowledgement, type OnAcknowledge, SeverityChip, WhatToDo } from "./alarms";
import { alarmOf, conditionInWords, conditionOf, holds, inWords, textOfEvent } from "./conditions";
import { DASH, utc } from "./format";
import type { Link } from "./link";
import type { SiteEvent } from "./site";
import { named, t } from "./words";

const KINDS = ["command", "alarm", "error", "site", "console"];

// Of a word to the fusion only the sending is known.
const outcomeOf = ({ refusal, outcome }: SiteEvent) => (refusal ? conditionInWords(refusal) : outcome ? t(outcome as "sent" | "done") : "…");

// An order by itself is told by its name.
const textOf = (event: SiteEvent) => (event.kind === "command" && !event.said ? named("o", event.text) : textOfEvent(event));

function AlarmText({ event, onAcknowledge }: { event: SiteEvent; onAcknowledge: OnAcknowledge }) {
  return (
    <Fragment>
      {" "}
      <span class="span">{event.over_us == null ? t("holds") : `${t("until")} ${utc(event.over_us)}`}</span>{" "}
      <Acknowledgement event={event} onAcknowledge={onAcknowledge} />
      {holds(event) && <WhatToDo of={alarmOf(event)} />}
    </Fragment>
  );
}

function EventRow({ event, onAcknowledge }: { event: SiteEvent; onAcknowledge: OnAcknowledge }) {
  const isAlarm = event.kind === "alarm";
  const isRefused = event.kind === "command" && event.refusal;
  return (
    <tr class={`${event.kind} ${isAlarm && !holds(event) ? "over" : ""} ${isRefused ? "refused" : ""}`}>
      <td>{utc(event.utime_us)}</td>
      <td>{isAlarm ? <SeverityChip severity={conditionOf(alarmOf(event)).severity} /> : <span class={`kind ${event.kind}`}>{named("k", event.kind)}</span>}</td>
      <td>{event.station || DASH}</td>
      <td>
        {event.who && <b>{inWords(event.who)} </b>}
        {textOf(event)}
        {event.times > 1 && <span class="times"> ×{event.times}</span>}
        {event.kind === "command" && <span class="outcome"> → {outcomeOf(event)}</span>}
        {isAlarm && <AlarmText event={event} onAcknowledge={onAcknowledge} />}
      </td>
    </tr>
  );
}

export function History({ link, onAcknowledge }: { link: Link; onAcknowledge: OnAcknowledge }) {
  const [kind, setKind] = useState("");
  const events = link.site.events.filter((e) => !kind || e.kind === kind).slice(0, 200);
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
              <EventRow key={event.number} event={event} onAcknowledge={onAcknowledge} />
            ))}
          </tbody>
        </table>
        {events.length === 0 && <p class="nothing">{t("no_event")}</p>}
      </div>
    </section>
  );
}
