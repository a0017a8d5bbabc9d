// A station's picture with what is drawn over it, its caption, and the hand on it.

import { h } from "preact";
import { useEffect, useLayoutEffect } from "preact/hooks";
import { canGoBack } from "./byhand";
import { fixed } from "./format";
import { steerByGamepad } from "./gamepad";
import type { Link } from "./link";
import { axisMark } from "./marks";
import { useOnPicture, type OnPicture, type PictureProps } from "./onpicture";
import { drawPicture } from "./overlay";
import { pressKey } from "./picturekeys";
import { usePointer } from "./picturepointer";
import { stationState } from "./site";
import type { SkylineChoice } from "./skyline";
import { stateText } from "./statetext";
import { t } from "./words";

const OLD_S = 5;

// From the exposure until now: in ms while the picture is live.
const delay = (age_s: number) => (age_s < 1 ? `${fixed(Math.max(0, 1000 * age_s), 0)} ms` : `${fixed(age_s, 1)} s`);

function Caption({ link, on, isThin }: { link: Link; on: OnPicture; isThin: boolean }) {
  const { station, shown, large, looks, setLooks } = on;
  const { region } = on.part;
  const age_s = shown ? (link.now_us() - shown.utime_us) / 1e6 : NaN;
  const state = stationState(station);
  const exposure_us = station.readings?.camera_exposure_us;
  return (
    <figcaption>
      <b>{station.id}</b>
      <span class={`state ${state}`}>{stateText(station, link.now_us())}</span>
      {large && on.mayCommand && station.kind === "overview" && (
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
  );
}

// Who turns the station of the large picture, and how that is changed: before a hand can, and back.
function InHand({ on }: { on: OnPicture }) {
  const { station, byHand, setByHand, isWithheld, onRelease } = on;
  const hasFinger = matchMedia("(any-pointer: coarse)").matches;
  return (
    <div class="in-hand">
      {canGoBack(station) && (
        <button type="button" onClick={onRelease}>
          {t("back_to_tracking")}
        </button>
      )}
      {(byHand || isWithheld || hasFinger) && (
        <button type="button" aria-pressed={byHand} aria-keyshortcuts="M" onClick={() => setByHand(!byHand)}>
          {t("by_hand")}
        </button>
      )}
      {byHand && <span>{t("by_hand_next")}</span>}
    </div>
  );
}

export function Eye({ isThin, skyline, ...rest }: PictureProps & { isThin: boolean; skyline: SkylineChoice }) {
  const { link, station, large, mayCommand, onSelect } = rest;
  const on = useOnPicture(rest);
  const { canvas, shown, hand } = on;
  const { box, held } = on.drawn;
  const { region } = on.part;
  const isTracking = station.state === "tracking" && !station.stale;
  // At once, and with the attributes that say which picture it is.
  useLayoutEffect(() => {
    if (canvas.current && shown) drawPicture(canvas.current, link.site, shown, region, box, isTracking, skyline.skylines);
  }, [shown, region, box, isTracking, large, skyline.skylines, skyline.news]);
  const pointer = usePointer(on);
  useEffect(() => (large && mayCommand ? steerByGamepad(hand) : undefined), [large, mayCommand]);
  return (
    <figure
      class={["eye", large && "large", held.current && "held", on.byHand && "by-hand", station.stale && "stale"].filter(Boolean).join(" ")}
      style={shown && { "--ratio": shown.full_px[0] / shown.full_px[1] }}
    >
      <Caption link={link} on={on} isThin={isThin} />
      <canvas
        ref={canvas}
        role="img"
        aria-label={station.id}
        data-utime-us={shown?.utime_us}
        tabIndex={0}
        width={640}
        height={512}
        {...pointer}
        onContextMenu={(event: MouseEvent) => event.preventDefault()}
        onKeyUp={() => hand.release()}
        onBlur={() => hand.release()}
        onFocus={(event: FocusEvent) => (event.currentTarget as Element).matches(":focus-visible") && onSelect()}
        onKeyDown={(event: KeyboardEvent) => pressKey(on, event)}
      />
      {large && mayCommand && station.kind !== "fixed" && <InHand on={on} />}
    </figure>
  );
}
