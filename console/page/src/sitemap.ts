// The map itself: OpenLayers on its Canvas renderer. Everything on it is drawn from the site's state.

import type Feature from "ol/Feature";
import OlMap from "ol/Map";
import View from "ol/View";
import Graticule from "ol/layer/Graticule";
import VectorLayer from "ol/layer/Vector";
import VectorSource from "ol/source/Vector";
import TopoJSON from "ol/format/TopoJSON";
import LineString from "ol/geom/LineString";
import Point from "ol/geom/Point";
import Attribution from "ol/control/Attribution";
import DoubleClickZoom from "ol/interaction/DoubleClickZoom";
import DragZoom from "ol/interaction/DragZoom";
import { defaults as defaultInteractions } from "ol/interaction/defaults";
import { createEmpty, extend, intersects, isEmpty } from "ol/extent";
import { fromLonLat, toLonLat, transformExtent } from "ol/proj";
import { Circle, Fill, RegularShape, Stroke, Style, Text } from "ol/style";
import type { Coordinate } from "ol/coordinate";
import { areaShapes, draftShapes } from "./areashapes";
import { bearing } from "./format";
import { GroundProbe } from "./groundprobe";
import { Grid, gridShapes, type HasRoom, ringShapes } from "./gridshapes";
import { type Box, meet, type Named, type Side, sidesOf } from "./labels";
import type { Link } from "./link";
import { Colours, FONT, heightColours, readColours, shape, SMALL_FONT, stretch } from "./mapfeatures";
import { AccuracyChoice, AccuracyLayer, UserMap, UserMapLayers } from "./maplayers";
import { distance, measures } from "./measures";
import { beyond, boxesOver, shownExtent, takenByPanel } from "./overlays";
import { placeOf } from "./placepanel";
import { ScaleInMetres } from "./scale";
import { Questions } from "./questions";
import { type Corner, cuesOnMap, followed } from "./site";
import { stationWords } from "./statetext";
import { lineShapes, stationShapes } from "./stationshapes";
import { cueShapes, cueWords, targetShapes, targetWords } from "./targetshapes";
import { trailShapes } from "./trailshapes";

const LABELS = "labels"; // of two that would cover each other, that of the upper layer is drawn
const BORDER_PART = 0.17; // of the view: how far borders are drawn from their station

// The layers, and what a click means, when the page opens.
export const OPTIONS = { terrain: true, rings: true, grid: true, trails: true, views: true, limits: true, follow: false, measuring: false, placing: false };

export class SiteMap {
  readonly map: OlMap;
  private moving = new VectorSource();
  private still = new VectorSource();
  private measured = new VectorSource();
  private doubleClick = new DoubleClickZoom();
  private scale = new ScaleInMetres({ minWidth: 90 });
  private land: VectorLayer<any>;
  private graticule: Graticule | null = null;
  private grid: Grid | null = null;
  private grids = new Questions();
  private colours: Colours = readColours();
  private heightColours = heightColours();
  private newest_us = 0; // of the targets that are drawn
  private stationsFitted = 0;
  private hasMoved = false;
  private from: Coordinate | null = null;
  private accuracy: AccuracyLayer;
  private userLayers: UserMapLayers;
  private accuracyShown: AccuracyChoice | null = null;
  private sides = new Map<string, Side | null>();
  private over: Box[] = []; // what covers the map
  private probe = new GroundProbe((text) => this.onGround(text));
  private pen = document.createElement("canvas").getContext("2d")!;
  options = { ...OPTIONS };
  selected = "";
  draft: Corner[] | null = null; // of an area that is being drawn
  onCorner: (corner: Corner) => void = () => {};
  onPick: (pick: string) => void = () => {};
  onMeasured: (text: string) => void = () => {};
  onPlaced: () => void = () => {};
  onMapTrouble: () => void = () => {};
  onGround: (text: string) => void = () => {};
  hasGround = false; // land is known

