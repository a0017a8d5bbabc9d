// What is wrong, how grave it is, and what to do; and a word to whoever cannot see it begin.

import { h, Fragment } from "preact";
import { useRef } from "preact/hooks";
import { conditionInWords, conditionOf, eventOf, inWords, textOfEvent, type Severity } from "./conditions";
import type { Link } from "./link";
import type { Alarm, SiteEvent } from "./site";
import { named, t } from "./words";

// "`state_folder`" is set as code.
function Coded({ text }: { text: string }) {
  return <Fragment>{text.split("`").map((part, i) => (i % 2 ? <code>{part}</code> : part))}</Fragment>;
}

export function SeverityChip({ severity }: { severity: Severity }) {
  return <span class={`kind ${severity}`}>{named("g", severity)}</span>;
}

export function WhatToDo({ of }: { of: string }) {
  const { meaning, action } = conditionOf(of);
  if (!meaning && !action) return null;
  return (
    <p class="advice">
      {meaning && <Coded text={`${meaning[0].toUpperCase()}${meaning.slice(1)}. `} />}
      {action && (
        <em>
          {t("what_to_do")}: <Coded text={action} />
        </em>
      )}
    </p>
  );
}

export type OnAcknowledge = ((event: SiteEvent) => void) | null; // null: who may only look

// Who looks after it; whoever may says so here.
export function Acknowledgement({ event, onAcknowledge }: { event: SiteEvent | undefined; onAcknowledge: OnAcknowledge }) {
  if (!event) return null;
  if (event.acknowledged) {
    return (
      <span class="acknowledged">
        {t("acknowledged_by")} {inWords(event.acknowledged)}
      </span>
    );
  }
  if (!onAcknowledge || event.over_us != null) return null;
  return (
    <button type="button" class="acknowledge" onClick={() => onAcknowledge(event)}>
      {t("acknowledge")}
    </button>
  );
}

type AlarmsProps = { alarms: Alarm[]; station: string; link: Link; onAcknowledge: OnAcknowledge };

export function Alarms({ alarms, station, link, onAcknowledge }: AlarmsProps) {
  if (!alarms?.length) return <p class="fine">{t("no_alarm")}</p>;
  return (
    <ul class="alarms">
      {alarms.map((alarm) => (
        <li class={conditionOf(alarm.id).severity}>
          <SeverityChip severity={conditionOf(alarm.id).severity} /> <b>{conditionInWords(alarm)}</b>{" "}
          <Acknowledgement event={eventOf(link.site.events, station, alarm.key)} onAcknowledge={onAcknowledge} />
          <WhatToDo of={alarm.id} />
        </li>
      ))}
    </ul>
  );
}

// For screen readers: the newest alarm that has begun since the page was opened.
export function AlarmSpoken({ link }: { link: Link }) {
  const opened_us = useRef(0);
  if (link.isUp) opened_us.current ||= link.time_us;
  const newest = link.site.events.find((event) => event.kind === "alarm");
  return (
    <p key={newest && `${newest.number} ${newest.times}`} class="unseen" role="alert">
      {newest && opened_us.current && newest.utime_us > opened_us.current ? `${t("alarm")}: ${newest.station} ${textOfEvent(newest)}` : ""}
    </p>
  );
}
