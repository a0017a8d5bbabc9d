// What there is to see in three dimensions, in the east-north-up frame of the site's middle, and how it
// is projected and drawn: a few hundred lines, which need no graphics processor.

import { heightRange, HIDDEN_DASH, runsOf } from "./heights";
import { type Box, OFFSETS, type Side, sidesOf } from "./labels";
import { fineOutline } from "./marks";
import { length, ringName, roundStep } from "./measures";
import { ecef } from "./projection";
import { followed, nameOf, stretches, type Line, type Site, type Station, type Target } from "./site";

export type Layers = { terrain: boolean; grid: boolean; rings: boolean; trails: boolean; views: boolean; limits: boolean };

export type Vector = [number, number, number];
export type View = { away_m: number; at: Vector }; // looks at `at`
export type Eye = View & { azimuth: number; elevation: number }; // from that direction
// `fill`: how much of its colour is within it.
type Stroke = { points: Vector[]; colour: string; width: number; dash?: number[]; fill?: number };
type Name = { id: string; at: Vector; text: string; colour: string; isPlain?: boolean };

const RAY_M = 3000;
const SCALE_95 = 2.7955; // of a sigma ellipsoid: the root of the 95 % point of chi-square with three degrees of freedom
export const LARGER = [1, 10, 100];
const FOCAL = 1.2; // of the width of the canvas
const NEAR_PX = 14; // a click so near to a thing is on it
const RINGS = 4;
// Of the whole site's view: how far fields of view and borders are drawn, so that they do not run into one another.
const VIEW_PART = 0.15;
const BORDER_PART = 0.06;

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

const isPlaced = (s: Station) => s.latitude_deg != null && s.longitude_deg != null && s.height_m != null;

