// The map: OpenLayers on its Canvas renderer. Everything on it is drawn from the site's state.

import { h, Fragment } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import Feature from "ol/Feature";
import OlMap from "ol/Map";
import View from "ol/View";
import Graticule from "ol/layer/Graticule";
import VectorLayer from "ol/layer/Vector";
import VectorSource from "ol/source/Vector";
import TopoJSON from "ol/format/TopoJSON";
import LineString from "ol/geom/LineString";
import Point from "ol/geom/Point";
import Polygon from "ol/geom/Polygon";
import ScaleLine from "ol/control/ScaleLine";
import { defaults as defaultInteractions } from "ol/interaction/defaults";
import { createEmpty, extend, intersects, isEmpty, getCenter } from "ol/extent";
import { fromLonLat, toLonLat, transformExtent } from "ol/proj";
import { Circle, Fill, Stroke, Style, Text } from "ol/style";
import type { Coordinate } from "ol/coordinate";
import type { Link } from "./link";
import { fineOutline } from "./marks";
import { ACCURACY_STEPS, AccuracyChoice, AccuracyLayer, UserMap, UserMapLayers, userMaps, UserMaps } from "./maplayers";
import type { Border, Station, Target } from "./site";
import { View3d } from "./view3d";
import { bearing, distance, fixed } from "./format";
import { named, t } from "./words";

type Colours = Record<string, string>;
const COLOUR_NAMES = ["land", "sea", "rule", "rule-text", "grid", "text", "halo", "station", "station-quiet", "ray", "wedge", "target", "born", "coasted", "trail", "ring", "accent", "alarm", "keep-out"];

function readColours(): Colours {
  const style = getComputedStyle(document.documentElement);
  return Object.fromEntries(COLOUR_NAMES.map((name) => [name, style.getPropertyValue(`--map-${name}`).trim()]));
}

const RAY_M = 20_000;
const WEDGE_M = 2_000;
const VELOCITY_S = 5;
const BORDER_PART = 0.17; // of the view: how far borders are drawn from their station
const FONT = "600 12px Inter, system-ui, 'DejaVu Sans', sans-serif";
const SMALL_FONT = "11px Inter, system-ui, 'DejaVu Sans', sans-serif";

// Web Mercator is conformal: what is metres on the ground is this much on the map, in any direction.
const stretch = (latitude_deg: number) => 1 / Math.cos((latitude_deg * Math.PI) / 180);

function offset(from: Coordinate, azimuth_deg: number, metres: number, scale: number): Coordinate {
  const a = (azimuth_deg * Math.PI) / 180;
  return [from[0] + Math.sin(a) * metres * scale, from[1] + Math.cos(a) * metres * scale];
}

function shape(geometry: Point | LineString | Polygon, style: Style | Style[], id = ""): Feature {
  const feature = new Feature(geometry);
  feature.setStyle(style);
  if (id) feature.set("pick", id);
  return feature;
}

const label = (text: string, colour: string, halo: string, dx: number, dy: number, font = FONT) =>
  new Text({ text, font, fill: new Fill({ color: colour }), stroke: new Stroke({ color: halo, width: 3 }), offsetX: dx, offsetY: dy, textAlign: dx >= 0 ? "left" : "right" });

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

function stationShapes(s: Station, c: Colours, selected: boolean, views: boolean, border_m: number | null): Feature[] {
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
    out.push(shape(new LineString([at, far]), new Style({ stroke: new Stroke({ color: c.ray, width: selected ? 2 : 1.2 }) })));
  }
  out.push(
    shape(
      new Point(at),
      [
        new Style({ image: new Circle({ radius: selected ? 11 : 8, stroke: new Stroke({ color: selected ? c.accent : "transparent", width: 2 }) }) }),
        new Style({ image: new Circle({ radius: 6, fill: new Fill({ color: colour }), stroke: new Stroke({ color: c.halo, width: 2 }) }), text: label(s.id, c.text, c.halo, 13, 0) }),
      ],
      `station:${s.id}`,
    ),
  );
  return out;
}

