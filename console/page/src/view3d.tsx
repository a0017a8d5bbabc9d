// The site in three dimensions: stations, rays, targets with their 95 % ellipsoids and trails. It works
// in every browser: it is projected here and drawn on a plain canvas.

import { h } from "preact";
import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import { bearing, distance, fixed } from "./format";
import { Pinch, STILL_PX } from "./hand";
import type { Link } from "./link";
import { around, draw, type Eye, frameOf, groundAt, groundStrokes, LARGER, type Layers, RAY_M, roundStep, Scene, type Vector } from "./scene3d";
import { followed } from "./site";
import { t } from "./words";

// An end of what is measured: a thing, which may move, or a place on the ground.
type End = { id: string; at: Vector };
type Press = { at: [number, number]; from: [number, number]; isDrag: boolean };
type Props = {
  link: Link;
  version: number;
  theme: string;
  selected: string;
  options: Layers & { follow: boolean; measuring: boolean };
  onPick: (pick: string) => void;
  onMeasured: (text: string) => void;
};

// From the one to the other, in a straight line.
function measured([a, b]: Vector[]): string {
  const [east, north, up] = b.map((v, i) => v - a[i]);
  const flat = Math.hypot(east, north);
  const azimuth = ((Math.atan2(east, north) * 180) / Math.PI + 360) % 360;
  const elevation = (Math.atan2(up, flat) * 180) / Math.PI;
  return `${distance(Math.hypot(flat, up))}   ${bearing(azimuth)}   ${t("elevation")} ${fixed(elevation, 1, "°")}`;
}

export function View3d({ link, version, theme, selected, options, onPick, onMeasured }: Props) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const [eye, setEye] = useState<Eye | null>(null); // null: as far as all of the site needs
  const [larger, setLarger] = useState(1);
  const [ends, setEnds] = useState<End[]>([]);
  const press = useRef<Press | null>(null);
  const shown = useRef<Eye>({ azimuth: 0.5, elevation: 0.45, away_m: 1000, at: [0, 0, 0] });
  const drawn = useRef<Scene | null>(null);
  const pinch = useRef(new Pinch());
  const step = () => roundStep(shown.current.away_m / 12);
  const build = (frame: NonNullable<ReturnType<typeof frameOf>>, colour: (name: string) => string): Scene => {
    const scene = new Scene(frame, colour, larger);
    const { site } = link;
    const targets = [...site.targets.values()].map((target) => ({ target, at: scene.addTarget(target, selected === `target:${target.id}`, options.trails) }));
    const placed = [...site.stations.values()].filter((s) => s.latitude_deg != null && s.longitude_deg != null && s.height_m != null);
    const places = placed.map((s) => frame.place(s.latitude_deg!, s.longitude_deg!, s.height_m!));
    const whole = around([...places, ...targets.flatMap(({ at }) => (at ? [at] : []))]);
    const reach_m = Math.max(RAY_M, whole.away_m);
    for (const station of placed) scene.addStation(station, reach_m, options, selected === `station:${station.id}`);
    for (const line of site.lines.values()) scene.addLine(line, site.stations.get(line.id), reach_m);
    shown.current = eye ?? { ...shown.current, ...whole };
    const middle = options.follow && targets.find(({ target }) => target === followed(site, selected))?.at;
    if (middle) shown.current = { ...shown.current, at: middle };
    if (options.rings) scene.addRings(2 * step());
    return scene;
  };
  useLayoutEffect(() => {
    const frame = frameOf([...link.site.stations.values()]);
    if (!frame || !canvas.current) return;
    const style = getComputedStyle(document.documentElement);
    const colour = (name: string) => style.getPropertyValue(name).trim();
    const scene = build(frame, colour);
    if (options.measuring) {
      const places = ends.map(({ id, at }) => scene.placeOf(id) ?? at);
      scene.addMeasured(places);
      if (places.length === 2) onMeasured(measured(places));
    }
    drawn.current = scene;
    draw(canvas.current, scene, options.grid ? groundStrokes(shown.current, colour("--map-grid")) : [], shown.current, colour);
  }, [version, eye, larger, theme, selected, options, ends]);
  useEffect(() => setEnds([]), [options.measuring]);
  const turn = (azimuth: number, elevation: number, away = 1) => {
    const now = shown.current;
    const steep = Math.max(-0.1, Math.min(1.55, now.elevation + elevation));
    setEye({ ...now, azimuth: now.azimuth + azimuth, elevation: steep, away_m: Math.max(20, Math.min(1e6, now.away_m * away)) });
  };
  const click = (event: PointerEvent) => {
    const rect = canvas.current!.getBoundingClientRect();
    const pixel: [number, number] = [event.clientX - rect.left, event.clientY - rect.top];
    const size: [number, number] = [rect.width, rect.height];
    const id = drawn.current?.thingAt(pixel, shown.current, size) ?? "";
    if (!options.measuring) return id && onPick(id);
    const at = drawn.current?.placeOf(id) ?? groundAt(pixel, shown.current, size);
    if (!at) return;
    onMeasured("");
    setEnds(ends.length === 1 ? [ends[0], { id, at }] : [{ id, at }]);
  };
  const down = (event: PointerEvent) => {
    const from: [number, number] = [event.clientX, event.clientY];
    press.current = { at: from, from, isDrag: false };
    pinch.current.down(event);
    if (pinch.current.isTwo) press.current.isDrag = true;
    (event.currentTarget as Element).setPointerCapture(event.pointerId);
  };
  const move = (event: PointerEvent) => {
    if (pinch.current.isTwo) return turn(0, 0, 1 / pinch.current.move(event));
    const now = press.current;
    if (!now) return;
    const [x, y] = [event.clientX, event.clientY];
    now.isDrag ||= Math.hypot(x - now.from[0], y - now.from[1]) > STILL_PX;
    if (!now.isDrag) return;
    turn((now.at[0] - x) * -0.006, (y - now.at[1]) * 0.005);
    now.at = [x, y];
  };
  const up = (event: PointerEvent) => {
    pinch.current.up(event);
    const isClick = event.type === "pointerup" && press.current && !press.current.isDrag && event.button === 0;
    press.current = null;
    if (isClick) click(event);
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
        onPointerDown={down}
        onPointerMove={move}
        onPointerUp={up}
        onPointerCancel={up}
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
          {t("grid_step")} {distance(step())}
        </span>
      </div>
    </div>
  );
}
