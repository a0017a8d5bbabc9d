// The box that a person draws on a picture. It belongs to the picture that it was dragged on, whose
// pixels stay until it is done.

import type { RefObject } from "preact";
import { useRef, useState } from "preact/hooks";
import type { Picture } from "./link";
import type { Box } from "./overlay";
import { drawnOn } from "./pictures";

const LEAST_DRAG_PX = 4;

// Under a drag: where it began, and the size of the canvas then.
type Held = { picture: Picture; from: [number, number]; size: string };

// `picture`: the newest. What is held is of this instant, the box of the last rendering.
export function useDrawnBox(canvas: RefObject<HTMLCanvasElement>, picture: Picture | undefined, onDrawn: (on: Picture, box: Box) => void) {
  const held = useRef<Held | null>(null);
  const [box, setBox] = useState<Box | null>(null);
  const size = () => [canvas.current!.clientWidth, canvas.current!.clientHeight].join();
  const hold = (what: Held | null) => {
    const before = held.current?.picture;
    held.current = what;
    if (what) drawnOn.add(what.picture);
    if (!before || before === what?.picture) return;
    drawnOn.delete(before);
    if (before !== picture) before.image.close(); // it was replaced meanwhile
  };
  // A box of the keyboard lies on the live picture: who moves it there takes longer than a picture lasts.
  const send = (wanted: Box | null) => {
    const on = held.current?.picture ?? picture;
    hold(null);
    setBox(null);
    if (!on || !wanted || wanted[2] < LEAST_DRAG_PX || wanted[3] < LEAST_DRAG_PX) return;
    onDrawn(on, wanted);
  };
  const begin = (on: Picture, from: [number, number]) => {
    hold({ picture: on, from, size: size() });
    setBox([...from, 0, 0]);
  };
  const isLaidOutAsBegun = () => size() === held.current?.size;
  const dragTo = ([x, y]: [number, number]) => {
    if (!isLaidOutAsBegun()) return send(null); // the layout has changed under the hand
    const [x0, y0] = held.current!.from;
    setBox([Math.min(x0, x), Math.min(y0, y), Math.abs(x - x0), Math.abs(y - y0)]);
  };
  return { held, box, setBox, begin, dragTo, send, isLaidOutAsBegun };
}
