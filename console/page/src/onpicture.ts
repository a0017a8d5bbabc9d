// A station's picture under a person's hand: the box that is drawn on it, the part of it that is shown,
// and the commands that it offers.

import { useEffect, useRef, useState } from "preact/hooks";
import { isAtWork } from "./byhand";
import { useDrawnBox } from "./drawnbox";
import { useEscape } from "./escape";
import { Hand, type Withheld } from "./hand";
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
  onWithheld: () => void; // a hand was on a station that is at work
  onRelease: () => void;
};
// As of one rendering: what is done by a pointer or a key is done on what was rendered last.
export type OnPicture = ReturnType<typeof useOnPicture>;

const tenths = (px: number) => Math.round(px * 10) / 10;

// One for all renderings: what it holds goes on while the station's state changes.
function useHand(link: Link, station: Station, withheld: Withheld): Hand {
  const now = useRef({ station, withheld });
  now.current = { station, withheld };
  const hand = useRef<Hand>();
  hand.current ??= new Hand(link, () => now.current.station, { is: () => now.current.withheld.is(), say: () => now.current.withheld.say() });
  return hand.current;
}

// Whether a person has said that the hand may end what the station does by itself. Said anew each time
// that it does.
function useByHand(station: Station, large: boolean) {
  const [byHand, setByHand] = useState(false);
  const works = isAtWork(station);
  useEffect(() => {
    if (works || !large) setByHand(false);
  }, [works, large]);
  useEscape(byHand, () => setByHand(false));
  return { byHand, setByHand, isWithheld: works && !byHand };
}

export function useOnPicture({ link, station, picture, large, mayCommand, onSelect, onDesignate, onPoint, onWithheld, onRelease }: PictureProps) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const [looks, setLooks] = useState(false);
  const { byHand, setByHand, isWithheld } = useByHand(station, large);
  const hand = useHand(link, station, { is: () => isWithheld, say: onWithheld });
  const drawn = useDrawnBox(canvas, picture, (on, box) => onDesignate(station.id, on.utime_us, box.map(tenths) as Box));
  const shown = drawn.held.current?.picture ?? picture;
  const part = useRegion(canvas, shown);
  useEscape(looks, () => setLooks(false));
  const lookAtMiddle = (on: Picture) => {
    if (isWithheld) return onWithheld();
    onPoint(station.id, "look", on.utime_us, [on.full_px[0] / 2, on.full_px[1] / 2]);
  };
  const pointAt = (on: Picture, [x, y]: [number, number], isShift: boolean) => {
    const isLook = looks || isShift;
    if (isWithheld && !isLook) return onWithheld();
    onPoint(station.id, isLook ? "look" : "centre", on.utime_us, [tenths(x), tenths(y)]);
    setLooks(false);
  };
  return { canvas, station, picture, shown, large, mayCommand, hand, byHand, setByHand, isWithheld, drawn, part, looks, setLooks, lookAtMiddle, pointAt, onSelect, onWithheld, onRelease };
}
