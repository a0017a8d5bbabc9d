// A gamepad as the operator's hand on the large picture: the left stick turns, the triggers zoom.

import type { Hand } from "./hand";

const DEAD = 0.12; // of a stick's travel: worn ones do not rest in the middle
const WIDER = 6; // buttons of the standard layout: the triggers
const LONGER = 7;
const LOOK_MS = 50;

function beyondDead(value: number): number {
  const beyond = Math.max(0, Math.abs(value) - DEAD) / (1 - DEAD);
  return Math.sign(value) * Math.min(1, beyond);
}

// None while the page is not the one that is used.
function standardPad(): Gamepad | null {
  const pad = navigator.getGamepads().find((one) => one?.connected && one.mapping === "standard");
  return document.hasFocus() ? (pad ?? null) : null;
}

// Until the returned function is called. The pad is asked again and again: it has no events of its own.
export function steerByGamepad(hand: Hand): () => void {
  let turns = false;
  let zooms = false;
  const look = () => {
    const pad = standardPad();
    const [right, down] = pad ? [beyondDead(pad.axes[0]), beyondDead(pad.axes[1])] : [0, 0];
    const zoom = pad ? pad.buttons[LONGER].value - pad.buttons[WIDER].value : 0;
    const [turned, zoomed] = [turns, zooms];
    [turns, zooms] = [right !== 0 || down !== 0, zoom !== 0];
    if ((turned && !turns) || (zoomed && !zooms)) hand.release();
    if (turns) hand.push(right, -down);
    if (zooms) hand.zoom(zoom);
  };
  const timer = window.setInterval(look, LOOK_MS);
  return () => {
    clearInterval(timer);
    if (turns || zooms) hand.release();
  };
}
