// Where targets have been, on the map, each part in the colour of its height.

import type Feature from "ol/Feature";
import MultiLineString from "ol/geom/MultiLineString";
import { fromLonLat } from "ol/proj";
import { Stroke, Style } from "ol/style";
import type { Coordinate } from "ol/coordinate";
import { shape } from "./mapfeatures";
import { stretches, type Target } from "./site";

const LEAST_SPAN_M = 20; // a target that keeps its height does not run through all colours

export type HeightRange = [number, number]; // lowest, highest [m]

// Of all trails, so that a colour is the same height everywhere.
export function heightRange(targets: Target[]): HeightRange | null {
  const range: HeightRange = [Infinity, -Infinity];
  for (const target of targets) {
    for (const [, , height_m] of target.latitude_deg == null ? [] : stretches(target).flat()) {
      range[0] = Math.min(range[0], height_m);
      range[1] = Math.max(range[1], height_m);
    }
  }
  if (range[0] > range[1]) return null;
  const missing_m = Math.max(0, LEAST_SPAN_M - (range[1] - range[0]));
  return [range[0] - missing_m / 2, range[1] + missing_m / 2];
}

// Which of so many colours a height has, the lowest first.
export function stepOf(height_m: number, [lowest, highest]: HeightRange, steps: number): number {
  return Math.max(0, Math.min(steps - 1, Math.floor((steps * (height_m - lowest)) / (highest - lowest))));
}

// A few features for all targets, however many and long their trails.
export function trailShapes(targets: Target[], colours: string[], selected: string): Feature[] {
  const range = heightRange(targets);
  if (!range) return [];
  const parts = { plain: colours.map((): Coordinate[][] => []), selected: colours.map((): Coordinate[][] => []) };
  for (const target of targets) {
    const of = parts[selected === `target:${target.id}` ? "selected" : "plain"];
    for (const places of target.latitude_deg == null ? [] : stretches(target)) {
      for (let i = 1; i < places.length; i++) {
        const ends = [places[i - 1], places[i]].map(([longitude, latitude]) => fromLonLat([longitude, latitude]));
        of[stepOf((places[i - 1][2] + places[i][2]) / 2, range, colours.length)].push(ends);
      }
    }
  }
  const draw = (lines: Coordinate[][], i: number, width: number) => (lines.length ? [shape(new MultiLineString(lines), new Style({ stroke: new Stroke({ color: colours[i], width }) }))] : []);
  return [...parts.plain.flatMap((lines, i) => draw(lines, i, 1.75)), ...parts.selected.flatMap((lines, i) => draw(lines, i, 3))];
}
