// What is measured in three dimensions: the straight line between two things or places.

import { useEffect, useState } from "preact/hooks";
import { bearing, fixed } from "./format";
import { distance } from "./measures";
import type { Scene, Vector } from "./scene3d";
import { t } from "./words";

// An end of what is measured: a thing, which may move, or a place on the ground.
type End = { id: string; at: Vector };

function measured([a, b]: Vector[]): string {
  const [east, north, up] = b.map((v, i) => v - a[i]);
  const flat = Math.hypot(east, north);
  const azimuth = ((Math.atan2(east, north) * 180) / Math.PI + 360) % 360;
  const elevation = (Math.atan2(up, flat) * 180) / Math.PI;
  return `${distance(Math.hypot(flat, up))}   ${bearing(azimuth)}   ${t("elevation")} ${fixed(elevation, 1, "°")}`;
}

export function useRuler(isMeasuring: boolean, onMeasured: (text: string) => void) {
  const [ends, setEnds] = useState<End[]>([]);
  useEffect(() => setEnds([]), [isMeasuring]);
  const add = (end: End) => {
    onMeasured("");
    setEnds(ends.length === 1 ? [ends[0], end] : [end]);
  };
  const drawOn = (scene: Scene) => {
    const places = ends.map(({ id, at }) => scene.placeOf(id) ?? at);
    scene.addMeasured(places);
    if (places.length === 2) onMeasured(measured(places));
  };
  return { ends, add, drawOn };
}
