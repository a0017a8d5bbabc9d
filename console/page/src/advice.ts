// What an alarm means and what to do: the tables of docs/troubleshooting.md, brought in by the build.

import tables from "advice.json";

export type Advice = { meaning: string; action: string };
type Row = { alarms: string[]; meaning: string; action: string };

// "camera: no frames for … s" -> what the program can print.
function pattern(alarm: string): RegExp {
  const parts = alarm.split("…").map((part) => part.replace(/[.*+?^${}()|[\]\\]/g, "\\$&"));
  return new RegExp(`^${parts.join(".*")}`);
}

const ROWS = (tables as Row[]).flatMap((row) => row.alarms.map((alarm) => ({ alarm: pattern(alarm), length: alarm.length, advice: { meaning: row.meaning, action: row.action } })));
ROWS.sort((a, b) => b.length - a.length);

export function adviceFor(alarm: string): Advice | null {
  return ROWS.find((row) => row.alarm.test(alarm))?.advice ?? null;
}
