// The operator's orders, and what is said of each: that it was sent, and what came of it.

import { conditionInWords, inWords, textOfEvent } from "./conditions";
import type { Answer, Hand, Link } from "./link";
import type { Notices } from "./notice";
import type { ProcedureAnswer } from "./procedure";
import type { Area, HandoverMode, Incident, SiteEvent } from "./site";
import { named, t } from "./words";

// Of all stopped stations, while it is under way.
type Release = { waits: Set<number>; done: string[]; refused: string[] };

export class Orders {
  private asked = new Map<number, string>(); // in which words, until it is answered
  private afterwards = new Map<number, () => void>(); // what follows if it is done
  private release: Release | null = null;

  constructor(
    private link: Link,
    private notices: Notices,
  ) {}

  command(station: string, what: string, more: object = {}) {
    this.give({ do: "command", command: what, station, ...more }, `${station} ${named("o", what)}`);
  }

  // Each by itself; what came of it is said when the last has answered.
  releaseAll(stations: string[]) {
    const outcome: Release = { waits: new Set(), done: [], refused: [] };
    for (const station of stations) {
      const number = this.link.order({ do: "command", command: "release", station });
      if (!number) return this.notices.say(`${t("release_all")}: ${t("not_sent")}`, true);
      outcome.waits.add(number);
    }
    this.release = outcome;
    this.notices.say(`${t("release_all")}: ${t("sent")} …`, false);
  }

  // A station that is at work was touched.
  withheld(station: string) {
    this.notices.say(`${station} ${t("by_hand_first")}`, true);
  }

  control(station: string, take: boolean) {
    this.give({ do: take ? "take" : "give_up", station }, `${station} ${t(take ? "take" : "give_up")}`);
  }

  cue(cue: string, allow: boolean) {
    this.give({ do: "cue", cue, allow }, `${cue} ${t(allow ? "cue_allow" : "cue_forbid")}`);
  }

  handover(mode: HandoverMode) {
    this.give({ do: "handover", mode }, `${t("handover_mode")}: ${named("ho", mode)}`);
  }

  acknowledge(event: SiteEvent) {
    this.change({ do: "acknowledge", event: event.number }, `${event.station} ${textOfEvent(event)}: ${t("acknowledge")}`);
  }

  // It may come late, and only its outcome is said.
  private change(message: object, words: string): number {
    const number = this.link.send(message);
    if (number) this.asked.set(number, words);
    else this.notices.say(`${words}: ${t("not_sent")}`, true);
    return number;
  }

  nameTarget(target: string, name: string) {
    this.give({ do: "name", target, name }, `${t("target")} ${target}: ${name || target}`);
  }

  // Without an id, which the server gives it.
  setArea({ name, polygon, lowest_m, highest_m, classes, from, to }: Area, afterwards: () => void) {
    const number = this.change({ do: "area", area: { name, polygon, lowest_m, highest_m, classes, from, to } }, `${t("area")} ${name}`);
    this.afterwards.set(number, afterwards);
  }

  removeArea(name: string) {
    this.change({ do: "remove_area", name }, `${t("area")} ${name}: ${t("remove")}`);
  }

  judge({ number, verdict: before }: Incident, verdict: Incident["verdict"]) {
    if (verdict !== before) this.change({ do: "judge", incident: number, verdict }, `${t("incident")} ${number}: ${named("i", verdict)}`);
  }

  // Of a procedure's question.
  answer(answer: ProcedureAnswer) {
    this.give({ do: "answer", ...answer }, `${answer.station} ${named("c", answer.choice)}`);
  }

  async stopAll() {
    const { link, notices } = this;
    if (link.replay) return notices.say(t("replay_no_stop"), true);
    this.asked.clear();
    this.release = null;
    const answer = await link.stopAll();
    if (!answer) return notices.sayOfStop(t("stop_failed"), true);
    if (answer === "log_in") return notices.sayOfStop(t("stop_log_in"), true);
    const { stopping, refusal } = answer;
    if (refusal) return notices.sayOfStop(`${conditionInWords(refusal)}: ${t("stop_by_hand")}`, true);
    notices.sayOfStop(stopping.length ? t("stopping") + stopping.join(", ") : t("stop_none"), stopping.length === 0);
  }

  answered(answer: Answer) {
    if (this.release?.waits.delete(answer.number)) return this.released(this.release, answer);
    const words = this.asked.get(answer.number);
    this.asked.delete(answer.number);
    if (answer.accepted) this.afterwards.get(answer.number)?.();
    this.afterwards.delete(answer.number);
    const tell = words ? this.notices.say : this.notices.sayLate;
    tell(`${words ?? answer.station}: ${answer.refusal ? conditionInWords(answer.refusal) : t("done")}`, !answer.accepted);
  }

  private released({ waits, done, refused }: Release, { station, refusal }: Answer) {
    if (refusal) refused.push(`${station}: ${conditionInWords(refusal)}`);
    else done.push(station);
    if (waits.size > 0) return;
    this.release = null;
    const words = [...(done.length ? [`${t("released")}: ${done.sort().join(", ")}`] : []), ...refused.sort()];
    this.notices.say(words.join("; "), refused.length > 0);
  }

  // By these stations, of a stop of all.
  unconfirmed(stations: string[]) {
    this.notices.sayOfStop(`${t("stop_unconfirmed")} ${stations.join(", ")}: ${t("stop_by_hand")}`, true);
  }

  // What another has done to stations that are in this browser's hand.
  hand({ what, by, stations }: Hand) {
    const who = by ? inWords(by) : t("hand_other");
    this.notices.sayOfStop(`${who} ${t(what === "stop" ? "hand_stop" : "hand_take")} ${stations.join(", ")}`, true);
  }

  private give(message: object, words: string) {
    const number = this.link.order(message);
    if (!number) return this.notices.say(`${words}: ${t("not_sent")}`, true);
    this.asked.set(number, words);
    this.notices.say(`${words}: ${t("sent")} …`, false);
  }
}
