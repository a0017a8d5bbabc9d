// What programs say, in the page's language: how grave an alarm is, what it means, what to do. The words
// come with the build, from conditions/conditions.toml.

import tables from "conditions.json";
import type { Said, SiteEvent } from "./site";
import { inLanguage, isEnglish, named } from "./words";

const MOST_REMEMBERED = 2000;

export type Severity = "urgent" | "warning" | "notice";
export type Condition = { severity: Severity; meaning: string; action: string };
type Pair = [english: string, german: string];
type Row = { severity: Severity; says: Record<string, Pair>; meaning: Pair; action: Pair };
type Sentence = { english: RegExp; german: string; goesOn: boolean; length: number; begin: number };

// "camera: no frames for … s" -> what the program can print. What it says behind that belongs to it too.
function sentence(english: string, german: string, isAlarm = false): Sentence {
  const parts = english.split("…").map((part) => part.replace(/[.*+?^${}()|[\]\\]/g, "\\$&"));
  const isOpen = english.endsWith("…");
  const pattern = isOpen ? `${parts.slice(0, -1).join("(.*?)")}(.*)` : parts.join("(.*?)") + (isAlarm ? "(.*)" : "");
  return { english: new RegExp(`^${pattern}$`, "s"), german, goesOn: isAlarm && !isOpen, length: english.replace(/…/g, "").length, begin: parts[0].length };
}

type Dictionary = Record<string, string>;
type Tables = { alarms: Row[] } & Record<"reasons" | "outcomes" | "notes", Record<string, Pair>> & Record<"phrases" | "words" | "names", Dictionary>;
const { alarms, reasons, outcomes, notes, phrases, words, names } = tables as Tables;
const sentences = (of: Dictionary) => Object.entries(of).map(([english, german]) => sentence(english, german));
const ROWS = new Map(alarms.flatMap((row) => Object.keys(row.says).map((id) => [id, row])));
const open = (says: string) => says.replace(/\{\w+\}/g, "…");
const SENTENCES = [...alarms.flatMap((row) => Object.values(row.says).map(([english, german]) => sentence(open(english), open(german), true))), ...sentences(phrases)];
const NAMES = sentences(names);
for (const list of [SENTENCES, NAMES]) list.sort((a, b) => b.length - a.length || b.begin - a.begin);

export function conditionOf(id: string): Condition {
  const row = ROWS.get(id);
  if (!row) return { severity: "warning", meaning: "", action: "" };
  return { severity: row.severity, meaning: inLanguage(row.meaning), action: inLanguage(row.action) };
}

// What stands for "…" is translated by `partOf`.
function germanBy(list: Sentence[], text: string, partOf: (part: string) => string): string {
  const known = list.find((one) => one.english.test(text));
  if (!known) return text;
  const said = known.english.exec(text)!.slice(1);
  const rest = known.goesOn ? said.pop()! : "";
  const parts = said.map(partOf);
  const [first, ...more] = known.german.split("…");
  return first + more.map((after, i) => (parts[i] ?? "") + after).join("") + (rest && germanOf(rest));
}

// A single word is a name or a number, but for a few.
const germanPart = (part: string): string => (/\s/.test(part) ? germanOf(part) : (words[part] ?? part));
// The reason of a refusal as its sentence.
const reasonInWords = (id: string): string => (id in reasons ? inLanguage(reasons[id]) : id);
// Of a parameter. A reason is an id; of distrust there are several: "3 unsigned, 1 replayed".
function valueInWords(name: string, value: string): string {
  if (name === "reason") return reasonInWords(value);
  if (name === "choice") return named("c", value);
  if (name === "reasons") return value.replace(/[a-z_]+/g, (reason) => reasonInWords(`distrusted_${reason}`));
  return isEnglish() ? value : germanPart(value);
}
const germanOf = (text: string): string => germanBy(SENTENCES, text, germanPart);
// A state or an order has the page's own word.
const germanName = (name: string): string => {
  const known = germanBy(NAMES, name, germanName);
  return known === name ? named("s", named("o", name)) : known;
};

// The page is drawn ten times a second, mostly with the same texts.
function remembering(of: (text: string) => string): (text: string) => string {
  const known = new Map<string, string>();
  return (text) => {
    if (!known.has(text)) {
      if (known.size >= MOST_REMEMBERED) known.clear();
      known.set(text, of(text));
    }
    return known.get(text)!;
  };
}

const textInGerman = remembering((text) => text.replace(/\S.*/s, germanOf));
const nameInGerman = remembering(germanName);

// A sentence of a program, in the page's language; with the spaces before it.
export function inWords(text: string): string {
  return isEnglish() || !text ? text : textInGerman(text);
}

// An alarm, why an order is not carried out, or what happened, by its row of the table. Logs from before alarms had ids have its
// sentence only.
export function conditionInWords({ id, text, parameters }: Said): string {
  const says = ROWS.get(id)?.says[id] ?? outcomes[id] ?? notes[id];
  if (!says) return inWords(text);
  const value = (name: string) => valueInWords(name, parameters[name] ?? "");
  const words = inLanguage(says).replace(/\{(\w+)\}/g, (_, name) => value(name));
  return parameters.detail ? `${words}: ${value("detail")}` : words;
}

// Of an answer over HTTP: why it was not done; empty: it was.
export type HttpAnswer = { error?: string; refusal?: Said };
export const problemOf = ({ error, refusal }: HttpAnswer): string => (refusal ? conditionInWords(refusal) : (error ?? ""));

// What a counter counts, or a reading is of.
export function nameInWords(name: string): string {
  return isEnglish() ? name.replaceAll("_", " ") : nameInGerman(name);
}

// The event of a station's alarm that holds; the site's and the fusion's have no station.
export function eventOf(events: SiteEvent[], station: string, key: string): SiteEvent | undefined {
  return events.find((event) => holds(event) && event.station === station && event.key === key);
}

export const alarmOf = (event: SiteEvent): string => event.said?.id ?? "";
export const textOfEvent = (event: { said: Said | null; text: string }): string => (event.said ? conditionInWords(event.said) : inWords(event.text));
export const holds = (event: SiteEvent) => event.kind === "alarm" && event.over_us == null;
