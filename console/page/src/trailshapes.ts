// Where targets have been, on the map, each part in the colour of its height; dashed where the land hid them.

import type Feature from "ol/Feature";
import MultiLineString from "ol/geom/MultiLineString";
import { fromLonLat } from "ol/proj";
import { Stroke, Style } from "ol/style";
import type { Coordinate } from "ol/coordinate";
import { heightRange, HIDDEN_DASH, runsOf } from "./heights";
import { shape } from "./mapfeatures";
import { stretches, type Target } from "./site";

// A few features for all targets, however many and long their trails.
export function trailShapes(targets: Target[], colours: string[], selected: string): Feature[] {
  const range = heightRange(targets);
  if (!range) return [];
  const part = () => colours.map((): [Coordinate[][], Coordinate[][]] => [[], []]); // seen, hidden
  const parts = { plain: part(), selected: part() };
  for (const target of targets) {
    const of = parts[selected === `target:${target.id}` ? "selected" : "plain"];
    for (const stretch of target.latitude_deg == null ? [] : stretches(target)) {
      for (const { step, isHidden, places } of runsOf(stretch, range, colours.length, selected)) of[step][Number(isHidden)].push(places.map(([longitude, latitude]) => fromLonLat([longitude, latitude])));
    }
  }
  const draw = (lines: Coordinate[][], color: string, width: number, lineDash?: number[]) => (lines.length ? [shape(new MultiLineString(lines), new Style({ stroke: new Stroke({ color, width, lineDash, lineCap: lineDash ? "butt" : "round" }) }))] : []);
  const drawBoth = (width: number) => ([seen, hidden]: [Coordinate[][], Coordinate[][]], i: number) => [...draw(seen, colours[i], width), ...draw(hidden, colours[i], width, HIDDEN_DASH)];
  return [...parts.plain.flatMap(drawBoth(1.75)), ...parts.selected.flatMap(drawBoth(3))];
}
