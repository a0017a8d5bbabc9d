// The page: the bar with the state of the site and the stop, and the views.

import { h, render, Fragment } from "preact";
import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import "ol/ol.css";
import "./page.css";
import { AlarmSpoken } from "./alarms";
import { Answer, Link, Session } from "./link";
import { MapView } from "./map";
import { History } from "./history";
import { Stations } from "./stations";
import { Targets } from "./targets";
import { VideoView } from "./video";
import { Procedures } from "./procedure";
import { ReplayBar } from "./replay";
import { Users } from "./users";
import { utc } from "./format";
import { remember, remembered } from "./memory";
import { Language, LANGUAGES, named, setLanguage, t, type Word } from "./words";

const NOTICE_MS = 6000;
const THEMES = ["night", "day", "sunlight"] as const;

function LogIn({ onSession }: { onSession: (session: Session) => void }) {
  const [problem, setProblem] = useState("");
  const submit = async (event: Event) => {
    event.preventDefault();
    const form = new FormData(event.currentTarget as HTMLFormElement);
    const response = await fetch("/api/session", {
      method: "POST",
      headers: { "Content-Type": "application/json" },
      body: JSON.stringify({ name: form.get("name"), password: form.get("password") }),
    }).catch(() => null);
    if (!response) return setProblem(t("link_lost"));
    const said = await response.json();
    if (response.ok) onSession({ open: false, ...said });
    else setProblem(said.error);
  };
  return (
    <main class="log-in">
      <form onSubmit={submit}>
        <h1>{t("title")}</h1>
        <label>
          {t("name")}
          <input name="name" autocomplete="username" required autofocus />
        </label>
        <label>
          {t("password")}
          <input name="password" type="password" autocomplete="current-password" required />
        </label>
        <button class="primary">{t("log_in")}</button>
        <p role="alert">{problem}</p>
      </form>
    </main>
  );
}

type Notice = { text: string; isBad: boolean; ofStop?: boolean };

function Bar({ link, session, theme, onTheme, language, onLanguage, onStop, onLogOut, onUsers }: any) {
  const stations = [...link.site.stations.values()];
  const heard = stations.filter((s: any) => !s.stale).length;
  const alarms = stations.reduce((sum: number, s: any) => sum + (s.alarms?.length ?? 0), 0) + (link.site.fusion?.alarms?.length ?? 0);
  const fusion = link.site.fusion && !link.site.fusion.stale;
  return (
    <header class="bar">
      <h1>OLS</h1>
      <ul class="chips">
        <li class={heard === stations.length && heard > 0 ? "good" : "bad"}>
          {t("stations")} <b>{`${heard}/${stations.length}`}</b>
        </li>
        <li class={fusion ? "good" : "bad"}>
          {t("fusion")} <b>{fusion ? t("ok") : t("silent")}</b>
        </li>
        <li class="plain">
          {t("targets")} <b>{[...link.site.targets.values()].filter((x: any) => !x.stale).length}</b>
        </li>
        {alarms > 0 && (
          <li class="bad">
            {t("alarm")} <b>{alarms}</b>
          </li>
        )}
      </ul>
      <span class="gap" />
      <time class="utc">{link.isUp ? utc(link.now_us()) : "--:--:--"} UTC</time>
      <div class="settings">
        <select aria-label={t("theme")} value={theme} onChange={(e: any) => onTheme(e.currentTarget.value)}>
          {THEMES.map((one) => (
            <option value={one}>{t(one)}</option>
          ))}
        </select>
        <select aria-label={t("language")} value={language} onChange={(e: any) => onLanguage(e.currentTarget.value)}>
          {LANGUAGES.map((one) => (
            <option value={one}>{one.toUpperCase()}</option>
          ))}
        </select>
        {session.open ? (
          <span class="user" title={t("local_user")}>
            {t(`r_${session.role}` as Word)}
          </span>
        ) : (
          <Fragment>
            <span class="user">
              {session.name} · {t(`r_${session.role}` as Word)}
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
        )}
      </div>
      {link.replay ? (
        <strong class="replay-tag">{t("replay")}</strong>
      ) : (
        <button type="button" class="stop-all" onClick={onStop} aria-keyshortcuts="Escape">
          {t("stop_all")} <kbd>Esc</kbd>
        </button>
      )}
    </header>
  );
}

