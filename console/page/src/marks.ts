// What else is in a station's picture: the targets and the other stations, where the camera of this very
// picture sees them.

import { bearing, fixed } from "./format";
import type { Picture } from "./link";
import { axisOf, ecef, moved, offAxis_deg, pixelOf, towards } from "./projection";
import type { Border, Site, Target } from "./site";

export type Mark = { kind: "target" | "station"; name: string; at: [number, number] };

const OLD_US = 2e6; // a target is not carried on for longer than this

// At the instant of the picture, as it moves.
function placeOf(target: Target, utime_us: number): number[] | null {
  const ahead_s = (utime_us - target.utime_us) / 1e6;
  if (target.stale || target.latitude_deg == null || Math.abs(utime_us - target.utime_us) > OLD_US) return null;
  const place = ecef(target.latitude_deg, target.longitude_deg, target.height_m);
  const way = target.velocity_enu_m_s.map((v) => (v ?? 0) * ahead_s);
  return moved(place, target.latitude_deg, target.longitude_deg, way);
}

export function marksOf(site: Site, picture: Picture): Mark[] {
  const camera = picture.camera;
  if (!camera) return [];
  const [width, height] = picture.full_px;
  const marks: Mark[] = [];
  const add = (kind: Mark["kind"], name: string, place: number[] | null) => {
    const at = place && pixelOf(camera, place);
    if (at && at[0] >= 0 && at[1] >= 0 && at[0] <= width && at[1] <= height) marks.push({ kind, name, at });
  };
  for (const target of site.targets.values()) add("target", target.id, placeOf(target, picture.utime_us));
  for (const station of site.stations.values()) {
    if (station.id === picture.station || station.latitude_deg == null) continue;
    add("station", station.id, ecef(station.latitude_deg, station.longitude_deg!, station.height_m!));
  }
  return marks;
}

// Lines in the picture: where the optical axis may not go, the horizon, the land's skyline, and where the picture
// disagrees with it.
export type PictureLine = { kind: "keep-out" | "travel" | "horizon" | "skyline" | "differing"; points: [number, number][] };

const PARTS = 8; // of the way from one point of an outline to the next

// The outline once round, without leaps of a whole turn, in small steps.
export function fineOutline(border: Border): [number, number][] {
  const fine: [number, number][] = [];
  let [azimuth, elevation] = border.outline[0];
  for (const next of [...border.outline.slice(1), border.outline[0]]) {
    const step = ((((next[0] - azimuth) % 360) + 540) % 360) - 180;
    for (let i = 0; i < PARTS; i++) fine.push([azimuth + (step * i) / PARTS, elevation + ((next[1] - elevation) * i) / PARTS]);
    azimuth += step;
    elevation = next[1];
  }
  fine.push([azimuth, elevation]);
  return fine;
}

export function bordersOf(site: Site, picture: Picture): PictureLine[] {
  const camera = picture.camera;
  const station = site.stations.get(picture.station);
  if (!camera || station?.latitude_deg == null) return [];
  const lines: PictureLine[] = [];
  for (const border of station.borders ?? []) {
    let points: [number, number][] = [];
    const end = () => {
      if (points.length > 1) lines.push({ kind: border.keep_out ? "keep-out" : "travel", points });
      points = [];
    };
    for (const [azimuth, elevation] of fineOutline(border)) {
      const at = pixelOf(camera, towards(camera, station.latitude_deg, station.longitude_deg!, azimuth, elevation));
      if (at) points.push(at);
      else end();
    }
    end();
  }
  return lines;
}

// Where the optical axis meets this picture, and where it pointed; the middle while that is unknown.
export function axisMark(site: Site, picture: Picture): { at: [number, number]; text: string } {
  const { camera, full_px } = picture;
  const station = site.stations.get(picture.station);
  if (!camera || station?.latitude_deg == null) return { at: [full_px[0] / 2, full_px[1] / 2], text: "" };
  const { azimuth_deg, elevation_deg } = axisOf(camera, station.latitude_deg, station.longitude_deg!);
  return { at: [camera.matrix_px[2], camera.matrix_px[3]], text: `${bearing(azimuth_deg, 2)}  ${fixed(elevation_deg, 2, "°")}` };
}

const HORIZON_PARTS = 24;

// Elevation 0 as this camera sees it, across the picture; null while the camera's attitude is unknown.
export function horizonOf(site: Site, picture: Picture): PictureLine | null {
  const camera = picture.camera;
  const station = site.stations.get(picture.station);
  if (!camera || station?.latitude_deg == null) return null;
  const [width, height] = picture.full_px;
  // As far to each side as the picture's corners are from its middle, however the camera is rolled.
  const half_deg = offAxis_deg(camera, Math.hypot(width, height) / 2);
  const middle_deg = axisOf(camera, station.latitude_deg, station.longitude_deg!).azimuth_deg;
  const points: [number, number][] = [];
  for (let i = 0; i <= HORIZON_PARTS; i++) {
    const azimuth_deg = middle_deg + half_deg * ((2 * i) / HORIZON_PARTS - 1);
    const at = pixelOf(camera, towards(camera, station.latitude_deg, station.longitude_deg!, azimuth_deg, 0));
    if (at) points.push(at);
  }
  return points.some(([, y]) => y >= 0 && y <= height) ? { kind: "horizon", points } : null;
}
