// The imported land in the 3-D view: a lattice of heights around the site, shaded, painted from far to near. It is
// painted anew only when it is looked at from elsewhere.

import { useEffect, useState } from "preact/hooks";
import { askLand, type Land } from "./land";
import { type Eye, frameOf, projector, type Vector } from "./scene3d";
import type { Station } from "./site";

type Answer = { columns: number; rows: number; heights_m: (number | null)[] };
// From the north-west, row by row; `shade` of the cell behind each: 0 (in shadow) to 1.
export type Terrain = { columns: number; rows: number; points: (Vector | null)[]; shade: (number | null)[] };

const [LEAST_M, MOST_M] = [1500, 24_000]; // half its width
const [OF_STATIONS, OF_TARGETS] = [2.5, 1.3]; // of their distance from the stations' middle
const M_PER_DEG = 111_200;
const SUN: Vector = [-0.5, 0.5, 0.7]; // from the north-west, as on maps
const SHADES = 24;

type Placed = { latitude_deg: number | null; longitude_deg: number | null };

// West, south, east, north [deg] around the stations, and the targets. Its width doubles as they need more.
export function boxAround(stations: Placed[], targets: Placed[]): [number, number, number, number] | null {
  const placed = stations.filter((one) => one.latitude_deg != null && one.longitude_deg != null);
  if (!placed.length) return null;
  const middle = (of: (one: Placed) => number) => placed.reduce((sum, one) => sum + of(one), 0) / placed.length;
  const [latitude, longitude] = [middle((one) => one.latitude_deg!), middle((one) => one.longitude_deg!)];
  const narrow = Math.max(0.05, Math.cos((latitude * Math.PI) / 180));
  const away_m = (of: Placed[]) => Math.max(0, ...of.map((one) => (one.latitude_deg == null ? 0 : M_PER_DEG * Math.hypot(one.latitude_deg - latitude, (one.longitude_deg! - longitude) * narrow))));
  const least_m = Math.max(OF_STATIONS * away_m(placed), OF_TARGETS * away_m(targets), LEAST_M);
  const half = Math.min(MOST_M, LEAST_M * 2 ** Math.ceil(Math.log2(least_m / LEAST_M))) / M_PER_DEG;
  return [longitude - half / narrow, latitude - half, longitude + half / narrow, latitude + half];
}

export function terrainOf({ columns, rows, heights_m }: Answer, [west, south, east, north]: number[], place: (latitude: number, longitude: number, height_m: number) => Vector): Terrain {
  const points = heights_m.map((height_m, i) => {
    if (height_m == null) return null;
    const [row, column] = [Math.floor(i / columns), i % columns];
    return place(north + ((south - north) * row) / (rows - 1), west + ((east - west) * column) / (columns - 1), height_m);
  });
  const sun = SUN.map((v) => v / Math.hypot(...SUN));
  const shade = points.map((point, i) => {
    const [right, below] = [points[i + 1], points[i + columns]];
    if (!point || !right || !below || (i + 1) % columns === 0) return null;
    const [a, b] = [below, right].map((one) => one.map((v, k) => v - point[k]));
    const normal = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    const lit = normal.reduce((sum, v, k) => sum + v * sun[k], 0) / Math.hypot(...normal);
    return Math.max(0, lit);
  });
  return { columns, rows, points, shade };
}

// Null until it is known, and without land.
export function useTerrain(land: Land | null, stations: Station[], targets: Placed[]): Terrain | null {
  const [terrain, setTerrain] = useState<Terrain | null>(null);
  const box = land && boxAround(stations, targets)?.map((v) => v.toFixed(3)).join();
  useEffect(() => {
    const frame = frameOf(stations);
    if (!box || !frame) return setTerrain(null);
    let isOver = false;
    void askLand<Answer>(`/heights?box=${box}`).then((found) => {
      if (found?.heights_m && !isOver) setTerrain(terrainOf(found, box.split(",").map(Number), (...at) => frame.place(...at)));
    });
    return () => void (isOver = true);
  }, [box, land?.version]);
  return terrain;
}

// From dark to bright, of a colour "#rrggbb".
function shadesOf(colour: string): string[] {
  const parts = [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16));
  return Array.from({ length: SHADES }, (_, i) => {
    const away = (0.6 * (i - SHADES / 2)) / SHADES;
    const mixed = parts.map((part) => Math.round(part + Math.abs(away) * ((away < 0 ? 0 : 255) - part)));
    return `rgb(${mixed.join()})`;
  });
}

export class TerrainPainter {
  private canvas = document.createElement("canvas");
  private painted = "";
  private of: Terrain | null = null;

  // What it looks like from there, as large as the canvas on which it is to be drawn.
  picture(terrain: Terrain, eye: Eye, size: [number, number], whole: [number, number], scale: number, colour: string): HTMLCanvasElement {
    const key = JSON.stringify([eye, size, whole, scale, colour]);
    if (key === this.painted && terrain === this.of) return this.canvas;
    [this.painted, this.of] = [key, terrain];
    [this.canvas.width, this.canvas.height] = whole.map((v) => Math.round(v * scale));
    const g = this.canvas.getContext("2d")!;
    g.scale(scale, scale);
    const { columns, rows, points, shade } = terrain;
    const project = projector(eye, ...size);
    const pixels = points.map((point) => point && project(point));
    const colours = shadesOf(colour);
    const order = (count: number, isForward: boolean) => Array.from({ length: count - 1 }, (_, i) => (isForward ? i : count - 2 - i));
    const across = order(columns, Math.sin(eye.azimuth) <= 0);
    for (const row of order(rows, Math.cos(eye.azimuth) >= 0)) {
      for (const column of across) {
        const i = row * columns + column;
        const corners = [pixels[i], pixels[i + 1], pixels[i + columns + 1], pixels[i + columns]];
        if (shade[i] == null || corners.some((one) => !one)) continue;
        g.fillStyle = g.strokeStyle = colours[Math.min(SHADES - 1, Math.floor(shade[i]! * SHADES))];
        g.beginPath();
        for (const corner of corners) g.lineTo(...corner!);
        g.closePath();
        g.fill();
        g.stroke(); // or the background shows between cells
      }
    }
    return this.canvas;
  }
}
