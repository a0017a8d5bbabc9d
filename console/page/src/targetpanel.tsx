// Everything that is known of the selected target, beside it on the map.

import { h, Fragment } from "preact";
import { useState } from "preact/hooks";
import { useEscape } from "./escape";
import { bearing, DASH, fixed } from "./format";
import { LineProfile } from "./lineprofile";
import type { Link } from "./link";
import { heightRange, stepOf } from "./heights";
import { heightColours } from "./mapfeatures";
import { climb, length, speed } from "./measures";
import { PanelFrame, PanelRow, PointThere, PositionRows, type OnPoint } from "./panel";
import { WordOn } from "./targets";
import { nameOf, stretches, targetState, type Target } from "./site";
import { hiddenText } from "./statetext";
import { named, t } from "./words";

const TRAIL_WIDTH = 240; // [px]
const TRAIL_HEIGHT = 44;

// How high it was along its trail, in the colours of the map.
function TrailProfile({ target, targets }: { target: Target; targets: Target[] }) {
  const trail = stretches(target).flat();
  const range = heightRange(targets);
  if (!range || trail.length < 2) return <span>{DASH}</span>;
  const colours = heightColours();
  const heights = trail.map(([, , height_m]) => height_m);
  const [lowest, highest] = [Math.min(...heights), Math.max(...heights)];
  const x = (i: number) => (TRAIL_WIDTH * i) / (heights.length - 1);
  const y = (height_m: number) => 2 + (TRAIL_HEIGHT - 4) * (1 - (height_m - range[0]) / (range[1] - range[0]));
  return (
    <figure class="trail-profile">
      <svg viewBox={`0 0 ${TRAIL_WIDTH} ${TRAIL_HEIGHT}`} role="img" aria-label={`${t("trail")}: ${length(lowest)} – ${length(highest)}`}>
        {heights.slice(1).map((height_m, i) => (
          <line x1={x(i)} y1={y(heights[i])} x2={x(i + 1)} y2={y(height_m)} stroke={colours[stepOf((heights[i] + height_m) / 2, range, colours.length)]} stroke-width="2" stroke-linecap="round" />
        ))}
      </svg>
      <figcaption>
        {length(lowest)} – {length(highest)}
      </figcaption>
    </figure>
  );
}

function Covariance({ target }: { target: Target }) {
  const values = target.covariance_enu_m2;
  const ellipse = target.ellipse95;
  const sd = (target.sd_enu_m ?? []).map((one) => length(one, 2)).join(" · ");
  if (!values) return <span>{sd}</span>;
  const [ee, en, eu, nn, nu, uu] = values.map((value) => (value == null ? DASH : Number(value.toPrecision(3))));
  return (
    <details>
      <summary>{sd}</summary>
      {ellipse && (
        <p>
          95 %: {length(ellipse.semi_major_m, 2)} × {length(ellipse.semi_minor_m, 2)}, {bearing(ellipse.azimuth_deg, 0)}
        </p>
      )}
      <table class="numbers" aria-label={t("covariance")}>
        <tbody>
          {[
            [ee, en, eu],
            [en, nn, nu],
            [eu, nu, uu],
          ].map((row) => (
            <tr>
              {row.map((value) => (
                <td>{value}</td>
              ))}
            </tr>
          ))}
        </tbody>
      </table>
      <p>{t("covariance_of")}</p>
    </details>
  );
}

function SeenBy({ target }: { target: Target }) {
  return (
    <ul class="seen-by">
      {target.stations?.map((one) => (
        <li class={one.used ? "used" : ""}>
          {one.id} {one.used ? fixed(one.age_s && Math.max(0, one.age_s), 1, " s") : t("not_used")}
        </li>
      ))}
    </ul>
  );
}

