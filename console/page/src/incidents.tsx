// What has come into the areas that are watched: the list from which a guard confirms or dismisses; and the
// areas themselves.

import { h, Fragment } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { newArea } from "./areapanel";
import { inWords } from "./conditions";
import { useEscape } from "./escape";
import { DASH, fixed, utc } from "./format";
import type { Link } from "./link";
import { length } from "./measures";
import { isInside, isOpen, stationHeights, type Area, type Incident } from "./site";
import { Sure } from "./sure";
import { named, t, type Word } from "./words";

type TrackPoint = [utime_us: number, longitude_deg: number, latitude_deg: number, height_m: number];
const SKETCH = 200; // [px]
const MARGIN = 8;

// The track in its area, north up, at one scale.
function TrackSketch({ track, area }: { track: TrackPoint[]; area: Area | undefined }) {
  if (!track.length) return null;
  const [, longitude, latitude] = track[0];
  const narrow = Math.cos((latitude * Math.PI) / 180);
  const local = (lon: number, lat: number) => [((((lon - longitude + 180) % 360) + 360) % 360 - 180) * narrow, latitude - lat];
  const path = track.map(([, lon, lat]) => local(lon, lat));
  const border = (area?.polygon ?? []).map(([lon, lat]) => local(lon, lat));
  const all = [...path, ...border];
  const [left, top] = [0, 1].map((i) => Math.min(...all.map((one) => one[i])));
  const size = Math.max(1e-6, ...[0, 1].map((i) => Math.max(...all.map((one) => one[i])) - [left, top][i]));
  const scaled = ([x, y]: number[]) => [x - left, y - top].map((v) => MARGIN + ((SKETCH - 2 * MARGIN) * v) / size);
  const points = (of: number[][]) => of.map((one) => scaled(one).map((v) => v.toFixed(1)).join()).join(" ");
  const [x, y] = scaled(path[path.length - 1]);
  const heights = track.map((one) => one[3]);
  const range = `${length(Math.min(...heights))} – ${length(Math.max(...heights))}`;
  return (
    <figure>
      <svg viewBox={`0 0 ${SKETCH} ${SKETCH}`} role="img" aria-label={`${t("trail")}: ${range}`}>
        {border.length > 0 && <polygon class="border" points={points(border)} />}
        <polyline class="track" points={points(path)} />
        <circle r="4" cx={x} cy={y} />
      </svg>
      <figcaption>
        {t("trail")} {range}
      </figcaption>
    </figure>
  );
}

// As it was first seen, with the tracker's box.
function FirstPicture({ of }: { of: Incident }) {
  if (!of.picture) return null;
  const { station, full_px, box_px } = of.picture;
  return (
    <figure>
      <div class="incident-picture">
        <img src={`/api/incidents/${of.number}/picture`} alt={`${t("incident")} ${of.number}: ${station}`} />
        {full_px && box_px && (
          <svg viewBox={`0 0 ${full_px[0]} ${full_px[1]}`} aria-hidden="true">
            <rect x={box_px[0]} y={box_px[1]} width={box_px[2]} height={box_px[3]} vector-effect="non-scaling-stroke" />
          </svg>
        )}
      </div>
      <figcaption>{station}</figcaption>
    </figure>
  );
}

function Details({ of, area }: { of: Incident; area: Area | undefined }) {
  const [track, setTrack] = useState<TrackPoint[]>([]);
  useEffect(() => {
    let isOver = false;
    void fetch(`/api/incidents/${of.number}`)
      .then((response) => (response.ok ? response.json() : null))
      .then((answer) => !isOver && setTrack(answer?.track ?? []))
      .catch(() => null);
    return () => void (isOver = true);
  }, [of]);
  return (
    <div class="incident-details">
      <FirstPicture of={of} />
      <TrackSketch track={track} area={area} />
      <p>
        {t("seen_by")}: {of.stations.join(", ") || DASH}
        {of.entries > 1 && `; ${t("entries")}: ${of.entries}`}
      </p>
    </div>
  );
}

const VERDICTS: [Word, Incident["verdict"]][] = [
  ["confirm", "confirmed"],
  ["dismiss", "dismissed"],
  ["reopen", "open"],
];

type OnJudge = ((incident: Incident, verdict: Incident["verdict"]) => void) | null;
type RowProps = { of: Incident; area: Area | undefined; isShown: boolean; onShow: () => void; onJudge: OnJudge };

