// The connection to the server: state in, commands out, pictures. Reconnects by itself.

import type { Camera } from "./projection";
import type { ReplayState } from "./replay";
import { apply, emptySite, Site } from "./site";

export type Picture = {
  station: string;
  utime_us: number;
  full_px: [number, number];
  box_px: [number, number, number, number] | null; // in the full frame
  belief?: number | null; // of the tracker in this frame
  camera?: Camera | null; // where it was and looked; null while that is unknown, missing in a preview
  image: ImageBitmap;
};

// Where pictures come from; the views know nothing else of it.
export interface PictureSource {
  watch(stations: string[]): void;
  onPicture: (picture: Picture) => void;
}

// What came of a stop of all: the stations that are being stopped, and what is in the way of it;
// "log_in": the session is over; null: the console did not answer.
export type StopAnswer = { stopping: string[]; problem?: string } | "log_in" | null;
export type Answer = { number: number; station: string; accepted: boolean; why: string };
export type Session = { name: string; role: string; open: boolean };

type Coded = { header: Omit<Picture, "image">; jpeg: Uint8Array<ArrayBuffer> };

const RETRY_MS = 1000;
const STOP_PATIENCE_MS = 2000;
const SILENT_MS = 3500; // the server says something each second

export class Link implements PictureSource {
  site: Site = emptySite();
  viewer = 0;
  isUp = false;
  replay: ReplayState | null = null; // what is shown was recorded
  onChange: () => void = () => {};
  onPicture: (picture: Picture) => void = () => {};
  onAnswer: (answer: Answer) => void = () => {};
  onUnconfirmed: (stations: string[]) => void = () => {}; // of a stop of all, anybody's
  onLoggedOut: () => void = () => {};

  private socket: WebSocket | null = null;
  private timer = 0;
  private isOver = false;
  private numbers = 0;
  private stops = new Set<number>(); // their confirmations are in the stations' states
  private heard_ms = 0;
  time_us = 0; // the server's, when it was last said
  private timeHeard_ms = 0;
  private watched: string[] = [];
  private decoding = new Map<string, Coded | null>(); // the picture that waits meanwhile

  start() {
    this.timer = window.setInterval(() => this.look(), 500);
    this.connect();
  }

  // With the session: nothing is heard, said or tried again from now on.
  end() {
    this.isOver = true;
    clearInterval(this.timer);
    this.socket?.close();
    this.socket = null;
  }

  // The server's UTC, whatever this device's clock says; of a replay, the recording's [us].
  now_us(): number {
    const pace = !this.replay ? 1 : this.replay.playing ? this.replay.speed : 0;
    return this.time_us + (performance.now() - this.timeHeard_ms) * 1000 * pace;
  }

  private connect() {
    const scheme = location.protocol === "https:" ? "wss:" : "ws:";
    const socket = new WebSocket(`${scheme}//${location.host}/api/live`);
    socket.binaryType = "arraybuffer";
    socket.onmessage = (event) => this.hear(event.data);
    socket.onclose = () => this.lost(socket);
    this.socket = socket;
    this.heard_ms = performance.now();
  }

  private async lost(socket: WebSocket) {
    if (socket !== this.socket) return;
    this.socket = null;
    this.isUp = false;
    this.onChange();
    setTimeout(async () => {
      if (this.isOver) return;
      const session = await fetch("/api/session").catch(() => null);
      if (this.isOver) return;
      if (session?.status === 401) this.onLoggedOut();
      else this.connect();
    }, RETRY_MS);
  }

  private look() {
    if (!this.socket || performance.now() - this.heard_ms < SILENT_MS) return;
    const socket = this.socket;
    socket.onclose = null;
    socket.close();
    this.lost(socket);
  }

  private hear(data: string | ArrayBuffer) {
    this.heard_ms = performance.now();
    if (data instanceof ArrayBuffer) {
      void this.showPicture(data);
      return;
    }
    const message = JSON.parse(data);
    if (message.time_us) {
      this.time_us = message.time_us;
      this.timeHeard_ms = performance.now();
    }
    if (message.replay) this.replay = message.replay;
    if (message.kind === "answer") return this.answered(message);
    if (message.kind === "stop_unconfirmed") return this.onUnconfirmed(message.stations);
    if (message.kind === "hello") {
      this.viewer = message.viewer;
      this.isUp = true;
      this.say({ do: "watch", pictures: this.watched });
    } else {
      apply(this.site, message);
    }
    this.onChange();
  }

  private answered(answer: Answer) {
    if (answer.number === 0 && answer.accepted) return; // sent quietly
    if (!this.stops.has(answer.number) || !answer.accepted) this.onAnswer(answer);
  }

  // Four bytes with the length of the header, the header, a JPEG. Of each station one is decoded at a
  // time, and the newest waits: a device that is slower than the video shows fewer pictures, not older.
  private async showPicture(data: ArrayBuffer) {
    const length = new DataView(data).getUint32(0);
    const header = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, length)));
    const picture = { header, jpeg: new Uint8Array(data, 4 + length) };
    const { station } = header;
    if (this.decoding.has(station)) return void this.decoding.set(station, picture);
    for (let next: Coded | null = picture; next; next = this.decoding.get(station) ?? null) {
      this.decoding.set(station, null);
      const image = await createImageBitmap(new Blob([next.jpeg], { type: "image/jpeg" })).catch(() => null);
      if (image && (this.isOver || !this.site.stations.has(station))) image.close();
      else if (image) this.onPicture({ ...next.header, image });
    }
    this.decoding.delete(station);
  }

  private say(message: object): boolean {
    if (this.socket?.readyState !== WebSocket.OPEN) return false;
    this.socket.send(JSON.stringify(message));
    return true;
  }

  watch(stations: string[]) {
    if (stations.join() === this.watched.join()) return;
    this.watched = stations;
    this.say({ do: "watch", pictures: stations });
  }

  // The answer comes by onAnswer with the number returned; 0: not connected.
  send(message: object): number {
    const number = ++this.numbers;
    return this.say({ ...message, number }) ? number : 0;
  }

  // Nobody waits for its answer; a refusal is told all the same.
  sendQuietly(message: object) {
    this.say(message);
  }

  // Both by the WebSocket and by a request of its own: whichever is through first stops. The request
  // works when the WebSocket is busy or not there, and its answer is waited for no longer than a person
  // would.
  async stopAll(): Promise<StopAnswer> {
    const number = this.send({ do: "stop_all" });
    if (number) this.stops.add(number);
    try {
      const response = await fetch("/api/stop", {
        method: "POST",
        headers: { "Content-Type": "application/json" },
        body: "{}",
        signal: AbortSignal.timeout(STOP_PATIENCE_MS),
      });
      if (response.status === 401) return "log_in";
      return response.ok ? await response.json() : null;
    } catch {
      return null;
    }
  }
}