// What operators call it.
function Name({ target, onName }: { target: Target; onName: ((name: string) => void) | null }) {
  const [draft, setDraft] = useState<string | null>(null);
  useEscape(draft != null, () => setDraft(null));
  const submit = (event: Event) => {
    event.preventDefault();
    onName?.(draft!.trim());
    setDraft(null);
  };
  if (draft != null) {
    return (
      <form onSubmit={submit}>
        <input aria-label={t("name")} value={draft} maxLength={20} ref={(input) => input?.focus()} onInput={(e) => setDraft(e.currentTarget.value)} />
        <button>{t("enter_user")}</button>
      </form>
    );
  }
  return (
    <h2>
      {t("target")} {nameOf(target)}{" "}
      {onName && (
        <button type="button" onClick={() => setDraft(target.name ?? "")}>
          {t("name_it")}
        </button>
      )}
    </h2>
  );
}

// "drone (87 %), 0.4 ± 0.1 m, signal 12.0": what of it is known.
function Appearance({ of }: { of: Target }) {
  const sure = of.class_probability == null ? "" : ` (${fixed(100 * of.class_probability, 0)} %)`;
  const size = of.size_m == null ? "" : `, ${length(of.size_m, 1)} ± ${length(of.size_sd_m, 1)}`;
  const signal = of.signal == null ? "" : `, ${t("signal")} ${fixed(of.signal, 1)}`;
  return <>{named("t", of.class) + sure + size + signal}</>;
}

type PanelProps = { target: Target; link: Link; station: string; mayCommand: boolean; onPoint: OnPoint; onCue: (cue: string, allow: boolean) => void; onName: (name: string) => void; onClose: () => void };

export function TargetPanel({ target, link, station, mayCommand, onPoint, onCue, onName, onClose }: PanelProps) {
  const age_s = Math.max(0, (link.now_us() - target.utime_us) / 1e6);
  const { latitude_deg, longitude_deg, height_m } = target;
  const handover = link.site.fusion?.cues?.find((cue) => cue.id === target.id);
  return (
    <PanelFrame
      label={`${t("target")} ${target.id}`}
      head={
        <Fragment>
          <Name target={target} onName={mayCommand ? onName : null} />
          <span>{named("s", targetState(target))}</span>
        </Fragment>
      }
      onClose={onClose}
    >
      <dl>
        <PositionRows of={target} />
        <PanelRow word="height">{length(height_m, 1)}</PanelRow>
        {target.height_above_ground_m != null && (
          <PanelRow word="above_ground">
            {length(target.height_above_ground_m, 1)} ± {length(target.height_above_ground_sd_m, 1)}
          </PanelRow>
        )}
        <PanelRow word="speed">
          {speed(target.speed_m_s, 1)}, {bearing(target.course_deg, 0)}, {climb(target.velocity_enu_m_s?.[2])}
        </PanelRow>
        <PanelRow word="object_class">
          <Appearance of={target} />
        </PanelRow>
        <PanelRow word="sigma">
          <Covariance target={target} />
        </PanelRow>
        <PanelRow word="seen_by">
          <SeenBy target={target} />
        </PanelRow>
        {target.hidden && <PanelRow word="hidden_from_whom">{hiddenText(target, link.now_us())}</PanelRow>}
        {handover && (
          <PanelRow word="handover">
            {named("h", handover.state)} <WordOn cue={handover} mayCommand={mayCommand} onCue={onCue} />
          </PanelRow>
        )}
        <PanelRow word="crossing">{fixed(target.crossing_angle_deg, 0, "°")}</PanelRow>
        <PanelRow word="age">{fixed(age_s, 1, " s")}</PanelRow>
        <PanelRow word="trail">
          <TrailProfile target={target} targets={[...link.site.targets.values()]} />
        </PanelRow>
      </dl>
      {latitude_deg != null && <LineProfile link={link} station={station} place={{ latitude_deg, longitude_deg, height_m }} />}
      {mayCommand && latitude_deg != null && <PointThere link={link} place={{ latitude_deg, longitude_deg, height_m }} onPoint={onPoint} />}
    </PanelFrame>
  );
}
