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

function standardPad(): Gamepad | null {
  return navigator.getGamepads().find((one) => one?.connected && one.mapping === "standard") ?? null;
}

// Until the returned function is called. The pad is asked again and again: it has no events of its own.
// A push counts from where the pad was seen at rest: one that comes back deflected moves nothing.
export function steerByGamepad(hand: Hand): () => void {
  let wasAtRest = false;
  let drives = false;
  const look = () => {
    const pad = standardPad();
    const [right, down] = pad ? [beyondDead(pad.axes[0]), beyondDead(pad.axes[1])] : [0, 0];
    const zoom = pad ? pad.buttons[LONGER].value - pad.buttons[WIDER].value : 0;
    const rests = right === 0 && down === 0 && zoom === 0;
    if (rests && drives) hand.release();
    if (!rests && wasAtRest) hand.press();
    [drives, wasAtRest] = [!rests, rests && pad !== null];
    if (rests) return;
    hand.push(right, -down);
    hand.zoom(zoom);
  };
  const timer = window.setInterval(look, LOOK_MS);
  return () => {
    clearInterval(timer);
    if (drives) hand.release();
  };
}
