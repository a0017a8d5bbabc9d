// The operator's hand on a picture: a joystick while it holds, and the lens. Sends what it wants; the
// station decides.

import type { Link } from "./link";
import type { Station } from "./site";

const AGAIN_MS = 100; // two may get lost within the 0.3 s for which a station obeys one
const PICTURES_A_SECOND = 0.8; // at full deflection: slower the longer the lens
const FASTEST_DEG_S = 60;
const REFUSING = ["stopped", "emergency"]; // states in which a station obeys no rates; its lens does

// Fine in the middle, fast at the edge.
const felt = (deflection: number) => {
  const d = Math.max(-1, Math.min(1, deflection));
  return Math.sign(d) * d * d;
};

// What a station that is at work does to a hand: it withholds itself, and that is said once a push.
export type Withheld = { is: () => boolean; say: () => void };

// A press drives as long as it lasts, but not beyond a cut of the link or a stop: whatever is still held
// then needs a new press.
export class Hand {
  private timer = 0;
  private push_: [number, number] = [0, 0]; // to the right, upwards; -1..1
  private zoom_ = 0;
  private era = -1; // of the link, in which it was pressed; -1: nothing is
  private wanted: number | null = null; // of the zoom, until the lens has been told
  private tellTimer = 0;
  private isSaid = false; // that the station is withheld

  constructor(
    private link: Link,
    private station: () => Station,
    private withheld: Withheld,
  ) {}

  // A new press. What is pushed without one moves nothing.
  press() {
    this.era = this.link.isLive ? this.link.era : -1;
  }

  push(right: number, up: number) {
    const moved = this.pushes;
    const isWithheld = (right !== 0 || up !== 0) && this.withheld.is();
    if (isWithheld && !this.isSaid) this.withheld.say();
    this.isSaid ||= isWithheld;
    this.push_ = isWithheld ? [0, 0] : [felt(right), felt(up)];
    this.drive(!moved);
    if (moved && !this.pushes && this.timer) this.tellRates();
  }

  // Towards longer (1) or wider (-1).
  zoom(rate: number) {
    const zoomed = this.zoom_ !== 0;
    this.zoom_ = rate;
    this.drive(!zoomed);
    if (zoomed && !rate && this.timer) this.tellZoom();
  }

  // Whatever held it: nothing is wanted any more, and the station is told at once.
  release() {
    const [moved, zoomed] = [this.timer && this.pushes, this.timer && this.zoom_];
    this.end();
    this.isSaid = false;
    if (moved) this.tellRates();
    if (zoomed) this.tellZoom();
  }

  // By a wheel or a pinch; false: this lens does not zoom.
  zoomBy(share: number): boolean {
    const now = this.wanted ?? this.station().lens?.zoom ?? null;
    if (now === null) return false;
    this.wanted = Math.max(0, Math.min(1, now + share));
    this.tellTimer ||= window.setTimeout(() => {
      this.say("lens", { is_rate: false, zoom: this.wanted });
      this.tellTimer = 0;
      this.wanted = null;
    }, AGAIN_MS);
    return true;
  }

  private get pushes(): boolean {
    return this.push_[0] !== 0 || this.push_[1] !== 0;
  }

  // Told at once when it begins and when it ends, and every AGAIN_MS between: a hand moves oftener than
  // the console listens.
  private drive(begins: boolean) {
    if (!this.mayGoOn()) return this.release();
    if (begins) this.tell();
    this.timer ||= window.setInterval(() => this.again(), AGAIN_MS);
  }

  private end() {
    this.era = -1;
    clearInterval(this.timer);
    this.timer = 0;
    this.push_ = [0, 0];
    this.zoom_ = 0;
  }

  private mayGoOn(): boolean {
    return document.hasFocus() && this.link.isLive && this.era === this.link.era;
  }

  // What the station or the console has refused by now is not asked for again.
  private again() {
    const { state, control } = this.station();
    const isOthers = control != null && control.viewer !== this.link.viewer;
    if (isOthers || (this.pushes && (REFUSING.includes(state) || this.withheld.is()))) return this.end();
    if (!this.mayGoOn()) return this.release();
    this.tell();
  }

  private tell() {
    if (this.pushes) this.tellRates();
    if (this.zoom_) this.tellZoom();
  }

  private tellRates() {
    const { field_of_view_deg, pan_sign, tilt_sign } = this.station();
    const speed = Math.min(FASTEST_DEG_S, PICTURES_A_SECOND * (field_of_view_deg?.[0] ?? 5));
    const [right, up] = this.push_;
    // `|| 0`: no minus zero
    this.say("rate", { pan_deg_s: -(pan_sign || 1) * right * speed || 0, tilt_deg_s: (tilt_sign || 1) * up * speed || 0 });
  }

  private tellZoom() {
    this.say("lens", { is_rate: true, zoom: this.zoom_ });
  }

  private say(command: string, more: Record<string, unknown>) {
    this.link.rate({ command, station: this.station().id, ...more });
  }
}
