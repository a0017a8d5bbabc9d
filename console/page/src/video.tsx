// The stations' pictures: the selected one large, the others small.

import { h } from "preact";
import { ArrangementChoice, type Arrangement } from "./arrangement";
import { problemOf } from "./conditions";
import { Eye } from "./eye";
import { useLand } from "./land";
import type { Link } from "./link";
import { Menu } from "./menu";
import type { Designate, Point } from "./onpicture";
import { usePictures } from "./pictures";
import type { Station } from "./site";
import { useSkylines, type SkylineChoice } from "./skyline";
import { ThinLinkChoice, useThinLink } from "./thinlink";
import { t } from "./words";

const MOST_WATCHED = 64; // kMostWatched of console/client_message.h

// The server refuses more: the selected one first, those that are heard before the silent.
function mostWanted(stations: Station[], selected: string): string[] {
  const rank = (station: Station) => (station.id === selected ? 0 : station.stale ? 2 : 1);
  const first = [...stations].sort((a, b) => rank(a) - rank(b)).slice(0, MOST_WATCHED);
  return first.map((station) => station.id).sort();
}

// What mouse, fingers and keys do in a picture.
function HandHint() {
  return (
    <Menu class="hint" word={t("mouse_and_keys")}>
      <p>{t("designate_hint")}</p>
      <p>{t("hand_hint")}</p>
    </Menu>
  );
}

// Whether the land's skyline is drawn in the pictures, and why it is not in this one.
function SkylineToggle({ isOn, choose, skylines, station }: SkylineChoice & { station: string }) {
  const problem = skylines?.problems.get(station);
  return (
    <label class="thin">
      <input type="checkbox" checked={isOn} onChange={(event) => choose(event.currentTarget.checked)} />
      {t("skyline")} <span role="status">{problem ? problemOf(problem) : ""}</span>
    </label>
  );
}

type Props = {
  link: Link;
  version: number;
  selected: string;
  mayCommand: boolean;
  arrangement: Arrangement;
  onSelect: (station: string) => void;
  onDesignate: Designate;
  onPoint: Point;
  onWithheld: (station: string) => void;
  onRelease: (station: string) => void;
};

export function VideoView({ link, selected, mayCommand, arrangement, onSelect, onDesignate, onPoint, onWithheld, onRelease }: Props) {
  const thin = useThinLink(link);
  const skyline = useSkylines(link, useLand(link));
  const stations = [...link.site.stations.values()].sort((a, b) => a.id.localeCompare(b.id));
  const ids = stations.map((s) => s.id);
  const pictures = usePictures(link, mostWanted(stations, selected), ids, thin.codec);
  const large = ids.includes(selected) ? selected : ids[0];
  link.focus = large ?? "";
  return (
    <section class="video" aria-label={t("video")}>
      {stations.length === 0 && <p class="nothing">{t("no_station")}</p>}
      <div class={`eyes ${ids.length === 1 ? "one" : ids.length > 6 ? "many" : ""}`} style={{ "--across": `${Math.max(2, ids.length - 1)}fr`, "--rows": Math.max(1, ids.length - 1) }}>
        {stations.map((station) => (
          <div key={station.id} class={`cell ${station.id === large ? "large" : ""}`}>
            <Eye
              link={link}
              station={station}
              picture={pictures.get(station.id)}
              large={station.id === large}
              isThin={thin.isThin}
              skyline={skyline}
              mayCommand={mayCommand}
              onSelect={() => onSelect(station.id)}
              onDesignate={onDesignate}
              onPoint={onPoint}
              onWithheld={() => onWithheld(station.id)}
              onRelease={() => onRelease(station.id)}
            />
            {station.id === large && (
              <div class="video-tools">
                <ArrangementChoice {...arrangement} />
                {!link.replay && <ThinLinkChoice {...thin} />}
                {skyline.isThere && <SkylineToggle {...skyline} station={station.id} />}
                {mayCommand && <HandHint />}
              </div>
            )}
          </div>
        ))}
      </div>
    </section>
  );
}
