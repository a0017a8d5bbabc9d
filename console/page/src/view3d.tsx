// The site in three dimensions: stations, rays, targets with their 95 % ellipsoids and trails, in the
// east-north-up frame of its middle. A few hundred lines need no graphics processor: they are projected
// here and drawn on a plain canvas, which works in every browser.

import { h } from "preact";
import { useLayoutEffect, useRef, useState } from "preact/hooks";
import { Pinch } from "./hand";
import type { Link } from "./link";
import { ecef } from "./projection";
import { followed, type Station, type Target } from "./site";
import { distance, fixed } from "./format";
import { t } from "./words";

type Vector = [number, number, number];
type Eye = { azimuth: number; elevation: number; away_m: number; at: Vector }; // looks at `at`, from that direction
type Stroke = { points: Vector[]; colour: string; width: number; dash?: number[] };
type Name = { at: Vector; text: string; colour: string };

const RAY_M = 3000;
const SCALE_95 = 2.7955; // of a sigma ellipsoid: the root of the 95 % point of chi-square with three degrees of freedom
const LARGER = [1, 10, 100];
const FOCAL = 1.2; // of the width of the canvas

// Places in the frame of the site's middle.
class Frame {
  private readonly origin: number[];
  private readonly rows: number[][]; // east, north, up in ECEF

  constructor(latitude_deg: number, longitude_deg: number, height_m: number) {
    const [lat, lon] = [(latitude_deg * Math.PI) / 180, (longitude_deg * Math.PI) / 180];
    this.origin = ecef(latitude_deg, longitude_deg, height_m);
    this.rows = [
      [-Math.sin(lon), Math.cos(lon), 0],
      [-Math.sin(lat) * Math.cos(lon), -Math.sin(lat) * Math.sin(lon), Math.cos(lat)],
      [Math.cos(lat) * Math.cos(lon), Math.cos(lat) * Math.sin(lon), Math.sin(lat)],
    ];
  }

  place(latitude_deg: number, longitude_deg: number, height_m: number): Vector {
    const d = ecef(latitude_deg, longitude_deg, height_m).map((v, i) => v - this.origin[i]);
    return this.rows.map((row) => row[0] * d[0] + row[1] * d[1] + row[2] * d[2]) as Vector;
  }
}

function frameOf(stations: Station[]): Frame | null {
  const placed = stations.filter((s) => s.latitude_deg != null && s.longitude_deg != null && s.height_m != null);
  if (!placed.length) return null;
  const mean = (of: (s: Station) => number) => placed.reduce((sum, s) => sum + of(s), 0) / placed.length;
  return new Frame(mean((s) => s.latitude_deg!), mean((s) => s.longitude_deg!), mean((s) => s.height_m!));
}

// Three sections of the 95 % ellipsoid: the images of three unit circles under the covariance's Cholesky factor.
export function ellipsoid(covariance: (number | null)[] | undefined, larger: number): Vector[][] {
  if (!covariance || covariance.some((v) => v == null)) return [];
  const [ee, en, eu, nn, nu, uu] = covariance as number[];
  const a = Math.sqrt(ee);
  const [b, d] = [en / a, eu / a];
  const c = Math.sqrt(nn - b * b);
  const e = (nu - b * d) / c;
  const f = Math.sqrt(uu - d * d - e * e);
  if (![a, b, c, d, e, f].every(isFinite)) return [];
  const k = SCALE_95 * larger;
  const at = (x: number, y: number, z: number): Vector => [k * a * x, k * (b * x + c * y), k * (d * x + e * y + f * z)];
  const ring = (of: (cos: number, sin: number) => Vector) => Array.from({ length: 41 }, (_, i) => of(Math.cos((i * Math.PI) / 20), Math.sin((i * Math.PI) / 20)));
  return [ring((x, y) => at(x, y, 0)), ring((x, y) => at(x, 0, y)), ring((x, y) => at(0, x, y))];
}

const plus = (a: Vector, b: Vector): Vector => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const along = (azimuth_deg: number, elevation_deg: number, m: number): Vector => {
  const [a, e] = [(azimuth_deg * Math.PI) / 180, (elevation_deg * Math.PI) / 180];
  return [m * Math.cos(e) * Math.sin(a), m * Math.cos(e) * Math.cos(a), m * Math.sin(e)];
};

function roundStep(size_m: number): number {
  const power = 10 ** Math.floor(Math.log10(Math.max(size_m, 1)));
  return [1, 2, 5, 10].map((part) => part * power).find((step) => step >= size_m)!;
}

