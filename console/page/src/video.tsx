// The stations' pictures, and the hand on them. A box that is dragged belongs to the picture it was
// dragged on.

import { h } from "preact";
import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import { steerByGamepad } from "./gamepad";
import { Hand, HOLD_MS, magnified, Pinch, STILL_PX, type Region } from "./hand";
import { decodesH264 } from "./h264";
import type { Codec, Link, Picture } from "./link";
import { drawPicture, type Box } from "./overlay";
import { axisMark } from "./marks";
import type { Station } from "./site";
import { fixed } from "./format";
import { remember, remembered } from "./memory";
import { named, t } from "./words";

const LEAST_DRAG_PX = 4;
const OLD_S = 5;
const MOST_WATCHED = 64; // kMostWatched of console/client_message.h

export type Designate = (station: string, frame_utime_us: number, box: Box) => void;
export type Point = (station: string, command: "centre" | "look", frame_utime_us: number, point: [number, number]) => void;

// Pictures under a person's box: their pixels stay until it is done.
const drawnOn = new Set<Picture>();

// Pixels of a decoded picture lie outside of what the collector counts.
function free(picture: Picture) {
  if (!drawnOn.has(picture)) picture.image.close();
}

// From the exposure until now: in ms while the picture is live.
const delay = (age_s: number) => (age_s < 1 ? `${fixed(Math.max(0, 1000 * age_s), 0)} ms` : `${fixed(age_s, 1)} s`);

type Held = { picture: Picture; from: [number, number]; size: string };
type EyeProps = {
  link: Link;
  station: Station;
  picture: Picture | undefined;
  large: boolean;
  isThin: boolean;
  mayCommand: boolean;
  onSelect: () => void;
  onDesignate: Designate;
  onPoint: Point;
};