export function frameOf(stations: Station[]): Frame | null {
  const placed = stations.filter(isPlaced);
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

export function groundStrokes(eye: Eye, colour: string): Stroke[] {
  const step = roundStep(eye.away_m / 12);
  const [e0, n0] = [Math.round(eye.at[0] / step) * step, Math.round(eye.at[1] / step) * step];
  const strokes: Stroke[] = [];
  for (let i = -10; i <= 10; i++) {
    strokes.push({ points: [[e0 + i * step, n0 - 10 * step, 0], [e0 + i * step, n0 + 10 * step, 0]], colour, width: 1 });
    strokes.push({ points: [[e0 - 10 * step, n0 + i * step, 0], [e0 + 10 * step, n0 + i * step, 0]], colour, width: 1 });
  }
  return strokes;
}

type Placed = { target: Target; at: Vector | null }[];

// Which target a station helps to place, and where that is.
function followedBy(targets: Placed): Map<string, Vector> {
  const of = new Map<string, Vector>();
  for (const { target, at } of targets) {
    for (const station of target.stations ?? []) if (at && station.used && !target.stale) of.set(station.id, at);
  }
  return of;
}

export class Scene {
  strokes: Stroke[] = [];
  names: Name[] = [];
  sides = new Map<string, Side | null>(); // of the names, as they were drawn

  constructor(
    private frame: Frame,
    private colour: (name: string) => string,
    private larger: number,
  ) {}

  // All of the site's own; returns what it needs to be seen, and where the target is that is followed.
  addSite(site: Site, selected: string, layers: Layers): { whole: View; followed: Vector | null | undefined } {
    const targets = [...site.targets.values()].map((target) => ({ target, at: this.addTarget(target, selected === `target:${target.id}`) }));
    if (layers.trails) this.addTrails([...site.targets.values()], selected);
    const placed = [...site.stations.values()].filter(isPlaced);
    const places = placed.map((s) => this.frame.place(s.latitude_deg!, s.longitude_deg!, s.height_m!));
    const whole = around([...places, ...targets.flatMap(({ at }) => (at ? [at] : []))]);
    const reach_m = Math.max(RAY_M, whole.away_m);
    const of = followedBy(targets);
    for (const station of placed) this.addStation(station, whole.away_m, layers, selected === `station:${station.id}`, of.get(station.id));
    for (const line of site.lines.values()) this.addLine(line, site.stations.get(line.id), reach_m);
    return { whole, followed: targets.find(({ target }) => target === followed(site, selected))?.at };
  }

  // `target`: where what it follows is; its ray ends there, and only one to what has no place goes on.
  private addStation(s: Station, away_m: number, layers: Layers, isSelected: boolean, target: Vector | undefined) {
    if (s.latitude_deg == null || s.longitude_deg == null || s.height_m == null) return;
    const at = this.frame.place(s.latitude_deg, s.longitude_deg, s.height_m);
    const colour = this.colour(s.stale ? "--map-station-quiet" : isSelected ? "--map-accent" : "--map-station");
    this.names.push({ id: `station:${s.id}`, at, text: s.id, colour });
    if (layers.limits) this.addBorders(s, at, BORDER_PART * away_m);
    if (s.stale) return;
    if (layers.views) this.addView(s, at, VIEW_PART * away_m, isSelected);
    if (s.state !== "tracking" || !s.bearing) return;
    const far_m = target ? Math.hypot(...target.map((v, i) => v - at[i])) : Math.max(RAY_M, away_m);
    const far = plus(at, along(s.bearing.azimuth_deg, s.bearing.elevation_deg, far_m));
    this.strokes.push({ points: [at, far], colour: this.colour(isSelected ? "--map-accent" : "--map-station"), width: isSelected ? 2.5 : 1.5 });
  }

  // What the camera sees, as a body: its four faces faintly, and the picture's frame at their ends.
  private addView(s: Station, at: Vector, reach_m: number, isSelected: boolean) {
    const [wide, high] = s.field_of_view_deg ?? [];
    if (s.azimuth_deg == null || s.elevation_deg == null || !wide || !high) return;
    const forward = along(s.azimuth_deg, s.elevation_deg, 1);
    const right = along(s.azimuth_deg + 90, 0, 1);
    const up = along(s.azimuth_deg, s.elevation_deg + 90, 1);
    const [x, y] = [Math.tan((wide * Math.PI) / 360), Math.tan((high * Math.PI) / 360)];
    const corner = (i: number, j: number) => at.map((v, k) => v + reach_m * (forward[k] + i * x * right[k] + j * y * up[k])) as Vector;
    const frame = [corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)];
    const colour = this.colour("--map-station");
    frame.forEach((one, i) => this.strokes.push({ points: [at, one, frame[(i + 1) % 4]], colour, width: 0, fill: isSelected ? 0.14 : 0.06 }));
    this.strokes.push({ points: [...frame, frame[0]], colour, width: isSelected ? 1.5 : 0.7 });
  }

  // Where the axis may not point, and where the travel ends: on a sphere about the station.
  private addBorders(s: Station, at: Vector, radius_m: number) {
    for (const border of s.borders ?? []) {
      const round = fineOutline(border).map(([azimuth, elevation]) => plus(at, along(azimuth, elevation, radius_m)));
      const stroke = border.keep_out ? { colour: this.colour("--map-alarm"), width: 1.5, dash: [7, 4], fill: 0.15 } : { colour: this.colour("--map-rule-text"), width: 1, dash: [2, 5] };
      this.strokes.push({ points: [...round, round[0]], ...stroke });
    }
  }

  // Of a station whose object has no position yet.
  private addLine(line: Line, s: Station | undefined, reach_m: number) {
    if (line.stale || s?.latitude_deg == null || s.longitude_deg == null || s.height_m == null) return;
    const at = this.frame.place(s.latitude_deg, s.longitude_deg, s.height_m);
    this.strokes.push({ points: [at, plus(at, along(line.azimuth_deg, line.elevation_deg, reach_m))], colour: this.colour("--map-tentative"), width: 1.5, dash: [8, 6] });
  }

  // Each part in the colour of its height, as on the flat map.
  private addTrails(targets: Target[], selected: string) {
    const range = heightRange(targets);
    if (!range) return;
    const colours = this.colour("--map-heights").split(/\s+/);
    for (const target of targets) {
      const width = selected === `target:${target.id}` ? 2.5 : 1.5;
      for (const stretch of target.latitude_deg == null ? [] : stretches(target)) {
        for (const { step, isHidden, places } of runsOf(stretch, range, colours.length, selected)) {
          const points = places.map(([longitude, latitude, height]) => this.frame.place(latitude, longitude, height));
          this.strokes.push({ points, colour: colours[step], width, dash: isHidden ? HIDDEN_DASH : undefined });
        }
      }
    }
  }

  private addTarget(target: Target, isSelected: boolean): Vector | null {
    if (target.latitude_deg == null) return null;
    const at = this.frame.place(target.latitude_deg, target.longitude_deg, target.height_m);
    const colour = this.colour(target.stale ? "--map-coasted" : "--map-target");
    this.strokes.push({ points: [at, [at[0], at[1], 0]], colour: this.colour("--map-rule-text"), width: 1, dash: [3, 4] });
    for (const ring of ellipsoid(target.covariance_enu_m2, this.larger)) {
      this.strokes.push({ points: ring.map((point) => plus(at, point)), colour, width: isSelected ? 2 : 1.2, fill: 0.08 });
    }
    this.names.push({ id: `target:${target.id}`, at, text: `${nameOf(target)}  ${length(target.height_m)}`, colour: isSelected ? this.colour("--map-accent") : colour });
    return at;
  }

  addRings(step_m: number) {
    for (let i = 1; i <= RINGS; i++) {
      const round = Array.from({ length: 73 }, (_, k) => along(5 * k, 0, i * step_m));
      this.strokes.push({ points: round, colour: this.colour("--map-ring"), width: 1 });
      const north = i === RINGS ? "N   " : "";
      this.names.push({ id: "", at: round[0], text: north + ringName(step_m, i), colour: this.colour("--map-rule-text"), isPlain: true });
    }
  }

  // What is measured: a line, and its ends.
  addMeasured(ends: Vector[]) {
    const colour = this.colour("--map-accent");
    if (ends.length === 2) this.strokes.push({ points: ends, colour, width: 2, dash: [6, 4] });
    for (const at of ends) this.names.push({ id: "", at, text: "", colour });
  }

  placeOf(id: string): Vector | undefined {
    return id ? this.names.find((one) => one.id === id)?.at : undefined;
  }

  // The thing at a pixel: the nearest; "" for none.
  thingAt(pixel: [number, number], eye: Eye, size: [number, number]): string {
    const project = projector(eye, ...size);
    const away = (name: Name) => {
      const at = name.id && project(name.at);
      return at ? Math.hypot(at[0] - pixel[0], at[1] - pixel[1]) : Infinity;
    };
    const nearest = [...this.names].sort((a, b) => away(a) - away(b))[0];
    return nearest && away(nearest) < NEAR_PX ? nearest.id : "";
  }
}