function ellipseRing(target: Target, at: Coordinate, scale: number): Coordinate[] | null {
  const e = target.ellipse95;
  if (!e) return null;
  const a = (e.azimuth_deg * Math.PI) / 180;
  const ring: Coordinate[] = [];
  for (let i = 0; i <= 64; i++) {
    const u = (2 * Math.PI * i) / 64;
    const along = e.semi_major_m * Math.cos(u);
    const across = e.semi_minor_m * Math.sin(u);
    ring.push([at[0] + scale * (along * Math.sin(a) + across * Math.cos(a)), at[1] + scale * (along * Math.cos(a) - across * Math.sin(a))]);
  }
  return ring;
}

const targetColour = (target: Target, c: Colours) =>
  target.stale || target.state === "coasted" ? c.coasted : target.state === "born" ? c.born : c.target;

function targetShapes(target: Target, c: Colours, selected: boolean, trails: boolean): Feature[] {
  if (target.latitude_deg == null) return [];
  const at = fromLonLat([target.longitude_deg, target.latitude_deg]);
  const scale = stretch(target.latitude_deg);
  const colour = targetColour(target, c);
  const out: Feature[] = [];
  if (trails && target.trail?.length > 1) {
    const path = target.trail.map(([longitude, latitude]) => fromLonLat([longitude, latitude]));
    out.push(shape(new LineString([...path, at]), new Style({ stroke: new Stroke({ color: c.trail, width: selected ? 2.5 : 1.5 }) })));
  }
  const ring = ellipseRing(target, at, scale);
  if (ring) out.push(shape(new Polygon([ring]), new Style({ stroke: new Stroke({ color: colour, width: 1.5 }), fill: new Fill({ color: c.trail.replace(/[\d.]+\)$/, "0.12)") }) })));
  const [east, north] = target.velocity_enu_m_s ?? [];
  if (east != null && north != null) {
    const ahead = [at[0] + east * VELOCITY_S * scale, at[1] + north * VELOCITY_S * scale];
    out.push(shape(new LineString([at, ahead]), new Style({ stroke: new Stroke({ color: colour, width: 2 }) })));
  }
  const text = `${target.id}   ${fixed(target.height_m, 0, " m")}   ${fixed(target.speed_m_s, 0, " m/s")}`;
  out.push(
    shape(
      new Point(at),
      [
        new Style({ image: new Circle({ radius: selected ? 12 : 8, stroke: new Stroke({ color: selected ? c.accent : colour, width: 2 }) }) }),
        new Style({ image: new Circle({ radius: 3.5, fill: new Fill({ color: colour }) }), text: label(text, c.text, c.halo, 16, -12) }),
      ],
      `target:${target.id}`,
    ),
  );
  return out;
}

// Lines of sight of stations whose object has no position yet.
function lineShapes(link: Link, c: Colours): Feature[] {
  const out: Feature[] = [];
  for (const line of link.site.lines.values()) {
    const s = link.site.stations.get(line.id);
    if (line.stale || !s || s.latitude_deg == null || s.longitude_deg == null) continue;
    const at = fromLonLat([s.longitude_deg, s.latitude_deg]);
    const far = offset(at, line.azimuth_deg, RAY_M, stretch(s.latitude_deg));
    out.push(shape(new LineString([at, far]), new Style({ stroke: new Stroke({ color: c.born, width: 1.5, lineDash: [8, 6] }) })));
  }
  return out;
}

// A ring of one deviation, dashed: nothing that this site has measured.
function cueShapes(link: Link, c: Colours): Feature[] {
  const out: Feature[] = [];
  if (link.site.fusion?.stale) return out;
  for (const cue of link.site.fusion?.cues ?? []) {
    if (cue.latitude_deg == null || cue.longitude_deg == null) continue;
    const at = fromLonLat([cue.longitude_deg, cue.latitude_deg]);
    const colour = cue.state === "searched" ? c.accent : c.born;
    const ring: Coordinate[] = [];
    for (let k = 0; k <= 48; k++) ring.push(offset(at, (360 * k) / 48, cue.horizontal_sd_m ?? 0, stretch(cue.latitude_deg)));
    out.push(shape(new LineString(ring), new Style({ stroke: new Stroke({ color: colour, width: 1.5, lineDash: [4, 4] }) })));
    const text = `${cue.label || cue.id}   ${named("s", cue.state)}`;
    out.push(shape(new Point(at), new Style({ image: new Circle({ radius: 5, stroke: new Stroke({ color: colour, width: 1.5, lineDash: [2, 2] }) }), text: label(text, c["rule-text"], c.halo, 10, 12, SMALL_FONT) })));
  }
  return out;
}