function Console({ session, onLoggedOut, theme, onTheme, language, onLanguage }: any) {
  const [version, setVersion] = useState(0);
  const [station, setStation] = useState("");
  const [target, setTarget] = useState("");
  const [notice, setNotice] = useState<Notice | null>(null);
  const [isUsersOpen, setUsersOpen] = useState(false);
  const asked = useRef(new Map<number, string>());
  const link = useMemo(() => new Link(), []);
  const mayCommand = session.role !== "viewer" && !link.replay;

  const say = (text: string, isBad = false) => setNotice({ text, isBad });
  const sayOfStop = (text: string, isBad: boolean) => setNotice({ text, isBad, ofStop: true });
  // What was given before a stop is answered after it: that does not cover what is said of the stop.
  const sayLate = (text: string, isBad: boolean) => setNotice((now) => (now?.ofStop ? now : { text, isBad }));
  useEffect(() => {
    if (!notice) return;
    const timer = setTimeout(() => setNotice(null), NOTICE_MS);
    return () => clearTimeout(timer);
  }, [notice]);

  const wait = (number: number, words: string) => {
    if (!number) return say(`${words}: ${t("not_sent")}`, true);
    asked.current.set(number, words);
    say(`${words}: ${t("sent")} …`);
  };
  const order = (message: object, words: string) => wait(link.order(message), words);
  const command = (station: string, what: string, more: object) => order({ do: "command", command: what, station, ...more }, `${station} ${named("o", what)}`);
  const stopAll = async () => {
    if (link.replay) return say(t("replay_no_stop"), true);
    asked.current.clear();
    const answer = await link.stopAll();
    if (!answer) return sayOfStop(t("stop_failed"), true);
    if (answer === "log_in") return sayOfStop(t("stop_log_in"), true);
    const { stopping, problem } = answer;
    if (problem) return sayOfStop(`${problem}: ${t("stop_by_hand")}`, true);
    sayOfStop(stopping.length ? t("stopping") + stopping.join(", ") : t("stop_none"), stopping.length === 0);
  };
  useEffect(() => {
    let waiting = false;
    link.onChange = () => {
      if (waiting) return;
      waiting = true;
      requestAnimationFrame(() => {
        waiting = false;
        setVersion((n) => n + 1);
      });
    };
    link.onAnswer = (answer: Answer) => {
      const words = asked.current.get(answer.number);
      asked.current.delete(answer.number);
      const tell = words ? say : sayLate;
      tell(`${words ?? answer.station}: ${answer.accepted ? t("done") : answer.why}`, !answer.accepted);
    };
    link.onUnconfirmed = (stations) => sayOfStop(`${t("stop_unconfirmed")} ${stations.join(", ")}: ${t("stop_by_hand")}`, true);
    link.onLoggedOut = onLoggedOut;
    link.start();
    return () => link.end();
  }, []);
  useEffect(() => {
    const key = (event: KeyboardEvent) => {
      if (event.key === "Escape" && !event.repeat) void stopAll();
    };
    window.addEventListener("keydown", key, { capture: true });
    return () => window.removeEventListener("keydown", key, { capture: true });
  });
  const pick = (what: string) => (what.startsWith("station:") ? setStation(what.slice(8)) : setTarget(what));
  return (
    <div class={`console ${link.replay ? "of-replay" : ""}`}>
      <Bar link={link} session={session} theme={theme} onTheme={onTheme} language={language} onLanguage={onLanguage} onStop={stopAll} onLogOut={onLoggedOut} onUsers={() => setUsersOpen(true)} />
      <AlarmSpoken link={link} />
      {!link.isUp && <p class="lost" role="alert">{t("link_lost")}</p>}
      {link.replay && <ReplayBar link={link} />}
      {isUsersOpen && <Users self={session.name} onClose={() => setUsersOpen(false)} />}
      <main class="views">
        <MapView link={link} version={version} theme={theme} selected={target || `station:${station}`} onPick={pick} />
        <div class="side">
          <Procedures
            link={link}
            mayCommand={mayCommand}
            onAnswer={(answer) => order({ do: "answer", ...answer }, `${answer.station} ${named("c", answer.choice)}`)}
          />
          <VideoView
            link={link}
            version={version}
            selected={station}
            mayCommand={mayCommand}
            onSelect={setStation}
            onPoint={(id, what, frame_utime_us, point_px) => command(id, what, { frame_utime_us, point_px })}
            onDesignate={(id, frame_utime_us, box_px) => command(id, "designate", { frame_utime_us, box_px })}
          />
          <Stations
            link={link}
            selected={station}
            mayCommand={mayCommand}
            onSelect={setStation}
            onCommand={(id, what, more) => command(id, what, more ?? {})}
            onControl={(id, take) => order({ do: take ? "take" : "give_up", station: id }, `${id} ${t(take ? "take" : "give_up")}`)}
          />
        </div>
        <Targets
          link={link}
          selected={target}
          mayCommand={mayCommand}
          onSelect={(what) => setTarget(what === target ? "" : what)}
          onCue={(cue, allow) => order({ do: "cue", cue, allow }, `${cue} ${t(allow ? "cue_allow" : "cue_forbid")}`)}
        />
        <History link={link} />
      </main>
      <output class={`notice ${notice ? "shown" : ""} ${notice?.isBad ? "bad" : ""}`} aria-live="polite">
        {notice?.text}
      </output>
    </div>
  );
}

function Page() {
  const [session, setSession] = useState<Session | null | undefined>(undefined);
  const [theme, setTheme] = useState(remembered("theme", matchMedia("(prefers-color-scheme: light)").matches ? "day" : "night"));
  const [language, setTheLanguage] = useState<Language>(remembered("language", navigator.language.startsWith("de") ? "de" : "en") as Language);
  setLanguage(LANGUAGES.includes(language) ? language : "en");
  document.documentElement.dataset.theme = theme;
  useEffect(() => {
    void fetch("/api/session")
      .then((response) => (response.ok ? response.json() : null))
      .then(setSession)
      .catch(() => setSession(null));
  }, []);
  const logOut = async () => {
    await fetch("/api/session", { method: "DELETE" }).catch(() => null);
    setSession(null);
  };
  if (session === undefined) return null;
  if (session === null) return <LogIn onSession={setSession} />;
  return (
    <Console
      session={session}
      onLoggedOut={logOut}
      theme={theme}
      onTheme={(wanted: string) => {
        remember("theme", wanted);
        setTheme(wanted);
      }}
      language={language}
      onLanguage={(wanted: Language) => {
        remember("language", wanted);
        setTheLanguage(wanted);
      }}
    />
  );
}

render(<Page />, document.getElementById("page")!);
