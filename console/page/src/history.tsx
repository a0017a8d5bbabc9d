// What happened: commands, alarms and errors, the newest first.

import { h } from "preact";
import { useState } from "preact/hooks";
import { DASH, utc } from "./format";
import type { Link } from "./link";
import type { SiteEvent } from "./site";
import { named, t } from "./words";

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
