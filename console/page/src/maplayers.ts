// Layers below the site's own: the users' maps, and how well the site can know a position.

import ImageLayer from "ol/layer/Image";
import type OlMap from "ol/Map";
import TileLayer from "ol/layer/Tile";
import ImageCanvas from "ol/source/ImageCanvas";
import XYZ from "ol/source/XYZ";
import { fromLonLat, transformExtent } from "ol/proj";
import { boundingExtent, type Extent } from "ol/extent";
import type { Coordinate } from "ol/coordinate";
import { shownExtent } from "./overlays";
import { Questions } from "./questions";

// With zoom levels it is of tiles, with heights of an accuracy that was computed ahead.
export type UserMap = { id: string; name: string; problem: string; attribution?: string; zoom?: [number, number]; bounds_deg?: [number, number, number, number]; above_m?: number[] };
export type UserMaps = { maps: UserMap[]; problem: string };

export async function userMaps(): Promise<UserMaps> {
  const response = await fetch("/api/maps").catch(() => null);
  return response?.ok ? response.json() : { maps: [], problem: "" };
}

// Of a file that anybody may have written, for a control that takes HTML: its words alone.
function wordsOf(html: string): string {
  const words = document.createElement("span");
  words.textContent = new DOMParser().parseFromString(html, "text/html").body.textContent;
  return words.innerHTML;
}

// The users' maps on the map: those that are chosen, by their ids.
export class UserMapLayers {
  private layers = new Map<string, TileLayer<XYZ>>();

  constructor(
    private map: OlMap,
    private onTrouble: () => void,
  ) {}

  show(chosen: UserMap[]) {
    const ids = new Set(chosen.map((one) => one.id));
    for (const [id, layer] of this.layers) {
      if (ids.has(id)) continue;
      this.map.removeLayer(layer);
      this.layers.delete(id);
    }
    for (const one of chosen) {
      if (!this.layers.has(one.id) && one.zoom) this.add(one);
    }
  }

  private add(one: UserMap) {
    const [minZoom, maxZoom] = one.zoom!;
    const source = new XYZ({ url: `/api/maps/${encodeURIComponent(one.id)}/{z}/{x}/{y}`, minZoom, maxZoom, attributions: one.attribution && wordsOf(one.attribution) });
    source.on("tileloaderror", () => this.onTrouble());
    const layer = new TileLayer({ source, extent: transformExtent(one.bounds_deg!, "EPSG:4326", "EPSG:3857") });
    this.layers.set(one.id, layer);
    // Above the land, below everything else.
    this.map.getLayers().insertAt(Math.min(this.layers.size, this.map.getLayers().getLength()), layer);
  }
}

// Of the site as it is, or of a plan among the users' maps, at a height above the stations.
export type AccuracyChoice = { above_m: number; plan?: string };
type Cell = number[]; // deviation [m], then longitude and latitude of its corners
type Plan = { heights: { above_m: number; cells: Cell[] }[] };

type Accuracy = { height_m: number; columns: number; rows: number; sd_m: (number | null)[] };

// Deviations and their colours, from good to bad; beyond the last: no colour.
export const ACCURACY_STEPS: [number, string][] = [
  [0.1, "#1a9850"],
  [0.3, "#91cf60"],
  [1, "#d9ef8b"],
  [3, "#fee08b"],
  [10, "#fc8d59"],
  [30, "#d73027"],
];

function colourOf(sd_m: number | null): string | undefined {
  return sd_m === null ? undefined : ACCURACY_STEPS.find(([most]) => sd_m <= most)?.[1];
}

export class AccuracyLayer {
  private readonly canvas = document.createElement("canvas");
  private extent: Extent | null = null; // of what is on the canvas; null: nothing
  private plans = new Map<string, Plan>(); // those that were looked at
  private questions = new Questions();
  private cells: { path: Coordinate[]; colour: string }[] = []; // of the plan that is shown
  private readonly source = new ImageCanvas({
    ratio: 1,
    canvasFunction: (extent, _resolution, _pixelRatio, size) => this.draw(extent, size),
  });
  private readonly layer = new ImageLayer({ source: this.source, opacity: 0.45, visible: false });

