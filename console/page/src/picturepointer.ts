// The pointer on a station's picture: a drag draws a box, a press that is held is a joystick, a click
// points, a wheel and two fingers zoom. One finger scrolls the page, unless the station is in hand.

import { useEffect, useRef, useState } from "preact/hooks";
import { useEscape } from "./escape";
import type { OnPicture } from "./onpicture";
import { DoubleClick, Pinch, Press } from "./pointer";

// By the lens, where there is one and this person may; else of the picture that is there.
function magnify({ shown, mayCommand, hand, part }: OnPicture, event: MouseEvent, factor: number) {
  if (!shown || (mayCommand && hand.zoomBy(Math.log(factor) / 4))) return;
  part.magnify(shown, part.place(event), factor);
}

const choice = new DoubleClick(); // of the picture that is large, on whichever it was made

// The press under way, which Escape cancels as it does a box of the keyboard.
function usePress({ hand, drawn }: OnPicture) {
  const pressed = useRef<Press | null>(null);
  const [isHeld, setHeld] = useState(false);
  const take = (press: Press | null) => {
    pressed.current = press;
    setHeld(press !== null);
  };
  const letGo = () => {
    take(null);
    hand.release();
    drawn.send(null);
  };
  useEffect(() => () => letGo(), []);
  useEscape(isHeld || drawn.box !== null, letGo);
  return { pressed, take, letGo };
}

// A click points, a drag draws; on a station at work a short drag does neither.
function endDrag({ drawn, isWithheld, onWithheld, pointAt }: OnPicture, press: Press | null, event: PointerEvent) {
  const held = drawn.held.current;
  if (!held) return;
  const isClick = press?.isClick(event) ?? false;
  const isSlip = isWithheld && !isClick && (press?.isSlip(event) ?? false);
  drawn.send(drawn.isLaidOutAsBegun() && !isClick && !isSlip ? drawn.box : null);
  if (isSlip) onWithheld();
  if (isClick) pointAt(held.picture, held.from, event.shiftKey);
}

// The canvas's handlers of events.
export function usePointer(on: OnPicture) {
  const { canvas, picture, hand, drawn, part } = on;
  const { pressed, take, letGo } = usePress(on);
  const pinch = useRef(new Pinch());
  // A click on a small picture makes it large, and no more: what began in one layout would end in
  // another.
  const onClick = (event: MouseEvent) => {
    if (on.large) return;
    choice.first(event);
    on.onSelect();
  };
  const onPointerDown = (event: PointerEvent) => {
    if (!on.large || !picture || event.button !== 0 || choice.isSecond(event)) return;
    canvas.current!.setPointerCapture(event.pointerId);
    pinch.current.down(event);
    if (pinch.current.isTwo) return letGo();
    if (!on.mayCommand) return;
    hand.press();
    drawn.begin(picture, part.place(event));
    take(new Press(event));
  };
  const onPointerMove = (event: PointerEvent) => {
    if (pinch.current.isTwo) return magnify(on, event, pinch.current.move(event));
    const press = pressed.current;
    if (event.pointerType === "touch" && !on.byHand && press?.hasMoved(event)) return letGo();
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
    take(null);
    if (press?.isJoystick) return hand.release();
    endDrag(on, press, event);
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
  // The browser scrolls by two fingers as by one, unless it is told before they move.
  const onTouchStart = (event: TouchEvent) => event.touches.length > 1 && event.preventDefault();
  return { onClick, onTouchStart, onPointerDown, onPointerMove, onPointerUp, onPointerCancel, onWheel };
}
