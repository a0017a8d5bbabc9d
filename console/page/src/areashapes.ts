// Areas on the map: those that are watched, and the one that is being drawn.

import type Feature from "ol/Feature";
import Polygon from "ol/geom/Polygon";
import Point from "ol/geom/Point";
import { fromLonLat } from "ol/proj";
import { Circle, Fill, Stroke, Style } from "ol/style";
import type { Coordinate } from "ol/coordinate";
import { Colours, label, shape } from "./mapfeatures";
import { isInside, type Corner, type Site } from "./site";

// On the map, across the antimeridian where that is the shorter way.
function ring(corners: Corner[]): Coordinate[] {
  let last_deg = corners[0]?.[0] ?? 0;
  return corners.map(([longitude_deg, latitude_deg]) => {
    last_deg += ((((longitude_deg - last_deg + 180) % 360) + 360) % 360) - 180;
    return fromLonLat([last_deg, latitude_deg]);
  });
}

export function areaShapes(site: Site, c: Colours): Feature[] {
  const entered = new Set([...site.incidents.values()].filter(isInside).map((one) => one.area));
  return [...site.areas.values()].flatMap((area) => {
    const corners = ring(area.polygon);
    const colour = entered.has(area.name) ? c.alarm : c.accent;
    const north = corners.reduce((a, b) => (b[1] > a[1] ? b : a));
    return [
      shape(new Polygon([corners]), new Style({ fill: entered.has(area.name) ? new Fill({ color: c["keep-out"] }) : undefined, stroke: new Stroke({ color: colour, width: 2, lineDash: [8, 5] }) })),
      shape(new Point(north), new Style({ text: label(area.name, colour, c.halo, 6, -8) })),
    ];
  });
}

export function draftShapes(corners: Corner[], c: Colours): Feature[] {
  const points = ring(corners);
  const dot = new Style({ image: new Circle({ radius: 5, fill: new Fill({ color: c.accent }), stroke: new Stroke({ color: c.halo, width: 2 }) }) });
  const line = new Style({ fill: new Fill({ color: c.wedge }), stroke: new Stroke({ color: c.accent, width: 2 }) });
  return [...(points.length > 1 ? [shape(new Polygon([points]), line)] : []), ...points.map((at) => shape(new Point(at), dot))];
}
