// What a station does, in words.

import { fixed, utc } from "./format";
import { stationState, type Station } from "./site";
import { named, t } from "./words";

// "hidden for 4 s, back 12:01:07".
export function stateText(station: Station, now_us: number): string {
  const state = stationState(station);
  const since_us = station.hidden_since_utime_us;
  if (state !== "hidden" || !since_us) return named("s", state);
  const until_us = station.hidden_until_utime_us;
  const back = until_us ? `, ${t("hidden_back")} ${utc(until_us)}` : "";
  return `${named("s", state)} ${t("hidden_for")} ${fixed(Math.max(0, now_us - since_us) / 1e6, 0)} s${back}`;
}