  constructor(
    private link: Link,
    private element: HTMLElement,
  ) {
    this.land = new VectorLayer({ source: new VectorSource(), declutter: false });
    this.map = new OlMap({
      target: element,
      layers: [this.land, new VectorLayer({ source: this.still, declutter: LABELS }), new VectorLayer({ source: this.moving, declutter: LABELS, updateWhileInteracting: true, updateWhileAnimating: true }), new VectorLayer({ source: this.measured })],
      controls: [this.scale, new Attribution({ collapsible: false, tipLabel: "" })],
      interactions: defaultInteractions({ altShiftDragRotate: false, pinchRotate: false, doubleClickZoom: false }).extend([this.doubleClick]),
      view: new View({ center: fromLonLat([15, 50]), zoom: 4, maxZoom: 24, enableRotation: false }),
    });
    this.userLayers = new UserMapLayers(this.map, () => this.onMapTrouble());
    this.accuracy = new AccuracyLayer(this.map);
    this.map.on("moveend", () => this.settled());
    // What is on the screen now, for whoever measures.
    this.map.on("postrender", () => (element.dataset.newestUs = String(this.newest_us)));
    this.map.on("pointerdrag", () => (this.hasMoved = true));
    this.map.on("pointermove", (event) => {
      if (event.dragging || !this.hasGround) return;
      const [longitude, latitude] = toLonLat(event.coordinate);
      this.probe.at(latitude, longitude);
    });
    element.addEventListener("pointerleave", () => this.probe.leave());
    element.addEventListener("wheel", () => (this.hasMoved = true), { passive: true });
    this.map.on("click", (event) => {
      if (this.draft) this.addCorner(event.coordinate);
      else if (this.options.measuring) void this.measure(event.coordinate);
      else if (this.options.placing) this.place(event.coordinate);
      else this.pick(event.pixel);
    });
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

  // Drawn with Shift: it is not zoomed to when it is let go.
  cancelBox() {
    for (const one of this.map.getInteractions().getArray()) {
      if (!(one instanceof DragZoom)) continue;
      one.setActive(false);
      one.setActive(true);
    }
  }

  restyle() {
    const c = (this.colours = readColours());
    this.heightColours = heightColours();
    this.land.setStyle(new Style({ fill: new Fill({ color: c.land }), stroke: new Stroke({ color: c.rule, width: 1 }) }));
    const visible = this.graticule?.getVisible() ?? true;
    if (this.graticule) this.map.removeLayer(this.graticule);
    const text = () => new Text({ font: SMALL_FONT, fill: new Fill({ color: c["rule-text"] }), stroke: new Stroke({ color: c.halo, width: 3 }) });
    this.graticule = new Graticule({ visible, strokeStyle: new Stroke({ color: c.rule, width: 1 }), showLabels: true, wrapX: false, maxLines: 40, targetSize: 160, lonLabelStyle: text(), latLabelStyle: text() });
    this.map.getLayers().insertAt(1, this.graticule);
    this.drawStill();
    this.draw();
  }

  private pick(pixel: number[]) {
    const picks: string[] = [];
    this.map.forEachFeatureAtPixel(pixel, (feature) => void (feature.get("pick") && picks.push(feature.get("pick"))), { hitTolerance: 8 });
    const best = picks.find((one) => one.startsWith("target:")) ?? picks.find((one) => !one.startsWith("sight:")) ?? picks[0];
    if (best) this.onPick(best);
  }

  private place(at: Coordinate) {
    const [longitude, latitude] = toLonLat(at);
    this.onPick(`place:${latitude.toFixed(7)},${longitude.toFixed(7)}`);
    this.onPlaced();
  }

  private addCorner(at: Coordinate) {
    const [longitude, latitude] = toLonLat(at);
    this.onCorner([Number(longitude.toFixed(6)), Number(latitude.toFixed(6))]);
  }

  private placeShapes(): Feature[] {
    const place = placeOf(this.selected);
    if (!place) return [];
    const cross = new RegularShape({ points: 4, radius: 12, radius2: 0, stroke: new Stroke({ color: this.colours.accent, width: 2 }) });
    return [shape(new Point(fromLonLat([place.longitude_deg, place.latitude_deg])), new Style({ image: cross }))];
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
    if (extent && !intersects(extent, shownExtent(this.map))) this.map.getView().fit(extent, { padding: [40, 40, 40, 40] });
    return shown;
  }

  private async settled() {
    const isNewest = this.grids.ask();
    this.drawStill();
    this.draw(); // what is drawn at the size of the view
    if (this.accuracyShown && this.accuracyShown.plan === undefined) void this.accuracy.show(this.accuracyShown);
    const box = transformExtent(shownExtent(this.map), "EPSG:3857", "EPSG:4326");
    const isSmall = box[2] - box[0] < 3 && box[3] - box[1] < 3;
    this.graticule?.setVisible(!isSmall || !this.options.grid);
    const response = isSmall && this.options.grid ? await fetch(`/api/grid?box=${box.map((v) => v.toFixed(7)).join()}`).catch(() => null) : null;
    const grid = response?.ok ? await response.json() : null;
    if (!isNewest()) return;
    this.grid = grid;
    this.drawStill();
  }

  // In the units that were chosen.
  remeasure() {
    this.scale.setUnits(measures.units === "nautical" ? "nautical" : "metric");
    this.drawStill();
  }

  drawStill() {
    this.still.clear(true);
    if (this.options.grid) this.still.addFeatures(gridShapes(this.grid, this.colours, this.hasRoom));
    if (this.options.rings) this.still.addFeatures(ringShapes(this.link, this.colours, this.view_m(), this.hasRoom));
  }

  setOption(name: keyof SiteMap["options"], value: boolean) {
    this.options[name] = value;
    if (name === "measuring") {
      if (!value) this.endMeasuring();
      this.doubleClick.setActive(!value); // two points in quick succession are two points
    }
    void this.settled();
    this.draw();
  }

  // On the screen with the page's next frame.
  drawNow() {
    this.draw();
    this.map.renderSync();
  }

  private hasRoom: HasRoom = (at, text, dx, dy) => {
    const pixel = this.map.getPixelFromCoordinate(at);
    if (!pixel) return true;
    this.pen.font = SMALL_FONT;
    const box: Box = [pixel[0] + dx, pixel[1] + dy - 8, this.pen.measureText(text).width, 16];
    return !this.over.some((other) => meet(box, other));
  };

  // The middle of what is looked at is the middle of what the panel leaves free; a target that is selected is not
  // below its own panel.
  private makeRoom() {
    const over = [...boxesOver(this.element), ...beyond(this.element.clientWidth, this.element.clientHeight)];
    if (String(over) === String(this.over)) return;
    this.over = over;
    const taken = takenByPanel(this.element);
    const view = this.map.getView();
    if (taken !== (view.padding?.[1] ?? 0)) {
      view.padding = [0, taken, 0, 0]; // what is shown stays where it is
      const one = this.link.site.targets.get(this.selected.replace("target:", ""));
      const at = taken && one?.latitude_deg != null && fromLonLat([one.longitude_deg, one.latitude_deg]);
      const pixel = at && this.map.getPixelFromCoordinate(at);
      if (pixel && pixel[0] > this.map.getSize()![0] - taken - 20) view.setCenter([at[0], view.getCenter()![1]]);
    }
    this.drawStill();
  }

  // What moves has its name on the side where there is room; what is selected, and targets, choose first.
  private placeNames() {
    const { site } = this.link;
    const names: Named[] = [];
    const add = (id: string, words: string, longitude?: number | null, latitude?: number | null) => {
      const at = longitude != null && latitude != null && this.map.getPixelFromCoordinate(fromLonLat([longitude, latitude]));
      if (at) names.push({ id, at: at as [number, number], width: this.pen.measureText(words).width });
    };
    this.pen.font = FONT;
    for (const one of site.targets.values()) add(`target:${one.id}`, targetWords(one, this.link.now_us()), one.longitude_deg, one.latitude_deg);
    for (const one of site.stations.values()) add(`station:${one.id}`, stationWords(one, this.link.now_us()), one.longitude_deg, one.latitude_deg);
    for (const one of cuesOnMap(site.fusion)) add(`cue:${one.id}`, cueWords(one), one.longitude_deg, one.latitude_deg);
    names.sort((a, b) => Number(b.id === this.selected) - Number(a.id === this.selected));
    this.sides = sidesOf(names, this.sides, this.over);
  }

  draw() {
    const { site } = this.link;
    const now_us = this.link.now_us();
    this.makeRoom();
    this.placeNames();
    const features: Feature[] = [];
    const border_m = this.options.limits ? BORDER_PART * this.view_m() : null;
    for (const s of site.stations.values()) features.push(...stationShapes(s, this.colours, this.selected === `station:${s.id}`, this.options.views, border_m, now_us, this.sides.get(`station:${s.id}`)));
    features.push(...lineShapes(this.link, this.colours));
    features.push(...cueShapes(this.link, this.colours, this.sides));
    features.push(...this.placeShapes());
    features.push(...areaShapes(site, this.colours), ...draftShapes(this.draft ?? [], this.colours));
    const targets = [...site.targets.values()];
    if (this.options.trails) features.push(...trailShapes(targets, this.heightColours, this.selected));
    for (const target of targets) features.push(...targetShapes(target, this.colours, this.selected === `target:${target.id}`, now_us, this.sides.get(`target:${target.id}`)));
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
    const target = this.options.follow ? followed(this.link.site, this.selected) : undefined;
    if (target?.latitude_deg != null) this.map.getView().setCenter(fromLonLat([target.longitude_deg, target.latitude_deg]));
  }
}
