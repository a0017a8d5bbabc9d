// The operator's orders, and what is said of each: that it was sent, and what came of it.

import type { Answer, Link } from "./link";
import type { Notices } from "./notice";
import type { ProcedureAnswer } from "./procedure";
import { named, t } from "./words";

export class Orders {
  private asked = new Map<number, string>(); // in which words, until it is answered

  constructor(
    private link: Link,
    private notices: Notices,
  ) {}

  command(station: string, what: string, more: object = {}) {
    this.give({ do: "command", command: what, station, ...more }, `${station} ${named("o", what)}`);
  }

  control(station: string, take: boolean) {
    this.give({ do: take ? "take" : "give_up", station }, `${station} ${t(take ? "take" : "give_up")}`);
  }

  cue(cue: string, allow: boolean) {
    this.give({ do: "cue", cue, allow }, `${cue} ${t(allow ? "cue_allow" : "cue_forbid")}`);
  }

  // Of a procedure's question.
  answer(answer: ProcedureAnswer) {
    this.give({ do: "answer", ...answer }, `${answer.station} ${named("c", answer.choice)}`);
  }

  async stopAll() {
    const { link, notices } = this;
    if (link.replay) return notices.say(t("replay_no_stop"), true);
    this.asked.clear();
    const answer = await link.stopAll();
    if (!answer) return notices.sayOfStop(t("stop_failed"), true);
    if (answer === "log_in") return notices.sayOfStop(t("stop_log_in"), true);
    const { stopping, problem } = answer;
    if (problem) return notices.sayOfStop(`${problem}: ${t("stop_by_hand")}`, true);
    notices.sayOfStop(stopping.length ? t("stopping") + stopping.join(", ") : t("stop_none"), stopping.length === 0);
  }

  answered(answer: Answer) {
    const words = this.asked.get(answer.number);
    this.asked.delete(answer.number);
    const tell = words ? this.notices.say : this.notices.sayLate;
    tell(`${words ?? answer.station}: ${answer.accepted ? t("done") : answer.why}`, !answer.accepted);
  }

  // By these stations, of a stop of all.
  unconfirmed(stations: string[]) {
    this.notices.sayOfStop(`${t("stop_unconfirmed")} ${stations.join(", ")}: ${t("stop_by_hand")}`, true);
  }

  private give(message: object, words: string) {
    const number = this.link.order(message);
    if (!number) return this.notices.say(`${words}: ${t("not_sent")}`, true);
    this.asked.set(number, words);
    this.notices.say(`${words}: ${t("sent")} …`, false);
  }
}
