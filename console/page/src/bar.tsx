// The bar on top of the page: the state of the site, the time, the choices of how the page looks, who is
// logged in, and the stop of all.

import { h, Fragment, type ComponentChildren } from "preact";
import { alarmOf, conditionOf, holds, inWords } from "./conditions";
import { utc } from "./format";
import type { Link, Session } from "./link";
import { isInside, isOpen } from "./site";
import { Sure } from "./sure";
import { Language, LANGUAGES, t, type Word } from "./words";

const THEMES = ["night", "day", "sunlight"] as const;

// How the page looks; a browser remembers it.
export type Look = {
  theme: string;
  language: Language;
  onTheme: (theme: string) => void;
  onLanguage: (language: Language) => void;
};

function Chips({ link }: { link: Link }) {
  const stations = [...link.site.stations.values()];
  const heard = stations.filter((s) => !s.stale).length;
  const alarms = link.site.events.filter((event) => holds(event) && conditionOf(alarmOf(event)).severity !== "notice");
  const isNew = alarms.some((event) => !event.acknowledged);
  const fusion = link.site.fusion && !link.site.fusion.stale;
  return (
    <ul class="chips">
      <li class={heard === stations.length && heard > 0 ? "good" : "bad"}>
        {t("stations")} <b>{`${heard}/${stations.length}`}</b>
      </li>
      <li class={fusion ? "good" : "bad"}>
        {t("fusion")} <b>{fusion ? t("ok") : t("silent")}</b>
      </li>
      <li class="plain">
        {t("targets")} <b>{[...link.site.targets.values()].filter((x) => !x.stale).length}</b>
      </li>
      {alarms.length > 0 && (
        <li class={isNew ? "bad" : "plain"}>
          {t("alarm")} <b>{alarms.length}</b>
        </li>
      )}
    </ul>
  );
}

export function LookChoice({ theme, language, onTheme, onLanguage }: Look) {
  return (
    <Fragment>
      <select aria-label={t("theme")} value={theme} onChange={(e) => onTheme(e.currentTarget.value)}>
        {THEMES.map((one) => (
          <option value={one}>{t(one)}</option>
        ))}
      </select>
      <select aria-label={t("language")} value={language} onChange={(e) => onLanguage(e.currentTarget.value as Language)}>
        {LANGUAGES.map((one) => (
          <option value={one}>{one.toUpperCase()}</option>
        ))}
      </select>
    </Fragment>
  );
}

type LoggedInProps = { session: Session; name: string; onLogOut: () => void; onUsers: () => void };

function LoggedIn({ session, name, onLogOut, onUsers }: LoggedInProps) {
  const role = t(`r_${session.role}` as Word);
  if (session.open) {
    return (
      <span class="user" title={t("local_user")}>
        {inWords(name) || role}
      </span>
    );
  }
  return (
    <Fragment>
      <span class="user">
        {name || session.name} · {role}
      </span>
      {session.role === "admin" && (
        <button type="button" onClick={onUsers}>
          {t("users")}
        </button>
      )}
      <button type="button" onClick={onLogOut}>
        {t("log_out")}
      </button>
    </Fragment>
  );
}

type BarProps = Omit<LoggedInProps, "name"> & { link: Link; look: Look; stopped: string[]; onStop: () => void; onRelease: (stations: string[]) => void; onIncidents: () => void; children: ComponentChildren };

// How many somebody should look at.
function IncidentsButton({ link, onIncidents }: { link: Link; onIncidents: () => void }) {
  const open = [...link.site.incidents.values()].filter(isOpen);
  return (
    <button type="button" class={open.some(isInside) ? "danger" : ""} onClick={onIncidents}>
      {t("incidents")} {open.length > 0 && <b>{open.length}</b>}
    </button>
  );
}

// `stopped`: the stations that this person may release. `children`: what opens below it.
export function Bar({ link, look, stopped, onStop, onRelease, onIncidents, children, ...person }: BarProps) {
  return (
    <header class="bar">
      <h1>OLS</h1>
      <Chips link={link} />
      <span class="gap" />
      {!link.replay && <IncidentsButton link={link} onIncidents={onIncidents} />}
      <time class="utc">{link.isUp ? utc(link.now_us()) : "--:--:--"} UTC</time>
      <div class="settings">
        <LookChoice {...look} />
        <LoggedIn name={link.name} {...person} />
      </div>
      {stopped.length > 0 && <Sure word={t("release_all")} question={t("release_all_sure")} onSure={() => onRelease(stopped)} />}
      {link.replay ? (
        <strong class="replay-tag">{t("replay")}</strong>
      ) : (
        <button type="button" class="stop-all" onClick={onStop} aria-keyshortcuts="Escape">
          {t("stop_all")} <kbd>Esc</kbd>
        </button>
      )}
      {children}
    </header>
  );
}
