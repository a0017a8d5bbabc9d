// The stations, each with its alarms, commands and readings.

import { h, Fragment } from "preact";
import { Alarms } from "./alarms";
import { lostForAll } from "./byhand";
import { calibrationText } from "./calibration";
import { conditionInWords, inWords, nameInWords } from "./conditions";
import { Fleet } from "./fleet";
import { bearing, clockError, DASH, fixed, utc } from "./format";
import { length, measures, position } from "./measures";
import { stationState, type Station } from "./site";
import { stateText } from "./statetext";
import { Commands, type StationProps } from "./stationcommands";
import { named, t, Word } from "./words";

function Row({ word, children }: { word: Word; children: any }) {
  return (
    <Fragment>
      <dt>{t(word)}</dt>
      <dd>{children}</dd>
    </Fragment>
  );
}

function Numbers({ word, values }: { word: Word; values: Record<string, number | null> }) {
  return (
    <details>
      <summary>{t(word)}</summary>
      <table class="numbers">
        <tbody>
          {Object.entries(values ?? {}).map(([name, value]) => (
            <tr key={name}>
              <th scope="row">{nameInWords(name)}</th>
              <td>{value == null ? DASH : Number(value.toPrecision(8))}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </details>
  );
}

function Facts({ station: s }: { station: Station }) {
  return (
    <dl>
      <Row word="pointing">
        {t("azimuth")} {bearing(s.azimuth_deg, 2)} {t("elevation")} {fixed(s.elevation_deg, 2, "°")} · {t("pan")} {fixed(s.pan_deg, 2)} {t("tilt_angle")} {fixed(s.tilt_deg, 2)}
      </Row>
      <Row word="position">
        {position(s, measures.position, 7)} {length(s.height_m, 1)}, ±{length(s.position_sd_m?.[0], 2)} ({named("v", s.position_source)})
      </Row>
      <Row word="heading">
        {fixed(s.heading_deg, 3, "°")} ±{fixed(s.heading_sd_deg, 4, "°")}
      </Row>
      <Row word="tilt">
        {fixed(s.tilt_x_deg, 3, "°")} {fixed(s.tilt_y_deg, 3, "°")} ±{fixed(s.tilt_sd_deg, 4, "°")} ({named("v", s.tilt_source)})
      </Row>
      <Row word="clock">
        {named("v", s.clock?.state ?? "unknown")} {clockError(s.clock?.error_s ?? null)}
      </Row>
      <Row word="calibration">{calibrationText(s.calibration)}</Row>
      <Row word="latency">{fixed(s.frame_latency_s == null ? null : s.frame_latency_s * 1000, 0, " ms")}</Row>
      <Row word="devices">
        <ul class="devices">
          {s.devices?.map((device) => (
            <li>
              <i class={`dot ${device.state}`} aria-hidden="true" />
              <b>{inWords(device.name)}</b> {named("v", device.state)}
              {device.text ? `: ${inWords(device.text)}` : ""}
            </li>
          ))}
        </ul>
      </Row>
      {s.last_error && (
        <Row word="last_error">
          {utc(s.last_error_utime_us)} {inWords(s.last_error)}
        </Row>
      )}
    </dl>
  );
}

function Details(props: StationProps) {
  const { station: s, link, onAcknowledge } = props;
  const quarantine = link.site.fusion?.stations?.find((one) => one.id === s.id)?.quarantine;
  const ofFusion = link.site.fusion?.alarms?.find((alarm) => quarantine && alarm.parameters.station === s.id);
  return (
    <div class="details">
      <Alarms alarms={s.alarms} station={s.id} link={link} onAcknowledge={onAcknowledge} />
      {quarantine && <p class="quarantine">{ofFusion ? conditionInWords(ofFusion) : t("quarantine")}</p>}
      <Commands {...props} />
      <Facts station={s} />
      <Numbers word="readings" values={s.readings} />
      <Numbers word="counters" values={s.counters} />
    </div>
  );
}

type StationsProps = Omit<StationProps, "station"> & { selected: string; onSelect: (pick: string) => void };

export function Stations({ link, selected, onSelect, ...rest }: StationsProps) {
  const stations = [...link.site.stations.values()].sort((a, b) => a.id.localeCompare(b.id));
  const fusionAlarms = link.site.fusion?.alarms ?? [];
  const lost = lostForAll(link.site);
  return (
    <section class="stations" aria-label={t("stations")}>
      <header>
        <h2>{t("stations")}</h2>
      </header>
      <div class="scroll" tabIndex={0} role="group" aria-label={t("stations")}>
        {stations.length === 0 && <p class="nothing">{t("no_station")}</p>}
        {lost.length > 0 && rest.mayCommand && (
          <p class="lost-for-all">
            {lost.join(", ")}: {t("lost_for_all")}
          </p>
        )}
        {fusionAlarms.length > 0 && (
          <div class="fusion-alarms">
            <h3>{t("fusion")}</h3>
            <Alarms alarms={fusionAlarms} station="" link={link} onAcknowledge={rest.onAcknowledge} />
          </div>
        )}
        {stations.map((s) => {
          const isOpen = selected === s.id;
          const state = stationState(s);
          return (
            <article key={s.id} class={[isOpen && "open", s.stale && "stale"].filter(Boolean).join(" ")}>
              <h3>
                <button type="button" aria-expanded={isOpen} onClick={() => onSelect(isOpen ? "" : s.id)}>
                  <span class="who">{s.id}</span>
                  <span class={`state ${state}`}>{stateText(s, link.now_us())}</span>
                  <span class="aim">
                    {bearing(s.azimuth_deg)} {fixed(s.elevation_deg, 1, "°")}
                  </span>
                  <span class="belief">
                    <meter min={0} max={1} value={s.stale ? 0 : (s.belief ?? 0)} aria-label={t("belief")} />
                  </span>
                  {s.alarms?.length > 0 && <span class="badge">{s.alarms.length}</span>}
                  {s.control && <span class="hand">{s.control.viewer === link.viewer ? "●" : inWords(s.control.by)}</span>}
                </button>
              </h3>
              {isOpen && <Details link={link} station={s} {...rest} />}
            </article>
          );
        })}
        <Fleet stations={stations} />
      </div>
    </section>
  );
}