function siteMiddle(link: Link): { at: Coordinate; latitude: number } | null {
  const placed = [...link.site.stations.values()].filter((s) => s.latitude_deg != null && s.longitude_deg != null);
  if (!placed.length) return null;
  const latitude = placed.reduce((sum, s) => sum + s.latitude_deg!, 0) / placed.length;
  const longitude = placed.reduce((sum, s) => sum + s.longitude_deg!, 0) / placed.length;
  return { at: fromLonLat([longitude, latitude]), latitude };
}

// Three to six circles in view, of round radii.
function ringShapes(link: Link, c: Colours, view_m: number): Feature[] {
  const middle = siteMiddle(link);
  if (!middle) return [];
  let step = 10 ** Math.floor(Math.log10(Math.max(view_m / 5, 1)));
  for (const part of [2, 5]) if (view_m / (step * part) > 4) step *= part === 2 ? 2 : 2.5;
  const out: Feature[] = [];
  const scale = stretch(middle.latitude);
  for (let i = 1; i <= 6; i++) {
    const ring: Coordinate[] = [];
    for (let k = 0; k <= 96; k++) ring.push(offset(middle.at, (360 * k) / 96, step * i, scale));
    out.push(shape(new LineString(ring), new Style({ stroke: new Stroke({ color: c.ring, width: 1 }) })));
    out.push(shape(new Point(offset(middle.at, 0, step * i, scale)), new Style({ text: label(distance(step * i), c["rule-text"], c.halo, 4, -7, SMALL_FONT) })));
  }
  return out;
}

type Grid = { zone: number; northern: boolean; step_m: number; lines: { at_m: number; is_easting: boolean; path: [number, number][] }[] };

function gridShapes(grid: Grid | null, c: Colours): Feature[] {
  if (!grid) return [];
  const out: Feature[] = [];
  for (const line of grid.lines) {
    const path = line.path.map((place) => fromLonLat(place));
    out.push(shape(new LineString(path), new Style({ stroke: new Stroke({ color: c.grid, width: 1 }) })));
    const km = line.at_m / 1000;
    if (path.length < 3) continue;
    const text = (grid.step_m >= 1000 ? km.toFixed(0) : km.toFixed(grid.step_m >= 100 ? 1 : 2)) + (line.is_easting ? " E" : " N");
    out.push(shape(new Point(path[1]), new Style({ text: label(text, c["rule-text"], c.halo, 3, -6, SMALL_FONT) })));
  }
  return out;
}

// How fast the page may redraw its map.
const FRAME_MS = 40;

class SiteMap {
  readonly map: OlMap;
  private moving = new VectorSource();
  private still = new VectorSource();
  private measured = new VectorSource();
  private land: VectorLayer<any>;
  private graticule: Graticule | null = null;
  private grid: Grid | null = null;
  private colours: Colours = readColours();
  private drawn_ms = 0;
  private newest_us = 0; // of the targets that are drawn
  private stationsFitted = 0;
  private hasMoved = false;
  private from: Coordinate | null = null;
  private accuracy: AccuracyLayer;
  private userLayers: UserMapLayers;
  private accuracyShown: AccuracyChoice | null = null;
  options = { rings: true, grid: true, trails: true, views: true, limits: true, follow: false, measuring: false };
  selected = "";
  onPick: (pick: string) => void = () => {};
  onMeasured: (text: string) => void = () => {};
  onMapTrouble: () => void = () => {};

  constructor(
    private link: Link,
    element: HTMLElement,
  ) {
    this.land = new VectorLayer({ source: new VectorSource(), declutter: false });
    this.map = new OlMap({
      target: element,
      layers: [this.land, new VectorLayer({ source: this.still }), new VectorLayer({ source: this.moving, updateWhileInteracting: true, updateWhileAnimating: true }), new VectorLayer({ source: this.measured })],
      controls: [new ScaleLine({ minWidth: 90 })],
      interactions: defaultInteractions({ altShiftDragRotate: false, pinchRotate: false }),
      view: new View({ center: fromLonLat([15, 50]), zoom: 4, maxZoom: 24, enableRotation: false }),
    });
    this.userLayers = new UserMapLayers(this.map, () => this.onMapTrouble());
    this.accuracy = new AccuracyLayer(this.map);
    this.map.on("moveend", () => this.settled());
    // What is on the screen now, for whoever measures.
    this.map.on("postrender", () => (element.dataset.newestUs = String(this.newest_us)));
    this.map.on("pointerdrag", () => (this.hasMoved = true));
    element.addEventListener("wheel", () => (this.hasMoved = true), { passive: true });
    this.map.on("click", (event) => (this.options.measuring ? this.measure(event.coordinate) : this.pick(event.pixel)));
    this.restyle();
    void this.loadLand();
  }

