// The site in three dimensions: stations, rays, targets with their 95 % ellipsoids and trails. It works
// in every browser: it is projected here and drawn on a plain canvas.

import { h } from "preact";
import { useLayoutEffect, useRef, useState } from "preact/hooks";
import type { Land } from "./land";
import type { Link } from "./link";
import { ringName, roundStep } from "./measures";
import { useOrbit, useTurning } from "./orbit";
import { beyond, boxesOver, takenByPanel } from "./overlays";
import { useRuler } from "./ruler3d";
import { draw, frameOf, groundAt, groundStrokes, LARGER, type Layers, Scene } from "./scene3d";
import { TerrainPainter, useTerrain } from "./terrain3d";
import { t } from "./words";

type Props = {
  link: Link;
  land: Land | null;
  version: number;
  theme: string;
  selected: string;
  options: Layers & { follow: boolean; measuring: boolean };
  onPick: (pick: string) => void;
  onMeasured: (text: string) => void;
};

type ToolsProps = { step_m: number; larger: number; onLarger: (factor: number) => void; onFit: () => void };

function Tools({ step_m, larger, onLarger, onFit }: ToolsProps) {
  return (
    <div class="view-3d-tools">
      <button type="button" onClick={onFit}>
        {t("fit")}
      </button>
      <label>
        {t("ellipsoids")}
        <select value={String(larger)} onChange={(e) => onLarger(Number(e.currentTarget.value))}>
          {LARGER.map((factor) => (
            <option value={String(factor)}>{factor === 1 ? t("true_size") : `${factor}×`}</option>
          ))}
        </select>
      </label>
      <span>
        {t("grid_step")} {ringName(step_m, 1)}
      </span>
    </div>
  );
}

// What the panel leaves.
const sizeOf = (canvas: HTMLCanvasElement): [number, number] => [canvas.clientWidth - takenByPanel(canvas), canvas.clientHeight];

export function View3d({ link, land, version, theme, selected, options, onPick, onMeasured }: Props) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const [larger, setLarger] = useState(1);
  const drawn = useRef<Scene | null>(null);
  const orbit = useOrbit();
  const painter = useRef<TerrainPainter>();
  painter.current ??= new TerrainPainter();
  const terrain = useTerrain(land, [...link.site.stations.values()], [...link.site.targets.values()]);
  const ruler = useRuler(options.measuring, onMeasured);
  useLayoutEffect(() => {
    const frame = frameOf([...link.site.stations.values()]);
    if (!frame || !canvas.current) return;
    const style = getComputedStyle(document.documentElement);
    const colour = (name: string) => style.getPropertyValue(name).trim();
    const scene = new Scene(frame, colour, larger);
    if (drawn.current) scene.sides = drawn.current.sides;
    const { whole, followed } = scene.addSite(link.site, selected, options);
    orbit.look(whole, options.follow ? followed : null);
    if (options.rings) scene.addRings(roundStep(2 * orbit.step_m()));
    if (options.measuring) ruler.drawOn(scene);
    drawn.current = scene;
    const eye = orbit.shown.current;
    const over = [...boxesOver(canvas.current), ...beyond(canvas.current.clientWidth, canvas.current.clientHeight)];
    const ground = options.grid ? groundStrokes(eye, colour("--map-grid")) : [];
    const { clientWidth, clientHeight } = canvas.current;
    const land = terrain && options.terrain ? painter.current!.picture(terrain, eye, sizeOf(canvas.current), [clientWidth, clientHeight], devicePixelRatio, colour("--map-terrain")) : null;
    draw(canvas.current, scene, ground, land, eye, sizeOf(canvas.current), over, colour);
  }, [version, orbit.eye, larger, theme, selected, options, ruler.ends, terrain]);
  const click = (event: PointerEvent) => {
    const rect = canvas.current!.getBoundingClientRect();
    const pixel: [number, number] = [event.clientX - rect.left, event.clientY - rect.top];
    const size = sizeOf(canvas.current!);
    const id = drawn.current?.thingAt(pixel, orbit.shown.current, size) ?? "";
    if (!options.measuring) return id && onPick(id);
    const at = drawn.current?.placeOf(id) ?? groundAt(pixel, orbit.shown.current, size);
    if (at) ruler.add({ id, at });
  };
  const turning = useTurning(orbit.turn, click);
  return (
    <div class="view-3d">
      <canvas ref={canvas} role="img" aria-label={t("view_3d")} tabIndex={0} {...turning} />
      <Tools step_m={orbit.step_m()} larger={larger} onLarger={setLarger} onFit={orbit.fit} />
    </div>
  );
}
