// Targets on the map, and what others say of targets.

import type Feature from "ol/Feature";
import LineString from "ol/geom/LineString";
import Point from "ol/geom/Point";
import Polygon from "ol/geom/Polygon";
import { fromLonLat } from "ol/proj";
import { Circle, Fill, Stroke, Style } from "ol/style";
import type { Coordinate } from "ol/coordinate";
import type { Link } from "./link";
import type { Side } from "./labels";
import { Colours, nameAt, offset, shape, stretch } from "./mapfeatures";
import { length, speed } from "./measures";
import { cuesOnMap, isTarget, nameOf, targetState, type Cue, type Target } from "./site";
import { hiddenInShort } from "./statetext";
import { named } from "./words";

const VELOCITY_S = 5;

function ellipseRing(target: Target, at: Coordinate, scale: number): Coordinate[] | null {
  const e = target.ellipse95;
  if (!e) return null;
  const a = (e.azimuth_deg * Math.PI) / 180;
  const ring: Coordinate[] = [];
  for (let i = 0; i <= 64; i++) {
    const u = (2 * Math.PI * i) / 64;
    const along = e.semi_major_m * Math.cos(u);
    const across = e.semi_minor_m * Math.sin(u);
    ring.push([at[0] + scale * (along * Math.sin(a) + across * Math.cos(a)), at[1] + scale * (along * Math.cos(a) - across * Math.sin(a))]);
  }
  return ring;
}

const targetColour = (target: Target, c: Colours) =>
  target.stale || target.state === "coasted" ? c.coasted : target.state === "tentative" ? c.tentative : c.target;

export function targetWords(target: Target, now_us: number): string {
  const moves = target.stale ? named("s", targetState(target)) : speed(target.speed_m_s);
  return `${nameOf(target)}   ${length(target.height_m)}   ${moves}${hiddenInShort(target, now_us)}`;
}
export const cueWords = (cue: Cue) => `${cue.label || cue.id}   ${named(isTarget(cue) ? "h" : "s", cue.state)}`;

export function targetShapes(target: Target, c: Colours, selected: boolean, now_us: number, side?: Side | null): Feature[] {
  if (target.latitude_deg == null) return [];
  const at = fromLonLat([target.longitude_deg, target.latitude_deg]);
  const scale = stretch(target.latitude_deg);
  const colour = targetColour(target, c);
  const out: Feature[] = [];
  const ring = ellipseRing(target, at, scale);
  if (ring) out.push(shape(new Polygon([ring]), new Style({ stroke: new Stroke({ color: colour, width: 1.5 }), fill: new Fill({ color: c.trail.replace(/[\d.]+\)$/, "0.12)") }) })));
  const [east, north] = target.velocity_enu_m_s ?? [];
  if (east != null && north != null && !target.stale) {
    const ahead = [at[0] + east * VELOCITY_S * scale, at[1] + north * VELOCITY_S * scale];
    out.push(shape(new LineString([at, ahead]), new Style({ stroke: new Stroke({ color: colour, width: 2 }) })));
  }
  out.push(
    shape(
      new Point(at),
      [
        new Style({ image: new Circle({ declutterMode: "obstacle", radius: selected ? 12 : 8, stroke: new Stroke({ color: selected ? c.accent : colour, width: 2 }) }) }),
        new Style({ image: new Circle({ declutterMode: "obstacle", radius: 3.5, fill: new Fill({ color: colour }) }), text: nameAt(side, targetWords(target, now_us), c.text, c.halo) }),
      ],
      `target:${target.id}`,
    ),
  );
  return out;
}

// A ring of one deviation, dashed: nothing that this site has measured.
export function cueShapes(link: Link, c: Colours, sides: Map<string, Side | null>): Feature[] {
  const out: Feature[] = [];
  if (link.site.fusion?.stale) return out;
  for (const cue of cuesOnMap(link.site.fusion)) {
    if (cue.latitude_deg == null || cue.longitude_deg == null) continue;
    const at = fromLonLat([cue.longitude_deg, cue.latitude_deg]);
    const colour = cue.state === "searched" ? c.accent : c.tentative;
    const ring: Coordinate[] = [];
    for (let k = 0; k <= 48; k++) ring.push(offset(at, (360 * k) / 48, cue.horizontal_sd_m ?? 0, stretch(cue.latitude_deg)));
    out.push(shape(new LineString(ring), new Style({ stroke: new Stroke({ color: colour, width: 1.5, lineDash: [4, 4] }) })));
    out.push(shape(new Point(at), new Style({ image: new Circle({ declutterMode: "obstacle", radius: 5, stroke: new Stroke({ color: colour, width: 1.5, lineDash: [2, 2] }) }), text: nameAt(sides.get(`cue:${cue.id}`), cueWords(cue), c["rule-text"], c.halo) })));
  }
  return out;
}