function IncidentRow({ of, area, isShown, onShow, onJudge }: RowProps) {
  const sure = of.class_probability ? ` (${fixed(100 * of.class_probability, 0)} %)` : "";
  const judged = of.judged_by ? `${named("i", of.verdict)}: ${inWords(of.judged_by)}` : named("i", of.verdict);
  return (
    <Fragment>
      <tr class={isOpen(of) ? "open" : ""}>
        <td>
          <button type="button" class="tag" aria-expanded={isShown} aria-label={`${t("incident")} ${of.number}`} onClick={onShow}>
            {of.number}
          </button>
        </td>
        <td>
          {utc(of.begun_us, true)} – {isInside(of) ? <b>{t("inside")}</b> : utc(of.ended_us)}
        </td>
        <td>{of.area}</td>
        <td>
          {named("t", of.class)}
          {sure} {of.target.replace(/.*\//, "")}
        </td>
        <td>
          {judged}{" "}
          {onJudge && (
            <span class="buttons">
              {VERDICTS.map(([word, verdict]) => verdict !== of.verdict && (verdict !== "open" || of.judged_by) && (
                <button type="button" key={word} aria-label={`${t(word)}: ${t("incident")} ${of.number}`} onClick={() => onJudge(of, verdict)}>
                  {t(word)}
                </button>
              ))}
            </span>
          )}
        </td>
      </tr>
      {isShown && (
        <tr>
          <td colSpan={5}>
            <Details of={of} area={area} />
          </td>
        </tr>
      )}
    </Fragment>
  );
}

type AreasProps = { areas: Area[]; heights_m: number[]; onEdit: ((area: Area) => void) | null; onRemove: (name: string) => void };

function Areas({ areas, heights_m, onEdit, onRemove }: AreasProps) {
  return (
    <section class="areas" aria-label={t("areas")}>
      <h3>{t("areas")}</h3>
      <ul>
        {areas.map((area) => (
          <li key={area.name}>
            <b>{area.name}</b> {length(area.lowest_m)} – {length(area.highest_m)}, {area.classes.map((one) => named("t", one)).join(", ") || t("all")}
            {area.from !== area.to && `, ${area.from} – ${area.to}`}{" "}
            {onEdit && (
              <span class="buttons">
                <button type="button" aria-label={`${t("change")}: ${area.name}`} onClick={() => onEdit(area)}>
                  {t("change")}
                </button>
                <Sure word={t("remove")} label={`${t("remove")}: ${area.name}`} question={`${area.name}: ${t("area_remove_sure")}`} onSure={() => onRemove(area.name)} />
              </span>
            )}
          </li>
        ))}
      </ul>
      {areas.length === 0 && <p class="nothing">{t("no_area")}</p>}
      {onEdit && (
        <button type="button" onClick={() => onEdit(newArea(heights_m))}>
          {t("new_area")}
        </button>
      )}
    </section>
  );
}

type Props = { link: Link; onJudge: OnJudge; onEdit: ((area: Area) => void) | null; onRemove: (name: string) => void; onClose: () => void };

export function Incidents({ link, onJudge, onEdit, onRemove, onClose }: Props) {
  const dialog = useRef<HTMLDialogElement>(null);
  const [shown, setShown] = useState(0);
  useEscape(true, onClose);
  useEffect(() => dialog.current!.show(), []);
  const incidents = [...link.site.incidents.values()].sort((a, b) => Number(isOpen(b)) - Number(isOpen(a)) || b.number - a.number);
  const areas = [...link.site.areas.values()].sort((a, b) => a.name.localeCompare(b.name));
  return (
    <dialog ref={dialog} class="users incidents" aria-label={t("incidents")} onClose={onClose}>
      <div class="users-head">
        <h2>{t("incidents")}</h2>
        <button type="button" onClick={() => dialog.current!.close()}>
          {t("close")}
        </button>
      </div>
      <div class="scroll" tabIndex={0} role="group" aria-label={t("incidents")}>
        <table>
          <thead>
            <tr>
              {(["incident", "time", "area", "target", "verdict"] as Word[]).map((word) => (
                <th>{t(word)}</th>
              ))}
            </tr>
          </thead>
          <tbody>
            {incidents.map((one) => (
              <IncidentRow key={one.number} of={one} area={link.site.areas.get(one.area)} isShown={shown === one.number} onShow={() => setShown(shown === one.number ? 0 : one.number)} onJudge={onJudge} />
            ))}
          </tbody>
        </table>
        {incidents.length === 0 && <p class="nothing">{t("no_incident")}</p>}
      </div>
      <Areas areas={areas} heights_m={stationHeights(link.site)} onEdit={onEdit} onRemove={onRemove} />
    </dialog>
  );
}
