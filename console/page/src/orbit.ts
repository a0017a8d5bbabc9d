// Where the site is looked at from, in three dimensions, and how a person turns about it.

import { useRef, useState } from "preact/hooks";
import { roundStep } from "./measures";
import { Pinch, STILL_PX } from "./pointer";
import type { Eye, Vector, View } from "./scene3d";

type Turn = (azimuth: number, elevation: number, away?: number) => void;

const KEYS: Record<string, Parameters<Turn>> = { ArrowLeft: [0.1, 0], ArrowRight: [-0.1, 0], ArrowUp: [0, 0.08], ArrowDown: [0, -0.08], "+": [0, 0, 0.8], "-": [0, 0, 1.25] };

// `shown`: as it was drawn last.
export function useOrbit() {
  const [eye, setEye] = useState<Eye | null>(null); // null: as far as all of the site needs
  const shown = useRef<Eye>({ azimuth: 0.5, elevation: 0.45, away_m: 1000, at: [0, 0, 0] });
  // `whole`: what all of the site needs; `middle`: what is to stay in the middle.
  const look = (whole: View, middle: Vector | null | undefined) => {
    shown.current = eye ?? { ...shown.current, ...whole };
    if (middle) shown.current = { ...shown.current, at: middle };
  };
  const turn: Turn = (azimuth, elevation, away = 1) => {
    const now = shown.current;
    const steep = Math.max(-0.1, Math.min(1.55, now.elevation + elevation));
    setEye({ ...now, azimuth: now.azimuth + azimuth, elevation: steep, away_m: Math.max(20, Math.min(1e6, now.away_m * away)) });
  };
  const step_m = () => roundStep(shown.current.away_m / 12);
  return { eye, shown, look, turn, step_m, fit: () => setEye(null) };
}

type Press = { at: [number, number]; from: [number, number]; isDrag: boolean };

// The canvas's handlers of events.
export function useTurning(turn: Turn, onClick: (event: PointerEvent) => void) {
  const press = useRef<Press | null>(null);
  const pinch = useRef(new Pinch());
  const onPointerDown = (event: PointerEvent) => {
    const from: [number, number] = [event.clientX, event.clientY];
    press.current = { at: from, from, isDrag: false };
    pinch.current.down(event);
    if (pinch.current.isTwo) press.current.isDrag = true;
    (event.currentTarget as Element).setPointerCapture(event.pointerId);
  };
  const onPointerMove = (event: PointerEvent) => {
    if (pinch.current.isTwo) return turn(0, 0, 1 / pinch.current.move(event));
    const now = press.current;
    if (!now) return;
    const [x, y] = [event.clientX, event.clientY];
    now.isDrag ||= Math.hypot(x - now.from[0], y - now.from[1]) > STILL_PX;
    if (!now.isDrag) return;
    turn((now.at[0] - x) * -0.006, (y - now.at[1]) * 0.005);
    now.at = [x, y];
  };
  const onPointerUp = (event: PointerEvent) => {
    pinch.current.up(event);
    const isClick = event.type === "pointerup" && press.current && !press.current.isDrag && event.button === 0;
    press.current = null;
    if (isClick) onClick(event);
  };
  const onWheel = (event: WheelEvent) => {
    event.preventDefault();
    turn(0, 0, Math.exp(event.deltaY * 0.001));
  };
  const onKeyDown = (event: KeyboardEvent) => {
    if (!KEYS[event.key]) return;
    event.preventDefault();
    turn(...KEYS[event.key]);
  };
  return { onKeyDown, onPointerDown, onPointerMove, onPointerUp, onPointerCancel: onPointerUp, onWheel };
}
