// The pointer on a picture: what a press means, which is the second of two, and by how much two
// fingers pinch.

const HOLD_MS = 500; // pressed for so long before it moves: a joystick, not a box or a click
export const STILL_PX = 6;
const SLIP_PX = 20; // between press and release

// One press, by the events' own times: a busy page delays them and does not change what the hand meant.
export class Press {
  private readonly at: [number, number];
  private readonly stamp_ms: number;
  private meant: "" | "box" | "joystick" = ""; // "": it has not moved yet

  constructor(event: PointerEvent) {
    this.at = [event.clientX, event.clientY];
    this.stamp_ms = event.timeStamp;
  }

  get isJoystick(): boolean {
    return this.meant === "joystick";
  }

  // With each move; true with the one that makes it a joystick.
  becomesJoystick(event: PointerEvent): boolean {
    if (this.meant || !this.hasMoved(event)) return false;
    this.meant = this.isLong(event) ? "joystick" : "box";
    return this.isJoystick;
  }

  hasMoved(event: PointerEvent): boolean {
    return this.meant !== "" || Math.hypot(...this.way(event)) > STILL_PX;
  }

  isClick(event: PointerEvent): boolean {
    return this.meant === "" && !this.isLong(event);
  }

  // A click during which the hand slipped looks like a small box.
  isSlip(event: PointerEvent): boolean {
    return Math.hypot(...this.way(event)) < SLIP_PX;
  }

  // To the right and down [px], since it began.
  way(event: PointerEvent): [number, number] {
    return [event.clientX - this.at[0], event.clientY - this.at[1]];
  }

  private isLong(event: PointerEvent): boolean {
    return event.timeStamp - this.stamp_ms >= HOLD_MS;
  }
}

// The second press of a double click, which lands on whatever the first click has put there.
export class DoubleClick {
  private at = { clientX: 0, clientY: 0, timeStamp: -Infinity };

  first({ clientX, clientY, timeStamp }: MouseEvent) {
    this.at = { clientX, clientY, timeStamp };
  }

  isSecond({ clientX, clientY, timeStamp }: MouseEvent): boolean {
    return timeStamp - this.at.timeStamp < HOLD_MS && Math.hypot(clientX - this.at.clientX, clientY - this.at.clientY) <= STILL_PX;
  }
}

// Two fingers: by how much their distance has grown since the last move.
export class Pinch {
  private fingers = new Map<number, [number, number]>();

  get isTwo(): boolean {
    return this.fingers.size === 2;
  }

  down(event: PointerEvent) {
    if (event.pointerType === "touch") this.fingers.set(event.pointerId, [event.clientX, event.clientY]);
  }

  up(event: PointerEvent) {
    this.fingers.delete(event.pointerId);
  }

  move(event: PointerEvent): number {
    if (!this.isTwo || !this.fingers.has(event.pointerId)) return 1;
    const before = this.apart();
    this.fingers.set(event.pointerId, [event.clientX, event.clientY]);
    return before > 0 ? this.apart() / before : 1;
  }

  private apart(): number {
    const [a, b] = [...this.fingers.values()];
    return Math.hypot(a[0] - b[0], a[1] - b[1]);
  }
}