  // Large, and decoration: after the first paint.
  private async loadLand() {
    const response = await fetch("/land.json").catch(() => null);
    if (!response?.ok) return;
    const features = new TopoJSON().readFeatures(await response.json(), { featureProjection: "EPSG:3857" });
    this.land.getSource()!.addFeatures(features as any);
  }

  restyle() {
    const c = (this.colours = readColours());
    this.land.setStyle(new Style({ fill: new Fill({ color: c.land }), stroke: new Stroke({ color: c.rule, width: 1 }) }));
    if (this.graticule) this.map.removeLayer(this.graticule);
    const text = () => new Text({ font: SMALL_FONT, fill: new Fill({ color: c["rule-text"] }), stroke: new Stroke({ color: c.halo, width: 3 }) });
    this.graticule = new Graticule({ strokeStyle: new Stroke({ color: c.rule, width: 1 }), showLabels: true, wrapX: false, maxLines: 40, targetSize: 160, lonLabelStyle: text(), latLabelStyle: text() });
    this.map.getLayers().insertAt(1, this.graticule);
    this.drawStill();
    this.draw(true);
  }

  private pick(pixel: number[]) {
    const picks: string[] = [];
    this.map.forEachFeatureAtPixel(pixel, (feature) => void (feature.get("pick") && picks.push(feature.get("pick"))), { hitTolerance: 8 });
    const best = picks.find((one) => one.startsWith("target:")) ?? picks[0];
    if (best) this.onPick(best);
  }

  private async measure(at: Coordinate) {
    const dot = (where: Coordinate) => shape(new Point(where), new Style({ image: new Circle({ radius: 4, fill: new Fill({ color: this.colours.accent }) }) }));
    if (!this.from) {
      this.from = at;
      this.measured.clear();
      this.measured.addFeature(dot(at));
      return;
    }
    const [a, b] = [toLonLat(this.from), toLonLat(at)];
    this.measured.addFeatures([dot(at), shape(new LineString([this.from, at]), new Style({ stroke: new Stroke({ color: this.colours.accent, width: 2, lineDash: [6, 4] }) }))]);
    this.from = null;
    const response = await fetch(`/api/measure?from=${a[1]},${a[0]}&to=${b[1]},${b[0]}`).catch(() => null);
    if (!response?.ok) return;
    const { distance_m, azimuth_deg } = await response.json();
    this.onMeasured(`${distance(distance_m)}   ${bearing(azimuth_deg)}`);
  }

  endMeasuring() {
    this.from = null;
    this.measured.clear();
  }

  fit() {
    const extent = createEmpty();
    for (const s of this.link.site.stations.values()) {
      if (s.latitude_deg != null && s.longitude_deg != null) extend(extent, new Point(fromLonLat([s.longitude_deg, s.latitude_deg])).getExtent());
    }
    for (const target of this.link.site.targets.values()) {
      if (target.latitude_deg != null && !target.stale) extend(extent, new Point(fromLonLat([target.longitude_deg, target.latitude_deg])).getExtent());
    }
    if (isEmpty(extent)) return;
    this.map.getView().fit(extent, { padding: [70, 90, 60, 70], maxZoom: 19 });
  }

  private view_m(): number {
    const size = this.map.getSize() ?? [600, 400];
    const latitude = toLonLat(this.map.getView().getCenter()!)[1];
    return ((this.map.getView().getResolution() ?? 1) * Math.min(...size)) / stretch(latitude);
  }

  showMaps(chosen: UserMap[]) {
    this.userLayers.show(chosen);
  }

  // A plan may be of another place than the one that is shown. False: it could not be had.
  async showAccuracy(choice: AccuracyChoice | null): Promise<boolean> {
    this.accuracyShown = choice;
    const shown = await this.accuracy.show(choice);
    const extent = this.accuracy.planExtent();
    if (extent && !intersects(extent, this.map.getView().calculateExtent())) this.map.getView().fit(extent, { padding: [40, 40, 40, 40] });
    return shown;
  }