function Eye({ link, station, picture, large, isThin, mayCommand, onSelect, onDesignate, onPoint }: EyeProps) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const held = useRef<Held | null>(null);
  const [box, setBox] = useState<Box | null>(null);
  const [region, setRegion] = useState<Region | null>(null);
  const [looks, setLooks] = useState(false);
  const now = useRef(station);
  now.current = station;
  const hand = useRef<Hand>();
  hand.current ??= new Hand(link, () => now.current);
  const pinch = useRef(new Pinch());
  const pressed = useRef<{ at: [number, number]; stamp: number; what: "" | "box" | "joystick" } | null>(null);
  const shown = held.current?.picture ?? picture;
  // At once, and with the attributes that say which picture it is.
  useLayoutEffect(() => {
    if (canvas.current && shown) drawPicture(canvas.current, link.site, shown, region, box, station.state === "tracking");
  }, [shown, region, box, station.state === "tracking", large]);
  const place = (event: MouseEvent): [number, number] => {
    const rect = canvas.current!.getBoundingClientRect();
    const [width, height] = shown!.full_px;
    const clamp = (value: number, most: number) => Math.max(0, Math.min(most, value));
    const [left, top, wide, high] = region ?? [0, 0, width, height];
    return [clamp(left + ((event.clientX - rect.left) / rect.width) * wide, width), clamp(top + ((event.clientY - rect.top) / rect.height) * high, height)];
  };
  const size = () => [canvas.current!.clientWidth, canvas.current!.clientHeight].join();
  const hold = (what: Held | null) => {
    const before = held.current?.picture;
    held.current = what;
    if (what) drawnOn.add(what.picture);
    if (!before || before === what?.picture) return;
    drawnOn.delete(before);
    if (before !== picture) before.image.close(); // it was replaced meanwhile
  };
  // A press on a small picture makes it large, and no more: a drag would begin in one layout and end in
  // another, with a box that nobody has drawn.
  const begin = (event: PointerEvent) => {
    if (!large) return onSelect();
    if (!picture || event.button !== 0) return;
    canvas.current!.setPointerCapture(event.pointerId);
    pinch.current.down(event);
    if (pinch.current.isTwo) return let_go();
    if (!mayCommand) return;
    hand.current!.press();
    const from = place(event);
    hold({ picture, from, size: size() });
    setBox([...from, 0, 0]);
    pressed.current = { at: [event.clientX, event.clientY], stamp: event.timeStamp, what: "" };
  };
  // By the events' own times: a busy page delays them and does not change what the hand meant.
  const meant = (press: NonNullable<typeof pressed.current>, event: PointerEvent) => {
    if (press.what || Math.hypot(event.clientX - press.at[0], event.clientY - press.at[1]) <= STILL_PX) return press.what;
    press.what = event.timeStamp - press.stamp >= HOLD_MS ? "joystick" : "box";
    if (press.what === "joystick") send(null);
    return press.what;
  };
  const let_go = () => {
    pressed.current = null;
    hand.current!.release();
    send(null);
  };
  // By the lens, where there is one and this person may; else of the picture that is there.
  const magnify = (event: MouseEvent, factor: number) => {
    if (!shown || (mayCommand && hand.current!.zoomBy(Math.log(factor) / 4))) return;
    setRegion(magnified(region, shown.full_px, place(event), factor));
  };
  const wheel = (event: WheelEvent) => {
    if (!large) return;
    event.preventDefault();
    magnify(event, Math.exp(-event.deltaY / 400));
  };
  const move = (event: PointerEvent) => {
    if (pinch.current.isTwo) return magnify(event, pinch.current.move(event));
    const press = pressed.current;
    if (press) {
      const [dx, dy] = [event.clientX - press.at[0], event.clientY - press.at[1]];
      const full = canvas.current!.clientWidth / 3;
      if (meant(press, event) === "joystick") return hand.current!.push(dx / full, -dy / full);
    }
    if (!held.current || !box) return;
    if (size() !== held.current.size) return send(null); // the layout has changed under the hand
    const [x0, y0] = held.current.from;
    const [x, y] = place(event);
    setBox([Math.min(x0, x), Math.min(y0, y), Math.abs(x - x0), Math.abs(y - y0)]);
  };
  // A box of the keyboard lies on the live picture: who moves it there takes longer than a picture lasts.
  const send = (wanted: Box | null) => {
    const on = held.current?.picture ?? picture;
    hold(null);
    setBox(null);
    if (!on || !wanted || wanted[2] < LEAST_DRAG_PX || wanted[3] < LEAST_DRAG_PX) return;
    onDesignate(station.id, on.utime_us, wanted.map((v) => Math.round(v * 10) / 10) as Box);
  };
  const end = (event: PointerEvent) => {
    const press = pressed.current;
    pinch.current.up(event);
    pressed.current = null;
    if (press?.what === "joystick") return hand.current!.release();
    if (!held.current) return;
    const { picture: on, from, size: then } = held.current;
    const still = press && press.what === "" && event.timeStamp - press.stamp < HOLD_MS;
    send(size() === then && !still ? box : null);
    if (!still) return;
    const point = from.map((v) => Math.round(v * 10) / 10) as [number, number];
    onPoint(station.id, looks || event.shiftKey ? "look" : "centre", on.utime_us, point);
    setLooks(false);
  };
  const pressed_by = (event: KeyboardEvent, drive: () => void) => {
    if (event.repeat) return; // it is held, not pressed
    hand.current!.press();
    drive();
  };
  const zoomByKey = (event: KeyboardEvent): boolean => {
    const towards = { "+": 1, "=": 1, "-": -1 }[event.key];
    if (!towards) return false;
    const [width, height] = picture!.full_px;
    if (mayCommand && station.lens?.zoom != null) pressed_by(event, () => hand.current!.zoom(towards));
    else setRegion(magnified(region, [width, height], [width / 2, height / 2], towards > 0 ? 1.3 : 1 / 1.3));
    return true;
  };
  const steerByKey = (event: KeyboardEvent): boolean => {
    const arrows: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const slow = event.shiftKey ? 0.4 : 0.8;
    if (arrows[event.key]) {
      pressed_by(event, () => hand.current!.push(arrows[event.key][0] * slow, arrows[event.key][1] * slow));
    } else if (event.key === "l" || event.key === "L") {
      onPoint(station.id, "look", picture!.utime_us, [picture!.full_px[0] / 2, picture!.full_px[1] / 2]);
    } else {
      return false;
    }
    return true;
  };
  const key = (event: KeyboardEvent) => {
    if (!picture) return;
    if (!box && zoomByKey(event)) return event.preventDefault();
    if (!mayCommand) return;
    if (event.key === "Enter") {
      event.preventDefault();
      if (box) return send(box);
      const [width, height] = picture.full_px;
      return setBox([width * 0.47, height * 0.47, width * 0.06, height * 0.06]);
    }
    if (!box && steerByKey(event)) return event.preventDefault();
    if (!box) return;
    if (event.key === "Backspace" || event.key === "Delete") return send(null);
    const steps: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const step = steps[event.key];
    if (!step) return;
    event.preventDefault();
    const by = picture.full_px[0] / 100;
    const [x, y, w, hgt] = box;
    if (event.shiftKey) setBox([x, y, Math.max(by, w + step[0] * by), Math.max(by, hgt + step[1] * by)]);
    else setBox([x + step[0] * by, y + step[1] * by, w, hgt]);
  };
  useEffect(() => () => let_go(), []);
  useEffect(() => (large && mayCommand ? steerByGamepad(hand.current!) : undefined), [large, mayCommand]);
  const age_s = shown ? (link.now_us() - shown.utime_us) / 1e6 : NaN;
  const state = station.stale ? "silent" : station.state;
  const exposure_us = station.readings?.camera_exposure_us;
  return (
    <figure class={`eye ${large ? "large" : ""} ${held.current ? "held" : ""}`}>
      <canvas
        ref={canvas}
        role="img"
        aria-label={station.id}
        data-utime-us={shown?.utime_us}
        tabIndex={0}
        width={640}
        height={512}
        onPointerDown={begin}
        onPointerMove={move}
        onPointerUp={end}
        onPointerCancel={(event: PointerEvent) => (pinch.current.up(event), let_go())}
        onWheel={wheel}
        onContextMenu={(event: MouseEvent) => event.preventDefault()}
        onKeyUp={() => hand.current!.release()}
        onBlur={() => hand.current!.release()}
        onFocus={(event: FocusEvent) => (event.currentTarget as Element).matches(":focus-visible") && onSelect()}
        onKeyDown={key}
      />
      <figcaption>
        <b>{station.id}</b>
        <span class={`state ${state}`}>{named("s", state)}</span>
        {large && mayCommand && station.kind === "overview" && (
          <button type="button" aria-pressed={looks} onClick={() => setLooks(!looks)}>
            {t("look_here")}
          </button>
        )}
        {isThin && shown && <span class="codec">{shown.codec === "h264" ? "H.264" : "JPEG"}</span>}
        {region && shown && <span class="magnified">{`${fixed(shown.full_px[0] / region[2], 1)}×`}</span>}
        {station.lens?.zoom != null && <span class="zoom">{`${Math.round(station.lens.zoom * 100)} %`}</span>}
        {large && shown && <span class="axis">{axisMark(link.site, shown).text}</span>}
        {large && exposure_us != null && <span class="exposure">{`${t("exposure")} ${fixed(exposure_us / 1000, 1, " ms")}`}</span>}
        <span class={age_s > OLD_S ? "age old" : "age"}>{shown ? delay(age_s) : t("no_picture")}</span>
      </figcaption>
    </figure>
  );
}

