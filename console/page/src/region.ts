// The part of a picture that is shown, where the lens does not zoom.

import type { RefObject } from "preact";
import { useState } from "preact/hooks";
import type { Picture } from "./link";

export type Region = [number, number, number, number]; // x, y, width, height in the full frame [px]

const LARGEST_ZOOM = 16;

// The part of the frame that is shown, `factor` times larger (or smaller) about a point; null: all of it.
function magnified(region: Region | null, full: [number, number], at: [number, number], factor: number): Region | null {
  const [x, y, width, height] = region ?? [0, 0, full[0], full[1]];
  const wide = Math.max(full[0] / LARGEST_ZOOM, width / factor);
  if (wide >= full[0]) return null;
  const by = wide / width;
  const within = (value: number, most: number) => Math.max(0, Math.min(most, value));
  const high = height * by;
  return [within(at[0] - (at[0] - x) * by, full[0] - wide), within(at[1] - (at[1] - y) * by, full[1] - high), wide, high];
}

// Of the picture that is shown on this canvas.
export function useRegion(canvas: RefObject<HTMLCanvasElement>, shown: Picture | undefined) {
  const [region, setRegion] = useState<Region | null>(null); // null: all of it
  const magnify = (on: Picture, at: [number, number], factor: number) => setRegion(magnified(region, on.full_px, at, factor));
  // Where an event is in the full frame.
  const place = (event: MouseEvent): [number, number] => {
    const rect = canvas.current!.getBoundingClientRect();
    const [width, height] = shown!.full_px;
    const clamp = (value: number, most: number) => Math.max(0, Math.min(most, value));
    const [left, top, wide, high] = region ?? [0, 0, width, height];
    return [clamp(left + ((event.clientX - rect.left) / rect.width) * wide, width), clamp(top + ((event.clientY - rect.top) / rect.height) * high, height)];
  };
  return { region, magnify, place };
}
