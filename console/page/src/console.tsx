// The console of whoever is logged in: the bar, the views, and the connection that they share.

import { h } from "preact";
import { useEffect, useMemo, useState } from "preact/hooks";
import { AlarmSpoken } from "./alarms";
import { AreaPanel } from "./areapanel";
import { useArrangement, type Arrangement } from "./arrangement";
import { Bar, type Look } from "./bar";
import { stopped } from "./byhand";
import { useEscapeKey } from "./escape";
import { History } from "./history";
import { Incidents } from "./incidents";
import { Link, type Session } from "./link";
import { localTime } from "./format";
import { MapView } from "./map";
import { Notice, useNotice } from "./notice";
import { Orders } from "./orders";
import type { Place } from "./panel";
import { PlacePanel, placeOf } from "./placepanel";
import { Procedures } from "./procedure";
import { ReplayBar } from "./replay";
import type { Area, Corner } from "./site";
import { seenBy } from "./site";
import { Stations } from "./stations";
import { TargetPanel } from "./targetpanel";
import { Targets } from "./targets";
import { Users } from "./users";
import { VideoView } from "./video";
import { t } from "./words";

// The link runs from the first to the last rendering. Returns a number that grows with its news, at
// most once a frame.
function useNews(link: Link, orders: Orders, onLoggedOut: () => void): number {
  const [version, setVersion] = useState(0);
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
    link.onAnswer = (answer) => orders.answered(answer);
    link.onHand = (hand) => orders.hand(hand);
    link.onUnconfirmed = (stations) => orders.unconfirmed(stations);
    link.onLoggedOut = onLoggedOut;
    link.start();
    return () => link.end();
  }, []);
  return version;
}

type SideProps = { link: Link; version: number; station: string; mayCommand: boolean; orders: Orders; arrangement: Arrangement; onSelect: (station: string) => void };

// The stations, in pictures and in words.
function Side({ link, version, station, mayCommand, orders, arrangement, onSelect }: SideProps) {
  return (
    <div class="side">
      <div class="watch">
        <Procedures link={link} mayCommand={mayCommand} onAnswer={(answer) => orders.answer(answer)} />
        <VideoView
          link={link}
          version={version}
          selected={station}
          mayCommand={mayCommand}
          arrangement={arrangement}
          onSelect={onSelect}
          onPoint={(id, what, frame_utime_us, point_px) => orders.command(id, what, { frame_utime_us, point_px })}
          onDesignate={(id, frame_utime_us, box_px) => orders.command(id, "designate", { frame_utime_us, box_px })}
          onWithheld={(id) => orders.withheld(id)}
          onRelease={(id) => orders.command(id, "release")}
        />
      </div>
      <Stations
        link={link}
        selected={station}
        mayCommand={mayCommand}
        onSelect={onSelect}
        onCommand={(id, what, more) => orders.command(id, what, more)}
        onControl={(id, take) => orders.control(id, take)}
        onAcknowledge={mayCommand ? (event) => orders.acknowledge(event) : null}
      />
    </div>
  );
}

type OnDraft = (area: Area | null) => void;
type PanelProps = { link: Link; station: string; selected: string; draft: Area | null; mayCommand: boolean; orders: Orders; onDraft: OnDraft; onClose: () => void };

// On the map: the area that is being drawn, or what is known of the selected target or place.
function Panel({ link, station, selected, draft, mayCommand, orders, onDraft, onClose }: PanelProps) {
  if (draft) return <AreaPanel area={draft} local={localTime(link.localMinute)} onChange={onDraft} onSave={(area) => orders.setArea(area, () => onDraft(null))} onClose={() => onDraft(null)} />;
  const target = link.site.targets.get(selected.replace("target:", ""));
  const rest = { link, station, mayCommand, onPoint: (id: string, place: Place) => orders.command(id, "point", place), onClose };
  if (target) return <TargetPanel key={selected} target={target} onName={(name) => orders.nameTarget(target.id, name)} onCue={(cue, allow) => orders.cue(cue, allow)} {...rest} />;
  return placeOf(selected) && <PlacePanel key={selected} selected={selected} {...rest} />;
}