  private async settled() {
    this.drawStill();
    this.draw(true); // what is drawn at the size of the view
    if (this.accuracyShown && this.accuracyShown.plan === undefined) void this.accuracy.show(this.accuracyShown);
    const box = transformExtent(this.map.getView().calculateExtent(), "EPSG:3857", "EPSG:4326");
    const isSmall = box[2] - box[0] < 3 && box[3] - box[1] < 3;
    this.graticule?.setVisible(!isSmall || !this.options.grid);
    const response = isSmall && this.options.grid ? await fetch(`/api/grid?box=${box.map((v) => v.toFixed(7)).join()}`).catch(() => null) : null;
    this.grid = response?.ok ? await response.json() : null;
    this.drawStill();
  }

  drawStill() {
    this.still.clear(true);
    if (this.options.grid) this.still.addFeatures(gridShapes(this.grid, this.colours));
    if (this.options.rings) this.still.addFeatures(ringShapes(this.link, this.colours, this.view_m()));
  }

  setOption(name: keyof SiteMap["options"], value: boolean) {
    this.options[name] = value;
    if (name === "measuring" && !value) this.endMeasuring();
    void this.settled();
    this.draw(true);
  }

  draw(now = false) {
    const time = performance.now();
    if (!now && time - this.drawn_ms < FRAME_MS) return;
    this.drawn_ms = time;
    const { site } = this.link;
    const features: Feature[] = [];
    const border_m = this.options.limits ? BORDER_PART * this.view_m() : null;
    for (const s of site.stations.values()) features.push(...stationShapes(s, this.colours, this.selected === `station:${s.id}`, this.options.views, border_m));
    features.push(...lineShapes(this.link, this.colours));
    features.push(...cueShapes(this.link, this.colours));
    for (const target of site.targets.values()) features.push(...targetShapes(target, this.colours, this.selected === `target:${target.id}`, this.options.trails));
    this.moving.clear(true);
    this.moving.addFeatures(features);
    this.newest_us = Math.max(0, ...[...site.targets.values()].map((target) => target.utime_us));
    this.keepInView();
  }

  private keepInView() {
    const placed = [...this.link.site.stations.values()].filter((s) => s.latitude_deg != null).length;
    if (placed > this.stationsFitted && !this.hasMoved) {
      this.stationsFitted = placed;
      this.fit();
    }
    if (!this.options.follow || !this.selected.startsWith("target:")) return;
    const target = this.link.site.targets.get(this.selected.slice(7));
    if (target?.latitude_deg != null) this.map.getView().setCenter(fromLonLat([target.longitude_deg, target.latitude_deg]));
  }

  middle(): Coordinate {
    return getCenter(this.map.getView().calculateExtent());
  }
}

const ABOVE_M = [50, 100, 300, 1000, 3000];

