// What may be told to a station, and who has it in hand.

import { h, Fragment } from "preact";
import { useState } from "preact/hooks";
import { numberOf } from "./format";
import { LensForm } from "./lensform";
import type { Link } from "./link";
import type { Station } from "./site";
import { Sure } from "./sure";
import { t } from "./words";

type Command = (station: string, command: string, more?: object) => void;
type Control = (station: string, take: boolean) => void;
export type StationProps = { link: Link; station: Station; mayCommand: boolean; onCommand: Command; onControl: Control };

type FormProps = { id: string; onCommand: Command };

function PointForm({ id, onCommand }: FormProps) {
  const [pan, setPan] = useState("0");
  const [tilt, setTilt] = useState("0");
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

function RecordForm({ id, onCommand }: FormProps) {
  const [label, setLabel] = useState("event");
  const submit = (event: Event) => {
    event.preventDefault();
    onCommand(id, "record", { before_s: 5, after_s: 5, label });
  };
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
function Holder({ link, station, mayCommand, onControl }: Omit<StationProps, "onCommand">) {
  const holder = station.control;
  const isMine = holder?.viewer === link.viewer;
  return (
    <p class="holder">
      {t("control")}: {!holder ? t("control_free") : isMine ? t("control_you") : `${holder.by} ${t("control_other")}`}
      {mayCommand && holder && !isMine && <button onClick={() => onControl(station.id, true)}>{t("take")}</button>}
      {isMine && <button onClick={() => onControl(station.id, false)}>{t("give_up")}</button>}
    </p>
  );
}

export function Commands({ link, station, mayCommand, onCommand, onControl }: StationProps) {
  const id = station.id;
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
            <Sure key={`home ${id}`} word={t("home")} question={`${id}: ${t("home_sure")}`} onSure={() => onCommand(id, "home")} />
            <button onClick={() => onCommand(id, "rearm")}>{t("rearm")}</button>
            <Sure key={`reference ${id}`} word={t("reference_ok")} question={`${id}: ${t("reference_sure")}`} onSure={() => onCommand(id, "reference_ok")} />
          </Fragment>
        )}
      </div>
      <LensForm station={station} onMove={mayCommand ? (axis, position) => onCommand(id, "lens", { is_rate: false, [axis]: position }) : null} />
      {mayCommand && (
        <Fragment>
          <PointForm id={id} onCommand={onCommand} />
          <RecordForm id={id} onCommand={onCommand} />
        </Fragment>
      )}
    </div>
  );
}
