// What may be told to a station, and who has it in hand.

import { h, Fragment } from "preact";
import { useState } from "preact/hooks";
import type { OnAcknowledge } from "./alarms";
import { inWords } from "./conditions";
import { fixed, numberOf } from "./format";
import { LensForm } from "./lensform";
import type { Link } from "./link";
import type { Station } from "./site";
import { Sure } from "./sure";
import { named, t } from "./words";

type Command = (station: string, command: string, more?: object) => void;
type Control = (station: string, take: boolean) => void;
export type StationProps = { link: Link; station: Station; mayCommand: boolean; onCommand: Command; onControl: Control; onAcknowledge: OnAcknowledge };

type FormProps = { id: string; onCommand: Command };

const angle = (deg: number | null) => (deg == null ? "" : fixed(deg, 1));

type PointProps = FormProps & { station: Station };

// It begins with where the unit is: "point" alone goes nowhere.
function PointForm({ id, station, onCommand }: PointProps) {
  const [pan, setPan] = useState(angle(station.pan_deg));
  const [tilt, setTilt] = useState(angle(station.tilt_deg));
  const submit = (event: Event) => {
    event.preventDefault();
    const [pan_deg, tilt_deg] = [numberOf(pan), numberOf(tilt)];
    if (pan_deg != null && tilt_deg != null) onCommand(id, "point", { pan_deg, tilt_deg });
  };
  return (
    <form onSubmit={submit}>
      <label>
        {t("pan")}
        <input inputMode="decimal" value={pan} onInput={(e) => setPan(e.currentTarget.value)} />
      </label>
      <label>
        {t("tilt_angle")}
        <input inputMode="decimal" value={tilt} onInput={(e) => setTilt(e.currentTarget.value)} />
      </label>
      <button>{t("point")}</button>
    </form>
  );
}

// Only where there is something that records; what is wrong with it is said instead.
function RecordForm({ id, station, onCommand }: PointProps) {
  const recorder = station.devices?.find((device) => device.name === "recorder");
  const [label, setLabel] = useState("event");
  const submit = (event: Event) => {
    event.preventDefault();
    onCommand(id, "record", { before_s: 5, after_s: 5, label });
  };
  if (!recorder) return null;
  if (recorder.state === "absent" || recorder.state === "fault") return <p class="holder">{`${t("record")}: ${inWords(recorder.text) || named("v", recorder.state)}`}</p>;
  return (
    <form onSubmit={submit}>
      <label>
        {t("label")}
        <input value={label} maxLength={40} onInput={(e) => setLabel(e.currentTarget.value)} />
      </label>
      <button>{t("record")} ±5 s</button>
    </form>
  );
}

// Who has the station in hand.
function Holder({ link, station, mayCommand, onControl }: Pick<StationProps, "link" | "station" | "mayCommand" | "onControl">) {
  const holder = station.control;
  const isMine = holder?.viewer === link.viewer;
  return (
    <p class="holder">
      {t("control")}: {!holder ? t("control_free") : isMine ? t("control_you") : `${inWords(holder.by)} ${t("control_other")}`}
      {mayCommand && holder && !isMine && <button onClick={() => onControl(station.id, true)}>{t("take")}</button>}
      {isMine && <button onClick={() => onControl(station.id, false)}>{t("give_up")}</button>}
    </p>
  );
}

export function Commands({ link, station, mayCommand, onCommand, onControl }: StationProps) {
  const id = station.id;
  const moves = station.kind !== "fixed";
  return (
    <div class="commands">
      <Holder link={link} station={station} mayCommand={mayCommand} onControl={onControl} />
      <div class="buttons">
        {!link.replay && (
          <button class="danger" onClick={() => onCommand(id, "stop")}>
            {t("stop")}
          </button>
        )}
        {mayCommand && (
          <Fragment>
            <button onClick={() => onCommand(id, "release")}>{t("release")}</button>
            {moves && <Sure key={`home ${id}`} word={t("home")} question={`${id}: ${t("home_sure")}`} onSure={() => onCommand(id, "home")} />}
            <button onClick={() => onCommand(id, "rearm")}>{t("rearm")}</button>
            {moves && <Sure key={`reference ${id}`} word={t("reference_ok")} question={`${id}: ${t("reference_sure")}`} onSure={() => onCommand(id, "reference_ok")} />}
          </Fragment>
        )}
      </div>
      <LensForm station={station} onMove={mayCommand ? (axis, position) => onCommand(id, "lens", { is_rate: false, [axis]: position }) : null} />
      {mayCommand && (
        <Fragment>
          {moves ? <PointForm key={`point ${id}`} id={id} station={station} onCommand={onCommand} /> : <p class="holder">{t("fixed_mount")}</p>}
          <RecordForm id={id} station={station} onCommand={onCommand} />
        </Fragment>
      )}
    </div>
  );
}