// The server refuses more: the selected one first, those that are heard before the silent.
function mostWanted(stations: Station[], selected: string): string[] {
  const rank = (station: Station) => (station.id === selected ? 0 : station.stale ? 2 : 1);
  const first = [...stations].sort((a, b) => rank(a) - rank(b)).slice(0, MOST_WATCHED);
  return first.map((station) => station.id).sort();
}

type Props = {
  link: Link;
  version: number;
  selected: string;
  mayCommand: boolean;
  onSelect: (station: string) => void;
  onDesignate: Designate;
  onPoint: Point;
};

export function VideoView({ link, selected, mayCommand, onSelect, onDesignate, onPoint }: Props) {
  const pictures = useRef(new Map<string, Picture>());
  const [, redraw] = useState(0);
  const [isThin, setThin] = useState(remembered("thin", "no") === "yes");
  const [decodes, setDecodes] = useState<boolean | null>(null);
  const codec: Codec = isThin && decodes ? "h264" : "jpeg";
  useEffect(() => {
    void decodesH264().then(setDecodes);
    link.onNoStream = () => setDecodes(false);
    link.onPicture = (picture) => {
      const replaced = pictures.current.get(picture.station);
      pictures.current.set(picture.station, picture);
      if (replaced) free(replaced);
      redraw((n) => n + 1);
    };
  }, []);
  const stations = [...link.site.stations.values()].sort((a, b) => a.id.localeCompare(b.id));
  const ids = stations.map((s) => s.id);
  const wanted = mostWanted(stations, selected);
  useEffect(() => link.watch(wanted, codec), [wanted.join(), codec]);
  useEffect(() => {
    for (const [id, picture] of pictures.current) {
      if (ids.includes(id)) continue;
      pictures.current.delete(id);
      free(picture);
    }
  }, [ids.join()]);
  const large = ids.includes(selected) ? selected : ids[0];
  link.focus = large ?? "";
  return (
    <section class="video" aria-label={t("video")}>
      {stations.length === 0 && <p class="nothing">{t("no_station")}</p>}
      <div class={`eyes ${ids.length === 1 ? "one" : ids.length > 6 ? "many" : ""}`} style={{ "--across": `${Math.max(2, ids.length - 1)}fr`, "--rows": Math.max(1, ids.length - 1) }}>
        {stations.map((station) => (
          <Eye
            key={station.id}
            link={link}
            station={station}
            picture={pictures.current.get(station.id)}
            large={station.id === large}
            isThin={isThin}
            mayCommand={mayCommand}
            onSelect={() => onSelect(station.id)}
            onDesignate={onDesignate}
            onPoint={onPoint}
          />
        ))}
      </div>
      {stations.length > 0 && !link.replay && (
        <label class="thin">
          <input
            type="checkbox"
            checked={isThin}
            onChange={(event) => {
              setThin(event.currentTarget.checked);
              remember("thin", event.currentTarget.checked ? "yes" : "no");
            }}
          />
          {t("thin_link")} <span role="status">{isThin && decodes === false ? t("thin_no") : ""}</span>
        </label>
      )}
      {mayCommand && stations.length > 0 && <p class="hint">{`${t("designate_hint")} ${t("hand_hint")}`}</p>}
    </section>
  );
}
