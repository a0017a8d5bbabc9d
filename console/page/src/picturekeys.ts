// The keyboard on a station's picture: arrows steer, M takes a station that tracks in hand, plus and
// minus zoom; Enter begins and ends a box, which the arrows move.

import type { Picture } from "./link";
import type { OnPicture } from "./onpicture";

type Steps = Record<string, [number, number]>;

const PUSHES: Steps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }; // to the right, upwards
const STEPS: Steps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }; // in the picture

function drive({ hand }: OnPicture, event: KeyboardEvent, how: () => void) {
  if (event.repeat) return; // it is held, not pressed
  hand.press();
  how();
}

// The keys of one kind; false: it is none of them.
function zoomBy(on: OnPicture, picture: Picture, event: KeyboardEvent): boolean {
  const towards = { "+": 1, "=": 1, "-": -1 }[event.key];
  if (!towards) return false;
  const [width, height] = picture.full_px;
  if (on.mayCommand && on.station.lens?.zoom != null) drive(on, event, () => on.hand.zoom(towards));
  else on.part.magnify(picture, [width / 2, height / 2], towards > 0 ? 1.3 : 1 / 1.3);
  return true;
}

function steerBy(on: OnPicture, picture: Picture, event: KeyboardEvent): boolean {
  const push = PUSHES[event.key];
  const slow = event.shiftKey ? 0.4 : 0.8;
  if (push) drive(on, event, () => on.hand.push(push[0] * slow, push[1] * slow));
  else if (event.key === "l" || event.key === "L") on.lookAtMiddle(picture);
  else if (event.key === "m" || event.key === "M") on.setByHand(!on.byHand);
  else return false;
  return true;
}

function beginOrSend({ drawn }: OnPicture, picture: Picture) {
  if (drawn.box) return drawn.send(drawn.box);
  const [width, height] = picture.full_px;
  drawn.setBox([width * 0.47, height * 0.47, width * 0.06, height * 0.06]);
}

function changeBox({ drawn }: OnPicture, picture: Picture, event: KeyboardEvent) {
  if (!drawn.box) return;
  if (event.key === "Backspace" || event.key === "Delete") return drawn.send(null);
  const step = STEPS[event.key];
  if (!step) return;
  event.preventDefault();
  const by = picture.full_px[0] / 100;
  const [x, y, wide, high] = drawn.box;
  if (event.shiftKey) drawn.setBox([x, y, Math.max(by, wide + step[0] * by), Math.max(by, high + step[1] * by)]);
  else drawn.setBox([x + step[0] * by, y + step[1] * by, wide, high]);
}

export function pressKey(on: OnPicture, event: KeyboardEvent) {
  const { picture, drawn } = on;
  if (!picture) return;
  if (!drawn.box && zoomBy(on, picture, event)) return event.preventDefault();
  if (!on.mayCommand) return;
  if (event.key === "Enter") {
    event.preventDefault();
    return beginOrSend(on, picture);
  }
  if (!drawn.box && steerBy(on, picture, event)) return event.preventDefault();
  changeBox(on, picture, event);
}
