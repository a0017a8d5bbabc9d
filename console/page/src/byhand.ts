// Who turns a station: itself, as long as it follows something, or an operator's hand.

import type { Site, Station } from "./site";

const AT_WORK = ["tracking", "coasting", "slewed", "hidden"];

// It follows its target, or is led to one: a hand on its picture would end that.
export const isAtWork = (station: Station) => AT_WORK.includes(station.state);

// It has followed something, which it finds again if it is released soon.
export const canGoBack = (station: Station) => station.state === "manual" && (station.track_id ?? "0") !== "0";

export const stopped = (site: Site) => namesOf(site, (station) => station.state === "stopped");

// Stations that nobody can lead to their object: no target has a position.
export function lostForAll(site: Site): string[] {
  if ([...site.targets.values()].some((target) => !target.stale)) return [];
  return namesOf(site, (station) => station.state === "lost");
}

function namesOf(site: Site, isMeant: (station: Station) => boolean): string[] {
  return [...site.stations.values()].filter((station) => !station.stale && isMeant(station)).map((station) => station.id).sort();
}
