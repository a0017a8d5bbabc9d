// A place that a person has chosen on the map: where it is, and stations that are to look there.

import { h } from "preact";
import { useEffect, useState } from "preact/hooks";
import { numberOf } from "./format";
import { LineProfile } from "./lineprofile";
import type { Link } from "./link";
import { length } from "./measures";
import { PanelFrame, PanelRow, PointThere, PositionRows, type OnPoint } from "./panel";
import { stationHeights } from "./site";
import { t } from "./words";

const ABOVE_M = 100; // the stations: where most things fly that are looked for

// "place:LATITUDE,LONGITUDE" [deg]; null for what else is selected.
export function placeOf(selected: string): { latitude_deg: number; longitude_deg: number } | null {
  if (!selected.startsWith("place:")) return null;
  const [latitude_deg, longitude_deg] = selected.slice(6).split(",").map(Number);
  return { latitude_deg, longitude_deg };
}

function useMgrs(at: string): string | undefined {
  const [mgrs, setMgrs] = useState<string>();
  useEffect(() => {
    let isOver = false;
    void fetch(`/api/measure?from=${at}&to=${at}`)
      .then((response) => (response.ok ? response.json() : null))
      .then((answer) => !isOver && setMgrs(answer?.mgrs))
      .catch(() => null);
    return () => void (isOver = true);
  }, [at]);
  return mgrs;
}

function meanHeight(link: Link): number {
  const heights = stationHeights(link.site);
  return heights.reduce((sum, one) => sum + one, 0) / Math.max(1, heights.length);
}

type Props = { selected: string; link: Link; station: string; mayCommand: boolean; onPoint: OnPoint; onClose: () => void };

export function PlacePanel({ selected, link, station, mayCommand, onPoint, onClose }: Props) {
  const place = { ...placeOf(selected)!, mgrs: useMgrs(selected.slice(6)) };
  const [height, setHeight] = useState(() => String(Math.round(meanHeight(link) + ABOVE_M)));
  const height_m = numberOf(height);
  return (
    <PanelFrame label={t("place")} head={<h2>{t("place")}</h2>} onClose={onClose}>
      <dl>
        <PositionRows of={place} />
        <PanelRow word="height">
          <label>
            <input aria-label={`${t("height")} m`} inputMode="decimal" value={height} onInput={(e) => setHeight(e.currentTarget.value)} /> m ({t("height_of")}, {t("stations")} {length(meanHeight(link))})
          </label>
        </PanelRow>
      </dl>
      {height_m != null && <LineProfile link={link} station={station} place={{ latitude_deg: place.latitude_deg, longitude_deg: place.longitude_deg, height_m }} />}
      {mayCommand && height_m != null && <PointThere link={link} place={{ latitude_deg: place.latitude_deg, longitude_deg: place.longitude_deg, height_m }} onPoint={onPoint} />}
    </PanelFrame>
  );
}