// The users' maps, each with its trouble in words, and the accuracy at a height.
function OwnMaps({ map }: { map: SiteMap }) {
  const [known, setKnown] = useState<UserMaps>({ maps: [], problem: "" });
  const [chosen, setChosen] = useState<string[] | null>(null); // null: all of them
  const [accuracy, setAccuracy] = useState<AccuracyChoice | null>(null);
  const [failed, setFailed] = useState(false);
  const look = () => void userMaps().then(setKnown);
  useEffect(() => {
    look();
    let waiting = 0;
    // Many tiles fail at once.
    map.onMapTrouble = () => (waiting ||= window.setTimeout(() => ((waiting = 0), look()), 1000));
    return () => clearTimeout(waiting);
  }, []);
  const choose = (choice: AccuracyChoice | null) => {
    setAccuracy(choice);
    void map.showAccuracy(choice).then((shown) => setFailed(!shown));
  };
  const isShown = (one: UserMap) => chosen === null || chosen.includes(one.id);
  useEffect(() => map.showMaps(known.maps.filter((one) => isShown(one))), [known, chosen]);
  const toggle = (id: string) => {
    const all = known.maps.filter(isShown).map((one) => one.id);
    setChosen(all.includes(id) ? all.filter((one) => one !== id) : [...all, id]);
  };
  return (
    <Fragment>
      {known.problem && <p class="map-problem" role="alert">{known.problem}</p>}
      {known.maps.map((one) => (
        <Fragment key={one.id}>
          {one.zoom && (
            <button type="button" aria-pressed={isShown(one)} onClick={() => toggle(one.id)}>
              {one.name}
            </button>
          )}
          {one.problem && <p class="map-problem" role="alert">{`${one.name}: ${one.problem}`}</p>}
        </Fragment>
      ))}
      <label>
        {t("accuracy")}
        <select value={JSON.stringify(accuracy)} onChange={(e) => choose(JSON.parse(e.currentTarget.value))}>
          <option value="null">{t("off")}</option>
          <optgroup label={t("site_now")}>
            {ABOVE_M.map((above_m) => (
              <option value={JSON.stringify({ above_m })}>{`${t("above")} ${above_m} m`}</option>
            ))}
          </optgroup>
          {known.maps.map((one) =>
            one.above_m ? (
              <optgroup label={one.name} key={one.id}>
                {one.above_m.map((above_m) => (
                  <option value={JSON.stringify({ above_m, plan: one.id })}>{`${one.name}, ${t("above")} ${above_m} m`}</option>
                ))}
              </optgroup>
            ) : null,
          )}
        </select>
      </label>
      {failed && <p class="map-problem" role="alert">{t("no_accuracy")}</p>}
      {accuracy && (
        <ul class="legend" aria-label={t("accuracy")}>
          {ACCURACY_STEPS.map(([most, colour]) => (
            <li>
              <svg width="12" height="12" aria-hidden="true">
                <rect width="12" height="12" fill={colour} />
              </svg>
              ≤ {most} m
            </li>
          ))}
        </ul>
      )}
    </Fragment>
  );
}

type Props = { link: Link; version: number; theme: string; selected: string; onPick: (pick: string) => void };

export function MapView({ link, version, theme, selected, onPick }: Props) {
  const element = useRef<HTMLDivElement>(null);
  const map = useRef<SiteMap | null>(null);
  const [options, setOptions] = useState({ rings: true, grid: true, trails: true, views: true, limits: true, follow: false, measuring: false });
  const [measured, setMeasured] = useState("");
  const [made, setMade] = useState<SiteMap | null>(null);
  const [isSolid, setSolid] = useState(false);
  useEffect(() => {
    const one = new SiteMap(link, element.current!);
    map.current = one;
    one.onMeasured = setMeasured;
    setMade(one);
    return () => one.map.setTarget(undefined);
  }, []);
  useEffect(() => map.current?.restyle(), [theme]);
  useEffect(() => {
    if (!map.current) return;
    map.current.onPick = onPick;
    map.current.selected = selected;
    map.current.draw(true);
  }, [selected, onPick]);
  useEffect(() => map.current?.draw(), [version]);
  const toggle = (name: keyof typeof options) => {
    const value = !options[name];
    setOptions({ ...options, [name]: value });
    if (name === "measuring") setMeasured("");
    map.current?.setOption(name, value);
  };
  const button = (name: keyof typeof options, text: string) => (
    <button type="button" aria-pressed={options[name]} onClick={() => toggle(name)}>
      {text}
    </button>
  );
  return (
    <section class="map" aria-label={t("map")}>
      <div class="map-canvas" ref={element} tabIndex={0} role="application" aria-label={t("map")} />
      {isSolid && <View3d link={link} version={version} theme={theme} selected={selected} follow={options.follow} />}
      <div class="map-tools" role="toolbar" aria-label={t("layers")}>
        <button type="button" onClick={() => map.current?.fit()}>
          {t("fit")}
        </button>
        {button("follow", t("follow"))}
        <button type="button" aria-pressed={isSolid} onClick={() => setSolid(!isSolid)}>
          {t("view_3d")}
        </button>
        {button("measuring", t("measure"))}
        <details class="layers">
          <summary>{t("layers")}</summary>
          <div>
            {button("grid", t("grid"))}
            {button("rings", t("rings"))}
            {button("trails", t("trails"))}
            {button("views", t("views"))}
            {button("limits", t("limits"))}
            {made && <OwnMaps map={made} />}
          </div>
        </details>
      </div>
      {!isSolid && (
        <div class="map-north" aria-hidden="true">
          <span>N</span>
        </div>
      )}
      {options.measuring && (
        <output class="map-measure">{measured || t("measure_hint")}</output>
      )}
    </section>
  );
}
