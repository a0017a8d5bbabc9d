// What everything on the map is drawn with: colours, labels, lengths on the ground.

import Feature from "ol/Feature";
import LineString from "ol/geom/LineString";
import MultiLineString from "ol/geom/MultiLineString";
import Point from "ol/geom/Point";
import Polygon from "ol/geom/Polygon";
import { Fill, Stroke, Style, Text } from "ol/style";
import type { Coordinate } from "ol/coordinate";
import { OFFSETS, type Side } from "./labels";

export type Colours = Record<string, string>;
const COLOUR_NAMES = ["land", "sea", "rule", "rule-text", "grid", "text", "halo", "station", "station-quiet", "ray", "wedge", "target", "tentative", "coasted", "trail", "ring", "accent", "alarm", "keep-out"];

export function readColours(): Colours {
  const style = getComputedStyle(document.documentElement);
  return Object.fromEntries(COLOUR_NAMES.map((name) => [name, style.getPropertyValue(`--map-${name}`).trim()]));
}

// Of the lowest to the highest.
export function heightColours(): string[] {
  return getComputedStyle(document.documentElement).getPropertyValue("--map-heights").trim().split(/\s+/);
}

export const FONT = "600 12px Inter, system-ui, 'DejaVu Sans', sans-serif";
export const SMALL_FONT = "11px Inter, system-ui, 'DejaVu Sans', sans-serif";

// Web Mercator is conformal: what is metres on the ground is this much on the map, in any direction.
export const stretch = (latitude_deg: number) => 1 / Math.cos((latitude_deg * Math.PI) / 180);

export function offset(from: Coordinate, azimuth_deg: number, metres: number, scale: number): Coordinate {
  const a = (azimuth_deg * Math.PI) / 180;
  return [from[0] + Math.sin(a) * metres * scale, from[1] + Math.cos(a) * metres * scale];
}

export function shape(geometry: Point | LineString | MultiLineString | Polygon, style: Style | Style[], id = ""): Feature {
  const feature = new Feature(geometry);
  feature.setStyle(style);
  if (id) feature.set("pick", id);
  return feature;
}

const words = (text: string, colour: string, halo: string, font: string) => ({ text, font, fill: new Fill({ color: colour }), stroke: new Stroke({ color: halo, width: 3 }) });

// A name beside its point; none where there is no room.
export function nameAt(side: Side | null | undefined, text: string, colour: string, halo: string): Text | undefined {
  if (!side) return undefined;
  const [dx, dy] = OFFSETS[side];
  const textAlign = side === "right" ? "left" : side === "left" ? "right" : "center";
  return new Text({ ...words(text, colour, halo, FONT), offsetX: dx, offsetY: dy, textAlign, declutterMode: "obstacle" });
}

export const label = (text: string, colour: string, halo: string, dx: number, dy: number, font = FONT) =>
  new Text({ ...words(text, colour, halo, font), offsetX: dx, offsetY: dy, textAlign: dx >= 0 ? "left" : "right" });
