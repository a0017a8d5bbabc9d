// The form of an area beside the map, on which its corners are clicked.

import { h } from "preact";
import { useState } from "preact/hooks";
import { numberOf } from "./format";
import { PanelFrame } from "./panel";
import type { Area, Corner } from "./site";
import { named, t, type Word } from "./words";

const CLASSES = ["drone", "bird", "aircraft", "other", "unknown"];

// From below the stations to where drones may be above them: heights are above the ellipsoid, so a site's own tell where its ground is.
const BELOW_M = 50;
const ABOVE_M = 1000;
export function newArea(stationHeights_m: number[]): Area {
  const known = stationHeights_m.length > 0 ? stationHeights_m : [0];
  const lowest_m = Math.floor((Math.min(...known) - BELOW_M) / 10) * 10;
  const highest_m = Math.ceil((Math.max(...known) + ABOVE_M) / 10) * 10;
  return { name: "", polygon: [], lowest_m, highest_m, classes: [], from: "00:00", to: "00:00" };
}

// One corner a line, as positions are written: latitude, longitude. Null: it is not that.
export function cornersOf(text: string): Corner[] | null {
  const corners: Corner[] = [];
  for (const line of text.split("\n").filter((one) => one.trim())) {
    const parts = line.trim().split(/[\s,;°]+/).filter(Boolean);
    const [latitude, longitude] = parts.map(numberOf);
    if (parts.length !== 2 || latitude == null || longitude == null) return null;
    corners.push([longitude, latitude]);
  }
  return corners;
}
export const textOfCorners = (corners: Corner[]) => corners.map(([longitude, latitude]) => `${latitude.toFixed(6)} ${longitude.toFixed(6)}`).join("\n");

function Classes({ of, onChange }: { of: string[]; onChange: (classes: string[]) => void }) {
  return (
    <fieldset>
      <legend>{t("classes_hint")}</legend>
      {CLASSES.map((one) => (
        <label key={one}>
          <input type="checkbox" checked={of.includes(one)} onChange={(e) => onChange(e.currentTarget.checked ? [...of, one] : of.filter((other) => other !== one))} /> {named("t", one)}
        </label>
      ))}
    </fieldset>
  );
}

// Text that is no corners stays in the field until it is, or until a corner is clicked.
function Corners({ of, onChange }: { of: Corner[]; onChange: (corners: Corner[]) => void }) {
  const [draft, setDraft] = useState<string | null>(null);
  const known = textOfCorners(of);
  const write = (text: string) => {
    const corners = cornersOf(text);
    setDraft(corners && textOfCorners(corners) === text ? null : text);
    if (corners) onChange(corners);
  };
  return (
    <label>
      {t("corners")}
      <textarea rows={4} value={draft ?? known} aria-invalid={draft != null && !cornersOf(draft)} onInput={(e) => write(e.currentTarget.value)} onBlur={() => draft != null && cornersOf(draft) && setDraft(null)} />
    </label>
  );
}

type Props = { area: Area; local: string; onChange: (area: Area) => void; onSave: (area: Area) => void; onClose: () => void };

export function AreaPanel({ area, local, onChange, onSave, onClose }: Props) {
  const set = (changed: Partial<Area>) => onChange({ ...area, ...changed });
  const field = (word: Word, key: "lowest_m" | "highest_m") => (
    <label>
      {t(word)} m
      <input type="number" required step="any" value={area[key]} onInput={(e) => set({ [key]: numberOf(e.currentTarget.value) ?? 0 })} />
    </label>
  );
  const time = (word: Word, key: "from" | "to") => (
    <label>
      {t(word)}
      <input type="time" required value={area[key]} onInput={(e) => set({ [key]: e.currentTarget.value })} />
    </label>
  );
  const save = (event: Event) => {
    event.preventDefault();
    onSave(area);
  };
  return (
    <PanelFrame label={t("area")} head={<h2>{t("area")}</h2>} onClose={onClose}>
      <form class="area-form" onSubmit={save}>
        <label>
          {t("name")}
          <input required maxLength={40} value={area.name} onInput={(e) => set({ name: e.currentTarget.value })} />
        </label>
        <p>{t("corners_hint")}</p>
        <Corners of={area.polygon} onChange={(polygon) => set({ polygon })} />
        <div class="pair">
          {field("lowest", "lowest_m")}
          {field("highest", "highest_m")}
        </div>
        <p>{t("height_of")}</p>
        <Classes of={area.classes} onChange={(classes) => set({ classes })} />
        <div class="pair">
          {time("from", "from")}
          {time("to", "to")}
        </div>
        <p>
          {t("times_hint")} {local}.
        </p>
        <button disabled={area.polygon.length < 3}>{t("save")}</button>
      </form>
    </PanelFrame>
  );
}
