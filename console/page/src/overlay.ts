// What is drawn over a station's picture: the tracker's box, and what has a known place.

import type { Picture } from "./link";
import { axisMark, bordersOf, horizonOf, marksOf, type Mark, type PictureLine } from "./marks";
import type { Region } from "./region";
import type { Site } from "./site";
import type { Skylines } from "./skyline";

export type Box = [number, number, number, number]; // x, y, width, height in the full frame [px]

function colour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

function drawCorners(g: CanvasRenderingContext2D, [x, y, w, h]: Box, unit: number, stroke: string) {
  const arm = Math.max(6 * unit, Math.min(w, h) * 0.28);
  const pad = 3 * unit;
  const [l, r, o, u] = [x - pad, x + w + pad, y - pad, y + h + pad];
  g.beginPath();
  for (const [cx, cy, dx, dy] of [[l, o, 1, 1], [r, o, -1, 1], [l, u, 1, -1], [r, u, -1, -1]]) {
    g.moveTo(cx + dx * arm, cy);
    g.lineTo(cx, cy);
    g.lineTo(cx, cy + dy * arm);
  }
  g.lineWidth = 4 * unit;
  g.strokeStyle = "rgba(0,0,0,.55)";
  g.stroke();
  g.lineWidth = 2 * unit;
  g.strokeStyle = stroke;
  g.stroke();
}

function drawCross(g: CanvasRenderingContext2D, [x, y]: [number, number], unit: number) {
  const [inner, outer] = [6 * unit, 15 * unit];
  g.beginPath();
  for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
    g.moveTo(x + dx * inner, y + dy * inner);
    g.lineTo(x + dx * outer, y + dy * outer);
  }
  g.lineWidth = 1.5 * unit;
  g.strokeStyle = "rgba(255,255,255,.55)";
  g.stroke();
}

function drawText(g: CanvasRenderingContext2D, text: string, x: number, y: number, unit: number) {
  g.font = `${12 * unit}px sans-serif`;
  g.lineWidth = 3 * unit;
  g.strokeStyle = "rgba(0,0,0,.7)";
  g.strokeText(text, x, y);
  g.fillStyle = "#fff";
  g.fillText(text, x, y);
}

// Of the tracker in this very frame, below its box.
function drawBelief(g: CanvasRenderingContext2D, [x, y, , h]: Box, belief: number, unit: number) {
  drawText(g, `${Math.round(100 * belief)} %`, x, y + h + 18 * unit, unit);
}

function drawMark(g: CanvasRenderingContext2D, { kind, name, at: [x, y] }: Mark, unit: number) {
  const r = (kind === "target" ? 9 : 6) * unit;
  g.beginPath();
  if (kind === "target") {
    for (const [dx, dy] of [[0, -1], [1, 0], [0, 1], [-1, 0]]) g.lineTo(x + dx * r, y + dy * r);
    g.closePath();
  } else {
    g.rect(x - r, y - r, 2 * r, 2 * r);
  }
  g.lineWidth = 3.5 * unit;
  g.strokeStyle = "rgba(0,0,0,.55)";
  g.stroke();
  g.lineWidth = 1.5 * unit;
  g.strokeStyle = colour(kind === "target" ? "--mark-target" : "--mark-station");
  g.stroke();
  drawText(g, name, x + 1.3 * r, y - 0.6 * r, unit);
}

const LINES: Record<PictureLine["kind"], { colour: string; dash: number[] }> = {
  "keep-out": { colour: "--mark-keep-out", dash: [10, 5] },
  travel: { colour: "--mark-travel", dash: [3, 6] },
  horizon: { colour: "--mark-horizon", dash: [] },
  skyline: { colour: "--mark-skyline", dash: [] },
  differing: { colour: "--mark-differing", dash: [] },
};

function drawLine(g: CanvasRenderingContext2D, { kind, points }: PictureLine, unit: number) {
  g.save();
  g.beginPath();
  for (const [x, y] of points) g.lineTo(x, y);
  if (kind === "skyline" || kind === "differing") {
    // Between a bright sky and a dark land neither colour would be seen everywhere.
    g.lineWidth = 3 * unit;
    g.strokeStyle = "rgba(0,0,0,.45)";
    g.stroke();
  }
  g.lineWidth = (kind === "differing" || LINES[kind].dash.length ? 2 : 1) * unit;
  g.strokeStyle = colour(LINES[kind].colour);
  g.setLineDash(LINES[kind].dash.map((part) => part * unit));
  g.stroke();
  g.restore();
}

function linesOf(site: Site, picture: Picture, skylines: Skylines | null): PictureLine[] {
  const horizon = horizonOf(site, picture);
  const skyline = skylines?.linesIn(picture).map((points): PictureLine => ({ kind: "skyline", points })) ?? [];
  const differing = skylines?.differingIn(picture).map((points): PictureLine => ({ kind: "differing", points })) ?? [];
  return [...bordersOf(site, picture), ...(horizon ? [horizon] : []), ...skyline, ...differing];
}

// Picture and overlay in one call, from one message: they always belong together. Everything in the
// coordinates of the full frame; `drawn`: the box that a person draws.
export function drawPicture(canvas: HTMLCanvasElement, site: Site, picture: Picture, region: Region | null, drawn: Box | null, isTracking: boolean, skylines: Skylines | null) {
  if (!picture.image.width) return; // replaced, and freed: the next one is about to be drawn
  const [width, height] = picture.full_px;
  const across = Math.min(1600, Math.max(320, Math.round(canvas.clientWidth * devicePixelRatio)));
  canvas.width = across;
  canvas.height = Math.round((across * height) / width);
  const g = canvas.getContext("2d")!;
  const [left, top, wide] = region ?? [0, 0, width];
  const scale = across / wide;
  g.setTransform(scale, 0, 0, scale, -left * scale, -top * scale);
  g.drawImage(picture.image, 0, 0, width, height);
  const unit = devicePixelRatio / scale;
  drawCross(g, axisMark(site, picture).at, unit);
  for (const line of linesOf(site, picture, skylines)) drawLine(g, line, unit);
  for (const mark of marksOf(site, picture)) drawMark(g, mark, unit);
  if (picture.box_px) {
    drawCorners(g, picture.box_px, unit, colour(isTracking ? "--tracking" : "--warn"));
    if (picture.belief != null) drawBelief(g, picture.box_px, picture.belief, unit);
  }
  if (!drawn) return;
  g.lineWidth = 2 * unit;
  g.strokeStyle = colour("--accent");
  g.setLineDash([6 * unit, 4 * unit]);
  g.strokeRect(...drawn);
}
