// What the panels of a target and of a place on the map have in common.

import { h, Fragment } from "preact";
import { useState } from "preact/hooks";
import { isAtWork } from "./byhand";
import { useEscape } from "./escape";
import type { Link } from "./link";
import { position } from "./measures";
import { t, type Word } from "./words";

export type Place = { latitude_deg: number; longitude_deg: number; height_m: number };
export type OnPoint = (station: string, place: Place) => void;

type FrameProps = { label: string; head: any; onClose: () => void; children: any };

export function PanelFrame({ label, head, onClose, children }: FrameProps) {
  useEscape(true, onClose);
  return (
    <aside class="map-panel" aria-label={label}>
      <header>
        {head}
        <button type="button" onClick={onClose}>
          {t("close")}
        </button>
      </header>
      {children}
    </aside>
  );
}

// The place, as the user wants it written and in MGRS.
export function PositionRows({ of }: { of: Parameters<typeof position>[0] }) {
  return (
    <Fragment>
      <PanelRow word="position">
        <Copied text={position(of)} />
      </PanelRow>
      <PanelRow word="mgrs">{position(of, "mgrs")}</PanelRow>
    </Fragment>
  );
}

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

// A button for each station that may be turned to a place without ending what it does by itself.
export function PointThere({ link, place, onPoint }: { link: Link; place: Place; onPoint: OnPoint }) {
  const stations = [...link.site.stations.values()].sort((a, b) => a.id.localeCompare(b.id));
  return (
    <div class="point-there" role="group" aria-label={t("point_there")}>
      <span>{t("point_there")}:</span>
      {stations.map((one) => (
        <button key={one.id} type="button" disabled={one.stale || isAtWork(one)} onClick={() => onPoint(one.id, place)}>
          {one.id}
        </button>
      ))}
    </div>
  );
}
