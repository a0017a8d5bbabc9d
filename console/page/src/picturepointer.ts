// The pointer on a station's picture: a drag draws a box, a press that is held is a joystick, a click
// points, a wheel and two fingers zoom.

import { useEffect, useRef } from "preact/hooks";
import type { OnPicture } from "./onpicture";
import { Pinch, Press } from "./pointer";

// By the lens, where there is one and this person may; else of the picture that is there.
function magnify({ shown, mayCommand, hand, part }: OnPicture, event: MouseEvent, factor: number) {
  if (!shown || (mayCommand && hand.zoomBy(Math.log(factor) / 4))) return;
  part.magnify(shown, part.place(event), factor);
}

// The canvas's handlers of events.
export function usePointer(on: OnPicture) {
  const { canvas, picture, hand, drawn, part } = on;
  const pressed = useRef<Press | null>(null);
  const pinch = useRef(new Pinch());
  const letGo = () => {
    pressed.current = null;
    hand.release();
    drawn.send(null);
  };
  useEffect(() => () => letGo(), []);
  // A press on a small picture makes it large, and no more: a drag would begin in one layout and end in
  // another, with a box that nobody has drawn.
  const onPointerDown = (event: PointerEvent) => {
    if (!on.large) return on.onSelect();
    if (!picture || event.button !== 0) return;
    canvas.current!.setPointerCapture(event.pointerId);
    pinch.current.down(event);
    if (pinch.current.isTwo) return letGo();
    if (!on.mayCommand) return;
    hand.press();
    drawn.begin(picture, part.place(event));
    pressed.current = new Press(event);
  };
  const onPointerMove = (event: PointerEvent) => {
    if (pinch.current.isTwo) return magnify(on, event, pinch.current.move(event));
    const press = pressed.current;
    if (press?.becomesJoystick(event)) drawn.send(null);
    if (press?.isJoystick) {
      const full = canvas.current!.clientWidth / 3;
      const [right, down] = press.way(event);
      return hand.push(right / full, -down / full);
    }
    if (drawn.held.current && drawn.box) drawn.dragTo(part.place(event));
  };
  const onPointerUp = (event: PointerEvent) => {
    const press = pressed.current;
    pinch.current.up(event);
    pressed.current = null;
    if (press?.isJoystick) return hand.release();
    const held = drawn.held.current;
    if (!held) return;
    const isClick = press?.isClick(event) ?? false;
    drawn.send(drawn.isLaidOutAsBegun() && !isClick ? drawn.box : null);
    if (isClick) on.pointAt(held.picture, held.from, event.shiftKey);
  };
  const onPointerCancel = (event: PointerEvent) => {
    pinch.current.up(event);
    letGo();
  };
  const onWheel = (event: WheelEvent) => {
    if (!on.large) return;
    event.preventDefault();
    magnify(on, event, Math.exp(-event.deltaY / 400));
  };
  return { onPointerDown, onPointerMove, onPointerUp, onPointerCancel, onWheel };
}