  constructor(private map: OlMap) {
    map.getLayers().insertAt(1, this.layer);
  }

  // Null: none. That of the site as it is covers the map's present view; a plan has its own extent,
  // to which this returns true if it could be shown.
  async show(choice: AccuracyChoice | null): Promise<boolean> {
    const isNewest = this.questions.ask();
    this.layer.setVisible(choice !== null);
    this.cells = [];
    this.extent = null;
    const shown = choice === null || (choice.plan === undefined ? await this.showSite(choice.above_m, isNewest) : await this.showPlan(choice.plan, choice.above_m, isNewest));
    this.source.changed();
    return shown;
  }

  // Of the plan that is shown.
  planExtent(): Extent | null {
    return this.cells.length ? boundingExtent(this.cells.flatMap((cell) => cell.path)) : null;
  }

  private async showSite(above_m: number, isNewest: () => boolean): Promise<boolean> {
    const extent = shownExtent(this.map);
    const box = transformExtent(extent, "EPSG:3857", "EPSG:4326").map((v) => v.toFixed(6));
    const response = await fetch(`/api/accuracy?box=${box.join()}&above=${above_m}`).catch(() => null);
    const accuracy = response?.ok ? await response.json() : null;
    if (!isNewest()) return true; // it is the newer one's to say what is wrong
    if (!accuracy) return false;
    this.extent = extent;
    this.paint(accuracy);
    return true;
  }

  private async showPlan(id: string, above_m: number, isNewest: () => boolean): Promise<boolean> {
    if (!this.plans.has(id)) {
      const response = await fetch(`/api/maps/${encodeURIComponent(id)}/accuracy`).catch(() => null);
      if (!response?.ok) return !isNewest();
      this.plans.set(id, await response.json());
    }
    if (!isNewest()) return true;
    const cells = this.plans.get(id)!.heights.find((height) => height.above_m === above_m)?.cells ?? [];
    this.cells = cells.flatMap(([sd_m, ...corners]) => {
      const colour = colourOf(sd_m);
      const path: Coordinate[] = [];
      for (let i = 0; i + 1 < corners.length; i += 2) path.push(fromLonLat([corners[i], corners[i + 1]]));
      return colour ? [{ path, colour }] : [];
    });
    return cells.length > 0;
  }

  private paint({ columns, rows, sd_m }: Accuracy) {
    [this.canvas.width, this.canvas.height] = [columns, rows];
    const g = this.canvas.getContext("2d")!;
    g.clearRect(0, 0, columns, rows);
    sd_m.forEach((sd, i) => {
      const colour = colourOf(sd);
      if (!colour) return;
      g.fillStyle = colour;
      g.fillRect(i % columns, Math.floor(i / columns), 1, 1);
    });
  }

  private draw(extent: Extent, size: number[]): HTMLCanvasElement {
    const shown = document.createElement("canvas");
    [shown.width, shown.height] = [Math.round(size[0]), Math.round(size[1])];
    const scale = size[0] / (extent[2] - extent[0]);
    const g = shown.getContext("2d")!;
    if (this.extent) {
      const [w, s, e, n] = this.extent;
      g.imageSmoothingEnabled = false; // cells are what was computed
      g.drawImage(this.canvas, (w - extent[0]) * scale, (extent[3] - n) * scale, (e - w) * scale, (n - s) * scale);
    }
    for (const { path, colour } of this.cells) {
      g.beginPath();
      for (const [x, y] of path) g.lineTo((x - extent[0]) * scale, (extent[3] - y) * scale);
      g.closePath();
      g.fillStyle = g.strokeStyle = colour; // with its outline, or the ground shows between cells
      g.fill();
      g.stroke();
    }
    return shown;
  }
}