function groundStrokes(eye: Eye, colour: string): Stroke[] {
  const step = roundStep(eye.away_m / 12);
  const [e0, n0] = [Math.round(eye.at[0] / step) * step, Math.round(eye.at[1] / step) * step];
  const strokes: Stroke[] = [];
  for (let i = -10; i <= 10; i++) {
    strokes.push({ points: [[e0 + i * step, n0 - 10 * step, 0], [e0 + i * step, n0 + 10 * step, 0]], colour, width: 1 });
    strokes.push({ points: [[e0 - 10 * step, n0 + i * step, 0], [e0 + 10 * step, n0 + i * step, 0]], colour, width: 1 });
  }
  return strokes;
}

class Scene {
  strokes: Stroke[] = [];
  names: Name[] = [];

  constructor(
    private frame: Frame,
    private colour: (name: string) => string,
    private larger: number,
  ) {}

  addStation(s: Station, reach_m: number) {
    if (s.latitude_deg == null || s.longitude_deg == null || s.height_m == null) return;
    const at = this.frame.place(s.latitude_deg, s.longitude_deg, s.height_m);
    this.names.push({ at, text: s.id, colour: this.colour(s.stale ? "--map-station-quiet" : "--map-station") });
    if (s.stale || s.state !== "tracking" || !s.bearing) return;
    const far = plus(at, along(s.bearing.azimuth_deg, s.bearing.elevation_deg, reach_m));
    this.strokes.push({ points: [at, far], colour: this.colour("--map-ray"), width: 1.2 });
  }

  addTarget(target: Target, isSelected: boolean): Vector | null {
    if (target.latitude_deg == null) return null;
    const at = this.frame.place(target.latitude_deg, target.longitude_deg, target.height_m);
    const colour = this.colour(target.stale ? "--map-coasted" : "--map-target");
    const trail = (target.trail ?? []).map(([longitude, latitude, height]) => this.frame.place(latitude, longitude, height));
    this.strokes.push({ points: [...trail, at], colour: this.colour("--map-trail"), width: isSelected ? 2.5 : 1.5 });
    this.strokes.push({ points: [at, [at[0], at[1], 0]], colour, width: 1, dash: [3, 4] });
    for (const ring of ellipsoid(target.covariance_enu_m2, this.larger)) {
      this.strokes.push({ points: ring.map((point) => plus(at, point)), colour, width: isSelected ? 2 : 1.2 });
    }
    this.names.push({ at, text: `${target.id}  ${fixed(target.height_m, 0, " m")}`, colour });
    return at;
  }
}

type Pixel = [number, number] | null;

function projector(eye: Eye, width: number, height: number): (place: Vector) => Pixel {
  const [sa, ca, se, ce] = [Math.sin(eye.azimuth), Math.cos(eye.azimuth), Math.sin(eye.elevation), Math.cos(eye.elevation)];
  return ([e, n, u]) => {
    const [x, y, z] = [e - eye.at[0], n - eye.at[1], u - eye.at[2]];
    const right = x * ca - y * sa;
    const into = x * sa + y * ca; // horizontally, away from the eye
    const depth = eye.away_m + into * ce - z * se;
    if (depth < 1) return null;
    const k = (FOCAL * Math.min(width, height * 1.3)) / depth;
    return [width / 2 + k * right, height / 2 - k * (into * se + z * ce)];
  };
}

function draw(canvas: HTMLCanvasElement, scene: Scene, ground: Stroke[], eye: Eye, colour: (name: string) => string) {
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  canvas.width = Math.round(width * devicePixelRatio);
  canvas.height = Math.round(height * devicePixelRatio);
  const g = canvas.getContext("2d")!;
  g.scale(devicePixelRatio, devicePixelRatio);
  g.fillStyle = colour("--map-sea");
  g.fillRect(0, 0, width, height);
  const project = projector(eye, width, height);
  for (const stroke of [...ground, ...scene.strokes]) {
    g.beginPath();
    let before: Pixel = null;
    for (const point of stroke.points) {
      const at = project(point);
      if (at && before) g.lineTo(...at);
      else if (at) g.moveTo(...at);
      before = at;
    }
    g.strokeStyle = stroke.colour;
    g.lineWidth = stroke.width;
    g.setLineDash(stroke.dash ?? []);
    g.stroke();
  }
  g.font = "600 12px Inter, system-ui, 'DejaVu Sans', sans-serif";
  for (const name of scene.names) {
    const at = project(name.at);
    if (!at) continue;
    g.fillStyle = name.colour;
    g.beginPath();
    g.arc(...at, 4.5, 0, 2 * Math.PI);
    g.fill();
    g.lineWidth = 3;
    g.setLineDash([]);
    g.strokeStyle = colour("--map-halo");
    g.strokeText(name.text, at[0] + 8, at[1] - 6);
    g.fillStyle = colour("--map-text");
    g.fillText(name.text, at[0] + 8, at[1] - 6);
  }
}

