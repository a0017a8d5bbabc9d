// What the panels of a target and of a place on the map have in common.

import { h, Fragment } from "preact";
import { useState } from "preact/hooks";
import type { Link } from "./link";
import { t, type Word } from "./words";

export type Place = { latitude_deg: number; longitude_deg: number; height_m: number };
export type OnPoint = (station: string, place: Place) => void;

export function PanelRow({ word, children }: { word: Word; children: any }) {
  return (
    <Fragment>
      <dt>{t(word)}</dt>
      <dd>{children}</dd>
    </Fragment>
  );
}

// A text with a button that copies it.
export function Copied({ text }: { text: string }) {
  const [said, setSaid] = useState<Word>("copy");
  const copy = () =>
    navigator.clipboard.writeText(text).then(
      () => setSaid("copied"),
      () => setSaid("not_copied"),
    );
  return (
    <Fragment>
      {text}{" "}
      <button type="button" onClick={copy} onBlur={() => setSaid("copy")}>
        {t(said)}
      </button>
    </Fragment>
  );
}

const FOLLOWS = ["tracking", "coasting"]; // it would lose what it follows

// A button for each station that may be turned to a place without losing what it follows.
export function PointThere({ link, place, onPoint }: { link: Link; place: Place; onPoint: OnPoint }) {
  const stations = [...link.site.stations.values()].sort((a, b) => a.id.localeCompare(b.id));
  return (
    <div class="point-there" role="group" aria-label={t("point_there")}>
      <span>{t("point_there")}:</span>
      {stations.map((one) => (
        <button key={one.id} type="button" disabled={one.stale || FOLLOWS.includes(one.state)} onClick={() => onPoint(one.id, place)}>
          {one.id}
        </button>
      ))}
    </div>
  );
}
