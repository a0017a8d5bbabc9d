// What a station does, in words.

import { fixed, utc } from "./format";
import { stationState, targetState, type Station, type Target } from "./site";
import { named, t } from "./words";

// "hidden for 4 s, back 12:01:07".
export function stateText(station: Station, now_us: number): string {
  const state = stationState(station);
  const since_us = station.hidden_since_utime_us;
  if (state !== "hidden" || !since_us) return named("s", state);
  return `${named("s", state)} ${forAndBack(since_us, station.hidden_until_utime_us ?? 0, now_us)}`;
}

function forAndBack(since_us: number, back_us: number, now_us: number): string {
  const back = back_us ? `, ${t("hidden_back")} ${utc(back_us)}` : "";
  return `${t("hidden_for")} ${fixed(Math.max(0, now_us - since_us) / 1e6, 0)} s${back}`;
}

// "alfa for 4 s, back 12:01:07; bravo for 2 s"; empty: the land hides the target from nobody.
export function hiddenText(target: Target, now_us: number): string {
  return (target.hidden?.from ?? []).map((one) => `${one.id} ${forAndBack(one.since_us, one.back_us, now_us)}`).join("; ");
}

// On the map, behind the target's name: "hidden for 4 s", or from whom.
export function hiddenInShort(target: Target, now_us: number): string {
  if (!target.hidden || targetState(target) === "stale") return "";
  const { from, all } = target.hidden;
  const since_us = Math[all ? "max" : "min"](...from.map((one) => one.since_us));
  const whom = all ? named("s", "hidden") : `${t("hidden_from")} ${from.map((one) => one.id).join(", ")}`;
  return `   ${whom} ${forAndBack(since_us, 0, now_us)}`;
}

// A station's name on the map: "alfa   hidden for 4 s".
export function stationWords(station: Station, now_us: number): string {
  return stationState(station) === "hidden" ? `${station.id}   ${stateText(station, now_us).split(",")[0]}` : station.id;
}
