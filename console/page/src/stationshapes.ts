// Stations on the map: where they stand, look and may look, and what they see.

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
import { fineOutline } from "./marks";
import type { Border, Station } from "./site";
import { stationWords } from "./statetext";

const RAY_M = 20_000;
const WEDGE_M = 2_000;

// The travel's end in azimuth, unless it goes nearly all round, and the sectors of keep-out regions: what they
// are in elevation, the picture shows.
function borderShapes(at: Coordinate, borders: Border[], c: Colours, radius_m: number, scale: number): Feature[] {
  const out: Feature[] = [];
  for (const border of borders) {
    const azimuths = fineOutline(border).map((point) => point[0]);
    const [least, most] = [Math.min(...azimuths), Math.max(...azimuths)];
    if (most - least > 350) continue;
    const radius = border.keep_out ? radius_m : 1.1 * radius_m;
    const arc: Coordinate[] = [];
    const steps = Math.ceil((most - least) / 5) + 1;
    for (let i = 0; i <= steps; i++) arc.push(offset(at, least + ((most - least) * i) / steps, radius, scale));
    const ring = [at, ...arc, at];
    if (border.keep_out) out.push(shape(new Polygon([ring]), new Style({ fill: new Fill({ color: c["keep-out"] }), stroke: new Stroke({ color: c.alarm, width: 1.5, lineDash: [7, 4] }) })));
    else out.push(shape(new LineString(ring), new Style({ stroke: new Stroke({ color: c.ring, width: 1.5, lineDash: [2, 5] }) })));
  }
  return out;
}

export function stationShapes(s: Station, c: Colours, selected: boolean, views: boolean, border_m: number | null, now_us: number, side?: Side | null): Feature[] {
  if (s.latitude_deg == null || s.longitude_deg == null) return [];
  const at = fromLonLat([s.longitude_deg, s.latitude_deg]);
  const scale = stretch(s.latitude_deg);
  const colour = s.stale ? c["station-quiet"] : s.alarms?.length || s.state === "emergency" ? c.alarm : c.station;
  const out: Feature[] = [];
  const fov = s.field_of_view_deg?.[0];
  if (views && !s.stale && s.azimuth_deg != null && fov) {
    const half = Math.min(fov, 120) / 2;
    const ring = [at];
    for (let i = 0; i <= 12; i++) ring.push(offset(at, s.azimuth_deg - half + (fov * i) / 12, WEDGE_M, scale));
    ring.push(at);
    out.push(shape(new Polygon([ring]), new Style({ fill: new Fill({ color: c.wedge }), stroke: new Stroke({ color: c.wedge, width: 1 }) })));
  }
  if (border_m) out.push(...borderShapes(at, s.borders ?? [], c, border_m, scale));
  const sees = s.state === "tracking" && s.bearing;
  if (sees && !s.stale) {
    const far = offset(at, s.bearing!.azimuth_deg, RAY_M, scale);
    out.push(shape(new LineString([at, far]), new Style({ stroke: new Stroke({ color: c.ray, width: selected ? 2 : 1.2 }) }), `sight:${s.id}`));
  }
  out.push(
    shape(
      new Point(at),
      [
        new Style({ image: new Circle({ declutterMode: "obstacle", radius: selected ? 11 : 8, stroke: new Stroke({ color: selected ? c.accent : "transparent", width: 2 }) }) }),
        new Style({ image: new Circle({ declutterMode: "obstacle", radius: 6, fill: new Fill({ color: colour }), stroke: new Stroke({ color: c.halo, width: 2 }) }), text: nameAt(side, stationWords(s, now_us), c.text, c.halo) }),
      ],
      `station:${s.id}`,
    ),
  );
  return out;
}

// Lines of sight of stations whose object has no position yet.
export function lineShapes(link: Link, c: Colours): Feature[] {
  const out: Feature[] = [];
  for (const line of link.site.lines.values()) {
    const s = link.site.stations.get(line.id);
    if (line.stale || !s || s.latitude_deg == null || s.longitude_deg == null) continue;
    const at = fromLonLat([s.longitude_deg, s.latitude_deg]);
    const far = offset(at, line.azimuth_deg, RAY_M, stretch(s.latitude_deg));
    out.push(shape(new LineString([at, far]), new Style({ stroke: new Stroke({ color: c.tentative, width: 1.5, lineDash: [8, 6] }) })));
  }
  return out;
}
