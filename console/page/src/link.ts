// The connection to the server: state in, commands out, pictures and their pace. Reconnects by itself.

import { H264Stream, type Unit } from "./h264";
import type { Camera } from "./projection";
import type { ReplayState } from "./replay";
import { apply, emptySite, silence, type Said, Site } from "./site";

export type Picture = {
  station: string;
  utime_us: number;
  full_px: [number, number];
  box_px: [number, number, number, number] | null; // in the full frame
  belief?: number | null; // of the tracker in this frame
  camera?: Camera | null; // where it was and looked; null while that is unknown, missing in a preview
  codec?: string; // h264; missing: a JPEG
  image: ImageBitmap;
};
export type Codec = "jpeg" | "h264";

// Where pictures come from; the views know nothing else of it.
export interface PictureSource {
  watch(stations: string[], codec: Codec): void;
  focus: string; // the station of the large picture: the others come less often
  onPicture: (picture: Picture) => void;
}

// What came of a stop of all: the stations that are being stopped, and what is in the way of it;
// "log_in": the session is over; null: the console did not answer.
export type StopAnswer = { stopping: string[]; refusal?: Said } | "log_in" | null;
export type Answer = { number: number; station: string; accepted: boolean; refusal: Said | null };
// Somebody has stopped stations that are in this browser's hand, or taken them over; by "": nobody of the console.
export type Hand = { what: "stop" | "take"; by: string; stations: string[] };
export type Session = { name: string; role: string; open: boolean };

type StreamHeader = Omit<Picture, "image"> & { units: Unit[] };

const RETRY_MS = 1000;
const TAKEN_MS = 20; // what is taken meanwhile is said in one message
const SMALL_MS = 200; // between small pictures: nobody aims on them, and each costs as much as a large one
const STOP_PATIENCE_MS = 2000;
const SILENT_MS = 3500; // the server says something each second
const STALLED_MS = 1500; // kLateRate_us of console/console.cpp: what is sent now would come too late

export class Link implements PictureSource {
  site: Site = emptySite();
  viewer = 0;
  name = ""; // by which the others know this browser
  isUp = false;
  focus = "";
  era = 0; // ends with each cut and each stop, and with it what a hand holds
  replay: ReplayState | null = null; // what is shown was recorded
  onChange: () => void = () => {};
  onPicture: (picture: Picture) => void = () => {};
  onNoStream: () => void = () => {}; // this browser has failed to decode H.264
  onAnswer: (answer: Answer) => void = () => {};
  onUnconfirmed: (stations: string[]) => void = () => {}; // of a stop of all, anybody's
  onHand: (hand: Hand) => void = () => {};
  onLoggedOut: () => void = () => {};

  private socket: WebSocket | null = null;
  private timer = 0;
  private isOver = false;
  private numbers = 0;
  private stops = new Set<number>(); // their confirmations are in the stations' states
  private heard_ms = 0;
  time_us = 0; // the server's, when it was last said
  private timeHeard_ms = 0;
  localMinute = 0; // of the day, at the server
  private watched: { pictures: string[]; codec: Codec } = { pictures: [], codec: "jpeg" };
  private streams = new Map<string, H264Stream<StreamHeader>>();
  private taken = { pictures: new Set<string>(), state: false, timer: 0 };

  start() {
    this.timer = window.setInterval(() => this.look(), 500);
    this.connect();
  }

  // With the session: nothing is heard, said or tried again from now on.
  end() {
    this.isOver = true;
    this.closeStreams(() => true);
    clearInterval(this.timer);
    this.socket?.close();
    this.socket = null;
  }

  // The server's UTC, whatever this device's clock says; of a replay, the recording's [us].
  now_us(): number {
    const pace = !this.replay ? 1 : this.replay.playing ? this.replay.speed : 0;
    return this.time_us + (performance.now() - this.timeHeard_ms) * 1000 * pace;
  }

  // Something was heard a moment ago: what is sent now arrives.
  get isLive(): boolean {
    return this.isUp && performance.now() - this.heard_ms < STALLED_MS;
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
    this.era++;
    silence(this.site);
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
    if (!this.isUp) this.onChange(); // ages go on
    if (!this.socket || performance.now() - this.heard_ms < SILENT_MS) return;
    const socket = this.socket;
    socket.onclose = null;
    socket.close();
    this.lost(socket);
  }

