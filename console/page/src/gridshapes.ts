// Circles around the site and the UTM grid.

import type Feature from "ol/Feature";
import LineString from "ol/geom/LineString";
import Point from "ol/geom/Point";
import { fromLonLat } from "ol/proj";
import { Stroke, Style } from "ol/style";
import type { Coordinate } from "ol/coordinate";
import { gridName } from "./format";
import type { Link } from "./link";
import { Colours, label, offset, shape, SMALL_FONT, stretch } from "./mapfeatures";
import { distance } from "./measures";

function siteMiddle(link: Link): { at: Coordinate; latitude: number } | null {
  const placed = [...link.site.stations.values()].filter((s) => s.latitude_deg != null && s.longitude_deg != null);
  if (!placed.length) return null;
  const latitude = placed.reduce((sum, s) => sum + s.latitude_deg!, 0) / placed.length;
  const longitude = placed.reduce((sum, s) => sum + s.longitude_deg!, 0) / placed.length;
  return { at: fromLonLat([longitude, latitude]), latitude };
}

// Three to six circles in view, of round radii.
export function ringShapes(link: Link, c: Colours, view_m: number): Feature[] {
  const middle = siteMiddle(link);
  if (!middle) return [];
  let step = 10 ** Math.floor(Math.log10(Math.max(view_m / 5, 1)));
  for (const part of [2, 5]) if (view_m / (step * part) > 4) step *= part === 2 ? 2 : 2.5;
  const out: Feature[] = [];
  const scale = stretch(middle.latitude);
  for (let i = 1; i <= 6; i++) {
    const ring: Coordinate[] = [];
    for (let k = 0; k <= 96; k++) ring.push(offset(middle.at, (360 * k) / 96, step * i, scale));
    out.push(shape(new LineString(ring), new Style({ stroke: new Stroke({ color: c.ring, width: 1 }) })));
    out.push(shape(new Point(offset(middle.at, 0, step * i, scale)), new Style({ text: label(distance(step * i), c["rule-text"], c.halo, 4, -7, SMALL_FONT) })));
  }
  return out;
}

export type Grid = { zone: number; northern: boolean; step_m: number; lines: { at_m: number; is_easting: boolean; path: [number, number][] }[]; squares: { name: string; at: [number, number] }[] };

export function gridShapes(grid: Grid | null, c: Colours): Feature[] {
  if (!grid) return [];
  const out: Feature[] = [];
  for (const line of grid.lines) {
    const path = line.path.map((place) => fromLonLat(place));
    out.push(shape(new LineString(path), new Style({ stroke: new Stroke({ color: c.grid, width: 1 }) })));
    if (path.length < 3) continue;
    const text = gridName(line.at_m, grid.step_m) + (line.is_easting ? " E" : " N");
    out.push(shape(new Point(path[1]), new Style({ text: label(text, c["rule-text"], c.halo, 3, -6, SMALL_FONT) })));
  }
  for (const { name, at } of grid.squares) out.push(shape(new Point(fromLonLat(at)), new Style({ text: label(name, c["rule-text"], c.halo, 0, 0) })));
  return out;
}
