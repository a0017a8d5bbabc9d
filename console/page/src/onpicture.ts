// A station's picture under a person's hand: the box that is drawn on it, the part of it that is shown,
// and the commands that it offers.

import { useRef, useState } from "preact/hooks";
import { useDrawnBox } from "./drawnbox";
import { Hand } from "./hand";
import type { Link, Picture } from "./link";
import type { Box } from "./overlay";
import { useRegion } from "./region";
import type { Station } from "./site";

export type Designate = (station: string, frame_utime_us: number, box: Box) => void;
export type Point = (station: string, command: "centre" | "look", frame_utime_us: number, point: [number, number]) => void;
export type PictureProps = {
  link: Link;
  station: Station;
  picture: Picture | undefined; // the newest
  large: boolean;
  mayCommand: boolean;
  onSelect: () => void;
  onDesignate: Designate;
  onPoint: Point;
};
// As of one rendering: what is done by a pointer or a key is done on what was rendered last.
export type OnPicture = ReturnType<typeof useOnPicture>;

const tenths = (px: number) => Math.round(px * 10) / 10;

// One for all renderings: what it holds goes on while the station's state changes.
function useHand(link: Link, station: Station): Hand {
  const now = useRef(station);
  now.current = station;
  const hand = useRef<Hand>();
  hand.current ??= new Hand(link, () => now.current);
  return hand.current;
}

export function useOnPicture({ link, station, picture, large, mayCommand, onSelect, onDesignate, onPoint }: PictureProps) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const [looks, setLooks] = useState(false);
  const hand = useHand(link, station);
  const drawn = useDrawnBox(canvas, picture, (on, box) => onDesignate(station.id, on.utime_us, box.map(tenths) as Box));
  const shown = drawn.held.current?.picture ?? picture;
  const part = useRegion(canvas, shown);
  const lookAtMiddle = (on: Picture) => onPoint(station.id, "look", on.utime_us, [on.full_px[0] / 2, on.full_px[1] / 2]);
  const pointAt = (on: Picture, [x, y]: [number, number], isLook: boolean) => {
    onPoint(station.id, looks || isLook ? "look" : "centre", on.utime_us, [tenths(x), tenths(y)]);
    setLooks(false);
  };
  return { canvas, station, picture, shown, large, mayCommand, hand, drawn, part, looks, setLooks, lookAtMiddle, pointAt, onSelect };
}
