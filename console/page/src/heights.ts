// Trails in the colours of their heights, whoever draws them.

import { stretches, wasHidden, type Target, type TrailPoint } from "./site";

export const HIDDEN_DASH = [5, 5];
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

type Run = { step: number; isHidden: boolean; places: TrailPoint[] };

// A stretch of a trail in parts of one colour, hidden or not; each begins where the one before ends.
export function runsOf(places: TrailPoint[], range: HeightRange, steps: number, selected: string): Run[] {
  const runs: Run[] = [];
  for (let i = 1; i < places.length; i++) {
    const step = stepOf((places[i - 1][2] + places[i][2]) / 2, range, steps);
    const last = runs[runs.length - 1];
    const isHidden = wasHidden(places[i], selected);
    if (last?.step === step && last.isHidden === isHidden) last.places.push(places[i]);
    else runs.push({ step, isHidden, places: [places[i - 1], places[i]] });
  }
  return runs;
}