type Pixel = [number, number] | null;

const focalPx = (width: number, height: number) => FOCAL * Math.min(width, height * 1.3);

export function projector(eye: Eye, width: number, height: number): (place: Vector) => Pixel {
  const [sa, ca, se, ce] = [Math.sin(eye.azimuth), Math.cos(eye.azimuth), Math.sin(eye.elevation), Math.cos(eye.elevation)];
  return ([e, n, u]) => {
    const [x, y, z] = [e - eye.at[0], n - eye.at[1], u - eye.at[2]];
    const right = x * ca - y * sa;
    const into = x * sa + y * ca; // horizontally, away from the eye
    const depth = eye.away_m + into * ce - z * se;
    if (depth < 1) return null;
    const k = focalPx(width, height) / depth;
    return [width / 2 + k * right, height / 2 - k * (into * se + z * ce)];
  };
}

const NAME_FONT = "600 12px Inter, system-ui, 'DejaVu Sans', sans-serif";
const rank = (id: string) => (id.startsWith("target:") ? 0 : id.startsWith("station:") ? 1 : 2);

type Written = Omit<Name, "at"> & { at: [number, number] };

function write(g: CanvasRenderingContext2D, name: Written, side: Side | null, colour: (name: string) => string) {
  if (!name.isPlain) {
    g.fillStyle = name.colour;
    g.beginPath();
    g.arc(...name.at, 4.5, 0, 2 * Math.PI);
    g.fill();
  }
  if (!side) return;
  const [x, y] = name.at.map((v, i) => v + OFFSETS[side][i]);
  g.font = NAME_FONT;
  g.textAlign = side === "right" ? "left" : side === "left" ? "right" : "center";
  g.textBaseline = "middle";
  g.lineWidth = 3;
  g.setLineDash([]);
  g.strokeStyle = colour("--map-halo");
  g.strokeText(name.text, x, y);
  g.fillStyle = name.isPlain ? name.colour : colour("--map-text");
  g.fillText(name.text, x, y);
}