  private hear(data: string | ArrayBuffer) {
    if (performance.now() - this.heard_ms > STALLED_MS) this.era++;
    this.heard_ms = performance.now();
    if (data instanceof ArrayBuffer) {
      void this.showPicture(data);
      return;
    }
    const message = JSON.parse(data);
    if (message.time_us) {
      this.time_us = message.time_us;
      this.timeHeard_ms = performance.now();
      this.localMinute = message.local_minute ?? this.localMinute;
    }
    if (message.replay) this.replay = message.replay;
    if (message.kind === "answer") return this.answered(message);
    if (message.kind === "stop_unconfirmed") return this.onUnconfirmed(message.stations);
    if (message.kind === "hand") return this.onHand(message);
    if (message.kind === "hello") {
      this.viewer = message.viewer;
      this.name = message.name;
      this.isUp = true;
      this.closeStreams(() => true); // the server begins anew, with key frames
      this.say({ do: "watch", ...this.watched });
    } else {
      apply(this.site, message);
      this.took({ state: true });
    }
    this.onChange();
  }

  private answered(answer: Answer) {
    if (answer.number === 0 && answer.accepted) return; // sent quietly
    if (!this.stops.has(answer.number) || !answer.accepted) this.onAnswer(answer);
  }

  // Four bytes with the length of the header, the header, a JPEG or units of a stream.
  private async showPicture(data: ArrayBuffer) {
    const came_ms = performance.now();
    const length = new DataView(data).getUint32(0);
    const header = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, length)));
    const bytes = new Uint8Array(data, 4 + length);
    const { station } = header;
    if (header.codec === "h264") {
      this.streamOf(station).take(header, bytes);
    } else {
      const image = await createImageBitmap(new Blob([bytes], { type: "image/jpeg" })).catch(() => null);
      if (image && (this.isOver || !this.site.stations.has(station))) image.close();
      else if (image) this.onPicture({ ...header, image });
    }
    const rest_ms = station === this.focus ? 0 : came_ms + SMALL_MS - performance.now();
    if (rest_ms > 0) setTimeout(() => this.took({ picture: station }), rest_ms);
    else this.took({ picture: station });
  }

  // The server sends the next state, and the next picture of a station, when this one has been dealt with:
  // a device that is slower than the site shows less, not older.
  private took({ picture, state }: { picture?: string; state?: boolean }) {
    if (picture) this.taken.pictures.add(picture);
    if (state) this.taken.state = true;
    if (document.hidden) this.sayTaken(); // it draws nothing, and its timers hardly run
    // Otherwise once the page has drawn what it was given.
    else this.taken.timer ||= window.setTimeout(() => this.sayTaken(), TAKEN_MS);
  }

  private sayTaken() {
    clearTimeout(this.taken.timer);
    const { pictures, state } = this.taken;
    this.taken = { pictures: new Set(), state: false, timer: 0 };
    this.say({ do: "taken", pictures: [...pictures], state });
  }

  private say(message: object): boolean {
    if (this.socket?.readyState !== WebSocket.OPEN) return false;
    this.socket.send(JSON.stringify(message));
    return true;
  }

  private streamOf(station: string): H264Stream<StreamHeader> {
    const known = this.streams.get(station);
    if (known) return known;
    const show = (header: StreamHeader, image: ImageBitmap) => {
      if (this.isOver || !this.site.stations.has(station) || this.watched.codec !== "h264") image.close();
      else this.onPicture({ ...header, image });
    };
    const stream = new H264Stream<StreamHeader>(show, () => this.onNoStream());
    this.streams.set(station, stream);
    return stream;
  }

  private closeStreams(isOver: (station: string) => boolean) {
    for (const [station, stream] of this.streams) {
      if (!isOver(station)) continue;
      stream.close();
      this.streams.delete(station);
    }
  }

  watch(pictures: string[], codec: Codec) {
    const wanted = { pictures, codec };
    if (JSON.stringify(wanted) === JSON.stringify(this.watched)) return;
    this.watched = wanted;
    this.closeStreams((station) => codec !== "h264" || !pictures.includes(station));
    this.say({ do: "watch", ...wanted });
  }

  // The answer comes by onAnswer with the number returned; 0: not connected.
  send(message: object): number {
    const number = ++this.numbers;
    return this.say({ ...message, number }) ? number : 0;
  }

  // The same, with what was heard last: the server refuses what a cut link delivers late.
  order(message: object): number {
    return this.send({ ...message, heard_us: this.time_us });
  }

  // One of many: nobody waits for its answer; a refusal is told all the same.
  rate(what: object): void {
    this.say({ do: "command", ...what, heard_us: this.time_us });
  }

  // Both by the WebSocket and by a request of its own: whichever is through first stops. The request
  // works when the WebSocket is busy or not there, and its answer is waited for no longer than a person
  // would.
  async stopAll(): Promise<StopAnswer> {
    this.era++;
    const number = this.send({ do: "stop_all" });
    if (number) this.stops.add(number);
    try {
      const response = await fetch("/api/stop", {
        method: "POST",
        headers: { "Content-Type": "application/json" },
        body: JSON.stringify({ viewer: this.viewer }),
        signal: AbortSignal.timeout(STOP_PATIENCE_MS),
      });
      if (response.status === 401) return "log_in";
      return response.ok ? await response.json() : null;
    } catch {
      return null;
    }
  }
}
