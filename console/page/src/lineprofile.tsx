// The land below a station's line of sight to a target or a place, and where it is in the way.

import { h } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { problemOf, type HttpAnswer } from "./conditions";
import { askLand, useLand } from "./land";
import type { Link } from "./link";
import { distance, length } from "./measures";
import type { Place } from "./panel";
import { drawn, HEIGHT, profileText, WIDTH, type Profile } from "./profile";
import { t } from "./words";

const AGAIN_MS = 1000; // a target moves on

// Asked for anew when the station or the place changes, at most once a second.
function useProfile(station: string, { latitude_deg, longitude_deg, height_m }: Place): (Profile & HttpAnswer) | null {
  const [profile, setProfile] = useState<(Profile & HttpAnswer) | null>(null);
  const asked = useRef({ path: "", station: "", ms: -Infinity });
  const path = `/profile/${encodeURIComponent(station)}?to=${latitude_deg.toFixed(6)},${longitude_deg.toFixed(6)},${height_m.toFixed(1)}`;
  useEffect(() => {
    const now_ms = performance.now();
    const { current } = asked;
    if (path === current.path || (station === current.station && now_ms < current.ms + AGAIN_MS)) return;
    if (station !== current.station) setProfile(null);
    asked.current = { path, station, ms: now_ms };
    void askLand<Profile>(path).then((found) => asked.current.station === station && setProfile(found));
  });
  return profile;
}

function Plot({ station, profile }: { station: string; profile: Profile }) {
  const { ground, top, seen, blocked, lowest, highest } = drawn(profile);
  const said = profileText(profile);
  return (
    <figure class="line-profile">
      <svg viewBox={`0 0 ${WIDTH} ${HEIGHT}`} role="img" aria-label={`${t("line_from")} ${station}: ${said}`}>
        <path class="ground" d={ground} />
        <path class="top" d={top} />
        <path class="seen" d={seen} />
        <path class="blocked" d={blocked} />
      </svg>
      <figcaption>
        <b class={profile.blocked_m == null ? "" : "blocked"}>{said}</b>
        <span>{distance(profile.points[profile.points.length - 1][0])}</span>
        <span>{`${length(lowest)} – ${length(highest)}`}</span>
      </figcaption>
    </figure>
  );
}

function FromStation({ station, place }: { station: string; place: Place }) {
  const profile = useProfile(station, place);
  if (!profile) return null;
  return profile.points ? <Plot station={station} profile={profile} /> : <p class="map-problem">{problemOf(profile)}</p>;
}

// From the station that is selected, or from another one; nothing while no land is known.
export function LineProfile({ link, station, place }: { link: Link; station: string; place: Place }) {
  const [chosen, setChosen] = useState("");
  useEffect(() => setChosen(""), [station]);
  const land = useLand(link);
  const ids = [...link.site.stations.keys()].sort();
  const from = [chosen, station, ids[0]].find((one) => one && ids.includes(one));
  if (!land || !from) return null;
  return (
    <div class="line-of-sight">
      <label>
        {t("line_from")}{" "}
        <select aria-label={t("line_from")} value={from} onChange={(e) => setChosen(e.currentTarget.value)}>
          {ids.map((id) => (
            <option value={id}>{id}</option>
          ))}
        </select>
      </label>
      <FromStation station={from} place={place} />
    </div>
  );
}
