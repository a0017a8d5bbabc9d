// All stations at a glance, one row each: what is kept up, rather than what is seen.

import { h } from "preact";
import { conditionInWords, inWords } from "./conditions";
import { age, clockError, DASH, fixed } from "./format";
import type { Station } from "./site";
import { named, t } from "./words";

function calibration(s: Station): string {
  const state = s.calibration?.state ?? "none";
  const observed = s.calibration?.utime_us;
  return `${named("v", state)}${observed ? `, ${age((s.utime_us - observed) / 1e6)}` : ""}`;
}

// The newest that holds; else the last that is over.
function alarm(s: Station): string {
  if (s.alarms?.length) return conditionInWords(s.alarms[s.alarms.length - 1]) + (s.alarms.length > 1 ? ` (+${s.alarms.length - 1})` : "");
  return s.last_error ? `${inWords(s.last_error)} (${age((s.utime_us - s.last_error_utime_us) / 1e6)})` : DASH;
}

export function Fleet({ stations }: { stations: Station[] }) {
  if (stations.length === 0) return null;
  return (
    <details class="fleet">
      <summary>{t("fleet")}</summary>
      <table>
        <thead>
          <tr>
            {(["station", "version", "calibration", "clock", "disk", "temperature", "alarm"] as const).map((word) => (
              <th key={word}>{t(word)}</th>
            ))}
          </tr>
        </thead>
        <tbody>
          {stations.map((s) => {
            const disk = s.readings?.disk_free_bytes;
            return (
              <tr key={s.id}>
                <th scope="row">{s.id}</th>
                <td>{s.devices?.find((device) => device.name === "software")?.text || DASH}</td>
                <td>{calibration(s)}</td>
                <td>{s.clock?.state === "synchronised" ? clockError(s.clock.error_s) : named("v", s.clock?.state ?? "unknown")}</td>
                <td>{fixed(disk == null ? null : disk / 1e9, 1, " GB")}</td>
                <td>{fixed(s.readings?.cpu_degC, 0, " °C")}</td>
                <td>{alarm(s)}</td>
              </tr>
            );
          })}
        </tbody>
      </table>
    </details>
  );
}