// So that all of the site is in sight.
function around(places: Vector[]): { at: Vector; away_m: number } {
  const middle = (i: number) => (Math.min(...places.map((p) => p[i])) + Math.max(...places.map((p) => p[i]))) / 2;
  const at: Vector = [middle(0), middle(1), middle(2)];
  const size = Math.max(100, ...places.map((p) => Math.hypot(p[0] - at[0], p[1] - at[1], p[2] - at[2])));
  return { at, away_m: 3.2 * size };
}

type Props = { link: Link; version: number; theme: string; selected: string; follow: boolean };

export function View3d({ link, version, theme, selected, follow }: Props) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const [eye, setEye] = useState<Eye | null>(null); // null: as far as all of the site needs
  const [larger, setLarger] = useState(1);
  const held = useRef<[number, number] | null>(null);
  const shown = useRef<Eye>({ azimuth: 0.5, elevation: 0.45, away_m: 1000, at: [0, 0, 0] });
  const pinch = useRef(new Pinch());
  useLayoutEffect(() => {
    const stations = [...link.site.stations.values()];
    const frame = frameOf(stations);
    if (!frame || !canvas.current) return;
    const style = getComputedStyle(document.documentElement);
    const colour = (name: string) => style.getPropertyValue(name).trim();
    const scene = new Scene(frame, colour, larger);
    const targets = [...link.site.targets.values()].map((target) => ({ target, at: scene.addTarget(target, selected === `target:${target.id}`) }));
    const places = stations.filter((s) => s.latitude_deg != null && s.height_m != null).map((s) => frame.place(s.latitude_deg!, s.longitude_deg!, s.height_m!));
    const whole = around([...places, ...targets.flatMap(({ at }) => (at ? [at] : []))]);
    for (const station of stations) scene.addStation(station, Math.max(RAY_M, whole.away_m));
    shown.current = eye ?? { ...shown.current, ...whole };
    const middle = follow && targets.find(({ target }) => target === followed(link.site, selected))?.at;
    if (middle) shown.current = { ...shown.current, at: middle };
    draw(canvas.current, scene, groundStrokes(shown.current, colour("--map-grid")), shown.current, colour);
  }, [version, eye, larger, theme, selected, follow]);
  const turn = (azimuth: number, elevation: number, away = 1) => {
    const now = shown.current;
    const steep = Math.max(-0.1, Math.min(1.55, now.elevation + elevation));
    setEye({ ...now, azimuth: now.azimuth + azimuth, elevation: steep, away_m: Math.max(20, Math.min(1e6, now.away_m * away)) });
  };
  const letGo = (event: PointerEvent) => {
    pinch.current.up(event);
    held.current = null;
  };
  const key = (event: KeyboardEvent) => {
    const turns: Record<string, [number, number, number?]> = { ArrowLeft: [0.1, 0], ArrowRight: [-0.1, 0], ArrowUp: [0, 0.08], ArrowDown: [0, -0.08], "+": [0, 0, 0.8], "-": [0, 0, 1.25] };
    if (!turns[event.key]) return;
    event.preventDefault();
    turn(...turns[event.key]);
  };
  return (
    <div class="view-3d">
      <canvas
        ref={canvas}
        role="img"
        aria-label={t("view_3d")}
        tabIndex={0}
        onKeyDown={key}
        onPointerDown={(event) => {
          held.current = [event.clientX, event.clientY];
          pinch.current.down(event);
          event.currentTarget.setPointerCapture(event.pointerId);
        }}
        onPointerMove={(event) => {
          if (pinch.current.isTwo) return turn(0, 0, 1 / pinch.current.move(event));
          if (!held.current) return;
          turn((held.current[0] - event.clientX) * -0.006, (event.clientY - held.current[1]) * 0.005);
          held.current = [event.clientX, event.clientY];
        }}
        onPointerUp={letGo}
        onPointerCancel={letGo}
        onWheel={(event) => {
          event.preventDefault();
          turn(0, 0, Math.exp(event.deltaY * 0.001));
        }}
      />
      <div class="view-3d-tools">
        <button type="button" onClick={() => setEye(null)}>
          {t("fit")}
        </button>
        <label>
          {t("ellipsoids")}
          <select value={String(larger)} onChange={(e) => setLarger(Number(e.currentTarget.value))}>
            {LARGER.map((factor) => (
              <option value={String(factor)}>{factor === 1 ? t("true_size") : `${factor}×`}</option>
            ))}
          </select>
        </label>
        <span>
          {t("grid_step")} {distance(roundStep(shown.current.away_m / 12))}
        </span>
      </div>
    </div>
  );
}