function paint(g: CanvasRenderingContext2D, stroke: Stroke, project: (place: Vector) => Pixel) {
  g.beginPath();
  let before: Pixel = null;
  for (const point of stroke.points) {
    const at = project(point);
    if (at && before) g.lineTo(...at);
    else if (at) g.moveTo(...at);
    before = at;
  }
  if (stroke.fill) {
    g.globalAlpha = stroke.fill;
    g.fillStyle = stroke.colour;
    g.fill();
    g.globalAlpha = 1;
  }
  if (!stroke.width) return;
  g.strokeStyle = stroke.colour;
  g.lineWidth = stroke.width;
  g.setLineDash(stroke.dash ?? []);
  g.stroke();
}

// `size`: the part of the canvas in whose middle the eye looks. `over`: what covers the canvas. `terrain`: its picture.
export function draw(canvas: HTMLCanvasElement, scene: Scene, ground: Stroke[], terrain: HTMLCanvasElement | null, eye: Eye, size: [number, number], over: Box[], colour: (name: string) => string) {
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  canvas.width = Math.round(width * devicePixelRatio);
  canvas.height = Math.round(height * devicePixelRatio);
  const g = canvas.getContext("2d")!;
  g.scale(devicePixelRatio, devicePixelRatio);
  g.fillStyle = colour("--map-sea");
  g.fillRect(0, 0, width, height);
  if (terrain) g.drawImage(terrain, 0, 0, width, height);
  const project = projector(eye, ...size);
  for (const stroke of [...ground, ...scene.strokes]) paint(g, stroke, project);
  const names = scene.names.flatMap((name) => {
    const at = project(name.at);
    return at ? [{ ...name, at }] : [];
  });
  g.font = NAME_FONT;
  // What moves chooses first; names without a thing are rings.
  const placed = names.map(({ id, text, at }, i) => ({ id: `${id} ${i}`, at, width: g.measureText(text).width }));
  const sides = sidesOf([...placed].sort((a, b) => rank(a.id) - rank(b.id)), scene.sides, over);
  names.forEach((name, i) => write(g, name, sides.get(placed[i].id) ?? null, colour));
  scene.sides = sides;
}
// Where the line of sight through a pixel meets the ground, at the height of the site's middle; null: nowhere.
export function groundAt([x, y]: [number, number], eye: Eye, [width, height]: [number, number]): Vector | null {
  const [sa, ca, se, ce] = [Math.sin(eye.azimuth), Math.cos(eye.azimuth), Math.sin(eye.elevation), Math.cos(eye.elevation)];
  const k = focalPx(width, height);
  const [a, b, z] = [(x - width / 2) / k, (height / 2 - y) / k, -eye.at[2]];
  const below = se - b * ce; // of the horizon
  if (below < 1e-3) return null;
  const into = (b * eye.away_m - b * z * se - z * ce) / below;
  const right = a * (eye.away_m + into * ce - z * se);
  return [eye.at[0] + right * ca + into * sa, eye.at[1] - right * sa + into * ca, 0];
}

// So that all of the site is in sight.
function around(places: Vector[]): View {
  const middle = (i: number) => (Math.min(...places.map((p) => p[i])) + Math.max(...places.map((p) => p[i]))) / 2;
  const at: Vector = [middle(0), middle(1), middle(2)];
  const size = Math.max(100, ...places.map((p) => Math.hypot(p[0] - at[0], p[1] - at[1], p[2] - at[2])));
  return { at, away_m: 3.2 * size };
}
