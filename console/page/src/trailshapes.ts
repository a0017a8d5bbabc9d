// Where targets have been, on the map, each part in the colour of its height.

import type Feature from "ol/Feature";
import MultiLineString from "ol/geom/MultiLineString";
import { fromLonLat } from "ol/proj";
import { Stroke, Style } from "ol/style";
import type { Coordinate } from "ol/coordinate";
import { heightRange, runsOf } from "./heights";
import { shape } from "./mapfeatures";
import { stretches, type Target } from "./site";

// A few features for all targets, however many and long their trails.
export function trailShapes(targets: Target[], colours: string[], selected: string): Feature[] {
  const range = heightRange(targets);
  if (!range) return [];
  const parts = { plain: colours.map((): Coordinate[][] => []), selected: colours.map((): Coordinate[][] => []) };
  for (const target of targets) {
    const of = parts[selected === `target:${target.id}` ? "selected" : "plain"];
    for (const stretch of target.latitude_deg == null ? [] : stretches(target)) {
      for (const { step, places } of runsOf(stretch, range, colours.length)) of[step].push(places.map(([longitude, latitude]) => fromLonLat([longitude, latitude])));
    }
  }
  const draw = (lines: Coordinate[][], i: number, width: number) => (lines.length ? [shape(new MultiLineString(lines), new Style({ stroke: new Stroke({ color: colours[i], width }) }))] : []);
  return [...parts.plain.flatMap((lines, i) => draw(lines, i, 1.75)), ...parts.selected.flatMap((lines, i) => draw(lines, i, 3))];
}
