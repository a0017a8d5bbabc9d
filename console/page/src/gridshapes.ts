// Circles around the site and the UTM grid.

import type Feature from "ol/Feature";
import LineString from "ol/geom/LineString";
import Point from "ol/geom/Point";
import { fromLonLat } from "ol/proj";
import { Stroke, Style } from "ol/style";
import type { Coordinate } from "ol/coordinate";
import { gridName } from "./format";
import type { Link } from "./link";
import { Colours, FONT, label, offset, shape, SMALL_FONT, stretch } from "./mapfeatures";
import { ringName, roundStep } from "./measures";

function siteMiddle(link: Link): { at: Coordinate; latitude: number } | null {
  const placed = [...link.site.stations.values()].filter((s) => s.latitude_deg != null && s.longitude_deg != null);
  if (!placed.length) return null;
  const latitude = placed.reduce((sum, s) => sum + s.latitude_deg!, 0) / placed.length;
  const longitude = placed.reduce((sum, s) => sum + s.longitude_deg!, 0) / placed.length;
  return { at: fromLonLat([longitude, latitude]), latitude };
}

// Whether a label there, with its offset [px], can be read.
export type HasRoom = (at: Coordinate, text: string, dx: number, dy: number) => boolean;

// At the first of the places where it can be read, if there is one.
function labelled(places: Coordinate[], text: string, [dx, dy]: [number, number], c: Colours, hasRoom: HasRoom, font = SMALL_FONT): Feature[] {
  const at = places.find((place) => hasRoom(place, text, dx, dy));
  return at ? [shape(new Point(at), new Style({ text: label(text, c["rule-text"], c.halo, dx, dy, font) }))] : [];
}

// Circles about the site, two to five of them within the view, of round radii.
export function ringShapes(link: Link, c: Colours, view_m: number, hasRoom: HasRoom): Feature[] {
  const middle = siteMiddle(link);
  if (!middle) return [];
  const step = roundStep(view_m / 8);
  const out: Feature[] = [];
  const scale = stretch(middle.latitude);
  for (let i = 1; i <= 6; i++) {
    const ring: Coordinate[] = [];
    for (let k = 0; k <= 96; k++) ring.push(offset(middle.at, (360 * k) / 96, step * i, scale));
    out.push(shape(new LineString(ring), new Style({ stroke: new Stroke({ color: c.ring, width: 1 }) })));
    const sides = [0, 90, 180, 270].map((azimuth) => offset(middle.at, azimuth, step * i, scale));
    out.push(...labelled(sides, ringName(step, i), [4, -7], c, hasRoom));
  }
  return out;
}

export type Grid = { zone: number; northern: boolean; step_m: number; lines: { at_m: number; is_easting: boolean; path: [number, number][] }[]; squares: { name: string; at: [number, number] }[] };

export function gridShapes(grid: Grid | null, c: Colours, hasRoom: HasRoom): Feature[] {
  if (!grid) return [];
  const out: Feature[] = [];
  for (const line of grid.lines) {
    const path = line.path.map((place) => fromLonLat(place));
    out.push(shape(new LineString(path), new Style({ stroke: new Stroke({ color: c.grid, width: 1 }) })));
    const text = gridName(line.at_m, grid.step_m) + (line.is_easting ? " E" : " N");
    out.push(...labelled(path.slice(1, -1), text, [3, -6], c, hasRoom));
  }
  for (const { name, at } of grid.squares) out.push(...labelled([fromLonLat(at)], name, [0, 0], c, hasRoom, FONT));
  return out;
}
