// What lies over the map and covers what is drawn there: its tools, its scale, the panel of what is selected.

import type OlMap from "ol/Map";
import type { Extent } from "ol/extent";
import type { Box } from "./labels";

const PANEL = ".map-panel";
const OVER = [PANEL, ".map-tools > *", ".layers[open] div", ".map-north", ".map-measure", ".map-ground", ".legend", ".ol-scale-line", ".view-3d-tools"];
const LEAST_FREE_PX = 160;

// [px], from the map's corner.
export function boxesOver(map: Element, which = OVER.join()): Box[] {
  const frame = map.getBoundingClientRect();
  const boxes = [...map.closest(".views")!.querySelectorAll(which)].map((one) => one.getBoundingClientRect());
  return boxes.filter((one) => one.width > 0).map((one) => [one.x - frame.x, one.y - frame.y, one.width, one.height]);
}

// What is beyond the edges covers too.
export function beyond(width: number, height: number): Box[] {
  const FAR = 1e5;
  return [[-FAR, -FAR, FAR, 2 * FAR], [width, -FAR, FAR, 2 * FAR], [-FAR, -FAR, 2 * FAR, FAR], [-FAR, height, 2 * FAR, FAR]];
}

// How much of the map's right side the panel takes: what is looked at has its middle in the rest. None where the
// panel is beside the map, or leaves too little of it.
export function takenByPanel(map: Element): number {
  const { width, height } = map.getBoundingClientRect();
  const [panel] = boxesOver(map, PANEL);
  if (!panel || panel[1] < 0 || panel[1] >= height || panel[0] < LEAST_FREE_PX) return 0;
  return Math.max(0, width - panel[0]);
}

// All that is on the screen, under the panel too, for which the view has its padding.
export function shownExtent(map: OlMap): Extent {
  const view = map.getView();
  const [west, south, east, north] = view.calculateExtent(map.getSize());
  const by = ((view.padding?.[1] ?? 0) / 2) * (view.getResolution() ?? 1);
  return [west + by, south, east + by, north];
}