type OpenedProps = { what: string; link: Link; session: Session; mayCommand: boolean; orders: Orders; onDraft: OnDraft; onClose: () => void };

// Below the bar.
function Opened({ what, link, session, mayCommand, orders, onDraft, onClose }: OpenedProps) {
  if (what === "users") return <Users self={session.name} onClose={onClose} />;
  if (what !== "incidents") return null;
  const edit = (area: Area) => {
    onDraft(area);
    onClose();
  };
  return (
    <Incidents
      link={link}
      onJudge={mayCommand ? (incident, verdict) => orders.judge(incident, verdict) : null}
      onEdit={mayCommand ? edit : null}
      onRemove={(name) => orders.removeArea(name)}
      onClose={onClose}
    />
  );
}

type Props = { session: Session; look: Look; onLoggedOut: () => void };

export function Console({ session, look, onLoggedOut }: Props) {
  const [station, setStation] = useState("");
  const [target, setTarget] = useState("");
  const [opened, setOpened] = useState(""); // users, incidents
  const [draft, setDraft] = useState<Area | null>(null); // of an area
  const arrangement = useArrangement();
  const [notice, notices] = useNotice();
  const link = useMemo(() => new Link(), []);
  const orders = useMemo(() => new Orders(link, notices), []);
  const version = useNews(link, orders, onLoggedOut);
  const stopAll = () => void orders.stopAll();
  useEscapeKey(stopAll, (isAll) => notices.say(t(isAll && !link.replay ? "escape_closed" : "closed"), false));
  const mayCommand = session.role !== "viewer" && !link.replay;
  const pick = (what: string) => {
    if (what.startsWith("station:")) return setStation(what.slice(8));
    if (!what.startsWith("sight:")) return setTarget(what);
    // A station's line of sight: what it sees there.
    setStation(what.slice(6));
    const seen = seenBy(link.site, what.slice(6));
    if (seen) setTarget(`target:${seen.id}`);
  };
  const addCorner = (corner: Corner) => setDraft((area) => area && { ...area, polygon: [...area.polygon, corner] });
  const shared = { link, mayCommand, orders };
  return (
    <div class={`page ${link.replay ? "of-replay" : ""}`}>
      <Bar
        link={link}
        session={session}
        look={look}
        stopped={mayCommand ? stopped(link.site) : []}
        onStop={stopAll}
        onRelease={(stations) => orders.releaseAll(stations)}
        onLogOut={onLoggedOut}
        onUsers={() => setOpened("users")}
        onIncidents={() => setOpened(opened === "incidents" ? "" : "incidents")}
      >
        <Opened what={opened} session={session} onDraft={setDraft} onClose={() => setOpened("")} {...shared} />
      </Bar>
      <AlarmSpoken link={link} />
      {!link.isUp && <p class="link-lost" role="alert">{t("link_lost")}</p>}
      {link.replay && <ReplayBar link={link} />}
      <main class={`views ${arrangement.isAlone ? "alone" : arrangement.large}`}>
        <MapView link={link} version={version} theme={look.theme} selected={target || `station:${station}`} draft={draft?.polygon ?? null} onPick={pick} onCorner={addCorner} />
        <Panel station={station} selected={target} draft={draft} onDraft={setDraft} onClose={() => setTarget("")} {...shared} />
        <Side version={version} station={station} {...shared} arrangement={arrangement} onSelect={setStation} />
        <Targets
          link={link}
          selected={target}
          mayCommand={mayCommand}
          onSelect={(what) => setTarget(what === target ? "" : what)}
          onCue={(cue, allow) => orders.cue(cue, allow)}
          onHandover={(mode) => orders.handover(mode)}
        />
        <History link={link} onAcknowledge={mayCommand ? (event) => orders.acknowledge(event) : null} />
      </main>
      <Notice notice={notice} />
    </div>
  );
}
