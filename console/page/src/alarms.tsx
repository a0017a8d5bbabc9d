// What is wrong, and what to do; and a word to whoever cannot see it begin.

import { h } from "preact";
import { useRef } from "preact/hooks";
import { adviceFor } from "./advice";
import type { Link } from "./link";
import { t } from "./words";

export function Alarms({ alarms }: { alarms: string[] }) {
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

// For screen readers: the newest alarm that has begun since the page was opened.
export function AlarmSpoken({ link }: { link: Link }) {
  const opened_us = useRef(0);
  if (link.isUp) opened_us.current ||= link.time_us;
  const newest = link.site.events.find((event) => event.kind === "alarm");
  return (
    <p key={newest && `${newest.number} ${newest.times}`} class="unseen" role="alert">
      {newest && opened_us.current && newest.utime_us > opened_us.current ? `${t("alarm")}: ${newest.station} ${newest.text}` : ""}
    </p>
  );
}
