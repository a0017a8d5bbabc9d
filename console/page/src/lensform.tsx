// A motorised lens of a station: where it stands, and where it is to go.

import { h } from "preact";
import { useRef, useState } from "preact/hooks";
import { useEscape } from "./escape";
import type { Station } from "./site";
import { fixed } from "./format";
import { t } from "./words";

const AXES = ["zoom", "focus", "iris"] as const;
const STEP = 0.01;

type Axis = (typeof AXES)[number];
type Move = ((axis: Axis, position: number) => void) | null; // null: it is not for this person to move

// At null the lens has not said where it is.
function AxisSlider({ axis, at, onMove }: { axis: Axis; at: number | null; onMove: Move }) {
  const [wanted, setWanted] = useState<number | null>(null); // while it is dragged
  const isLeft = useRef(false); // the drag was cancelled
  const leave = () => {
    isLeft.current = true;
    setWanted(null);
  };
  useEscape(wanted !== null, leave);
  return (
    <label>
      {t(axis)} {at == null ? t("v_unknown") : `${Math.round(100 * at)} %`}
      <input
        type="range"
        min={0}
        max={1}
        step={STEP}
        value={wanted ?? at ?? 0}
        disabled={!onMove || at == null}
        onPointerDown={() => (isLeft.current = false)}
        onInput={(event) => !isLeft.current && setWanted(Number(event.currentTarget.value))}
        onChange={(event) => {
          setWanted(null);
          if (!isLeft.current) onMove?.(axis, Number(event.currentTarget.value));
          isLeft.current = false;
        }}
      />
    </label>
  );
}

export function LensForm({ station, onMove }: { station: Station; onMove: Move }) {
  const lens = station.lens;
  if (!lens) return null;
  return (
    <fieldset class="lens">
      <legend>
        {t("lens")} {fixed(lens.focal_length_px, 0)} ±{fixed(lens.focal_length_sd_px, 1, " px")}
      </legend>
      {AXES.map((axis) => (
        <AxisSlider key={axis} axis={axis} at={lens[axis]} onMove={onMove} />
      ))}
    </fieldset>
  );
}
