// The land's skyline in the stations' pictures, and where a picture disagrees with it. Each station's skyline is asked
// for once for each place of its camera, and projected once for each pose and zoom; where its pictures disagree is asked
// for every few seconds while it is drawn.

import { useEffect, useRef, useState } from "preact/hooks";
import type { HttpAnswer } from "./conditions";
import { askLand, type Land } from "./land";
import type { Link, Picture } from "./link";
import { remember, remembered } from "./memory";
import { type Camera, offAxis_deg, onGround, projectorOf, unitsEcef } from "./projection";

export type Pixels = [number, number][];
type Answer = { camera_ecef_m: number[]; elevation_deg: (number | null)[]; computing?: boolean };
type Known = { ecef_m: number[]; units: (number[] | null)[] }; // directions clockwise from north
type Projected = { camera: Camera; known: Known; full_px: number[]; lines: Pixels[] };

const MOVED_M = 2; // kMoved_m of console/land_skylines.h, and its answer's rounding
const AGAIN_MS = 10_000; // after one that cannot be had
const RENEWED_MS = 5000; // where pictures disagree: a station takes one so often
const COLUMNS = 7200; // SeenSkyline::kColumns of land/seen_skyline.h
const GAP = 3; // columns: those of a wide lens are fewer than the skyline's
const SOON_MS = 1000; // while it is being computed

const isSame = (a: number[], b: number[]) => a.every((value, i) => value === b[i]);
const isSameView = (a: Camera, b: Camera) => a.lens === b.lens && isSame(a.from_ecef, b.from_ecef) && isSame(a.matrix_px, b.matrix_px) && isSame(a.distortion, b.distortion);

// Through the picture's part of the sky, broken where the land is not known.
export function projected(known: (number[] | null)[], camera: Camera, [width, height]: number[]): Pixels[] {
  const half_rad = (offAxis_deg(camera, Math.hypot(width, height) / 2) * Math.PI) / 180;
  const least = Math.cos(Math.min(Math.PI, 1.2 * half_rad)); // the principal point is not in the middle
  const [x, y, z] = camera.from_ecef.slice(6, 9);
  const project = projectorOf(camera);
  const lines: Pixels[] = [];
  let line: Pixels = [];
  const end = () => {
    if (line.length > 1) lines.push(line);
    line = [];
  };
  // From one that is not in the picture, so that none is cut where the circle begins.
  const isIn = (one: number[] | null) => one != null && one[0] * x + one[1] * y + one[2] * z > least;
  const from = Math.max(0, known.findIndex((one) => !isIn(one)));
  for (let i = 0; i <= known.length; i++) {
    const one = known[(from + i) % known.length];
    const at = isIn(one) ? project(one!) : null;
    if (at) line.push(at);
    else end();
  }
  end();
  return lines;
}

// The elevations of all columns, of those that differ and of the gaps between them.
export function filled(differing: [number, number][]): (number | null)[] {
  const elevations: (number | null)[] = Array(COLUMNS).fill(null);
  let last: [number, number] | null = null;
  for (const [azimuth_deg, elevation_deg] of differing) {
    const column = Math.floor((azimuth_deg / 360) * COLUMNS);
    if (last && column - last[0] <= GAP) for (let i = last[0] + 1; i < column; i++) elevations[i] = last[1] + ((elevation_deg - last[1]) * (i - last[0])) / (column - last[0]);
    elevations[column] = elevation_deg;
    last = [column, elevation_deg];
  }
  return elevations;
}

export class Skylines {
  private known = new Map<string, Known>();
  private asked_ms = new Map<string, number>();
  private shown = new Map<string, Projected>();
  private seen = new Map<string, (number[] | null)[]>();
  private askedSeen_ms = new Map<string, number>();
  problems = new Map<string, HttpAnswer>(); // by station

  constructor(private onNews: () => void) {}

  // Asks for it if it is not known.
  linesIn(picture: Picture): Pixels[] {
    const { camera, station, full_px } = picture;
    if (!camera) return [];
    const known = this.known.get(station);
    if (!known || Math.hypot(...known.ecef_m.map((v, i) => v - camera.ecef_m[i])) > MOVED_M) void this.ask(station);
    if (!known) return [];
    const shown = this.shown.get(station);
    if (shown && shown.known === known && isSame(shown.full_px, full_px) && isSameView(shown.camera, camera)) return shown.lines;
    const lines = projected(known.units, camera, full_px);
    this.shown.set(station, { camera, known, full_px, lines });
    return lines;
  }

  // Above the skyline or below: where the picture has it, if they disagree.
  differingIn({ camera, station, full_px }: Picture): Pixels[] {
    if (!camera) return [];
    void this.askSeen(station, camera.ecef_m);
    const seen = this.seen.get(station);
    return seen ? projected(seen, camera, full_px) : [];
  }

  private async askSeen(station: string, ecef_m: number[]) {
    if (performance.now() - (this.askedSeen_ms.get(station) ?? -Infinity) < RENEWED_MS) return;
    this.askedSeen_ms.set(station, performance.now());
    const answer = await askLand<{ differing?: [number, number][] }>(`/seen/${encodeURIComponent(station)}`);
    if (!answer?.differing) return;
    this.seen.set(station, unitsEcef(onGround(ecef_m), filled(answer.differing), 0.5));
    this.onNews();
  }

  private async ask(station: string) {
    if (performance.now() - (this.asked_ms.get(station) ?? -Infinity) < AGAIN_MS) return;
    this.asked_ms.set(station, Infinity); // until it is answered
    const answer = await askLand<Answer>(`/skyline/${encodeURIComponent(station)}`);
    this.asked_ms.set(station, performance.now() - (answer?.computing ? AGAIN_MS - SOON_MS : 0));
    if (answer?.computing) return;
    this.problems.delete(station);
    if (answer?.elevation_deg) this.known.set(station, { ecef_m: answer.camera_ecef_m, units: unitsEcef(onGround(answer.camera_ecef_m), answer.elevation_deg) });
    else if (answer) this.problems.set(station, answer);
    this.onNews();
  }
}

// `skylines`: null while they are off, or no land is known. `news` counts what has come.
export function useSkylines(link: Link, land: Land | null) {
  const [isOn, setOn] = useState(remembered("skyline", "yes") === "yes");
  const [news, setNews] = useState(0);
  const skylines = useRef<Skylines | null>(null);
  useEffect(() => {
    skylines.current = land && new Skylines(() => setNews((n) => n + 1));
    setNews((n) => n + 1);
  }, [land?.version]);
  const choose = (wanted: boolean) => {
    setOn(wanted);
    remember("skyline", wanted ? "yes" : "no");
  };
  return { isThere: land != null, isOn, choose, news, skylines: isOn ? skylines.current : null };
}
export type SkylineChoice = ReturnType<typeof useSkylines>;
