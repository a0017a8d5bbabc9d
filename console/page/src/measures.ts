// In which units lengths and speeds are shown, and how positions are written: a person's choice, which a
// browser remembers.

import { DASH, fixed, spacedMgrs } from "./format";
import { remember, remembered } from "./memory";
import { t } from "./words";

export const UNITS = ["m_s", "km_h", "nautical"] as const;
export const POSITIONS = ["degrees", "minutes", "seconds", "mgrs"] as const;
export type Units = (typeof UNITS)[number];
export type PositionFormat = (typeof POSITIONS)[number];

const FOOT_M = 0.3048;
const MILE_M = 1852;

const choiceOf = <T extends string>(known: readonly T[], key: string): T => known.find((one) => one === remembered(key, "")) ?? known[0];
export const measures = { units: choiceOf(UNITS, "units"), position: choiceOf(POSITIONS, "position") };

export function setUnits(units: Units) {
  measures.units = units;
  remember("units", units);
}

export function setPositionFormat(position: PositionFormat) {
  measures.position = position;
  remember("position", position);
}

type Known = number | null | undefined;
const times = (value: Known, factor: number) => (value == null ? value : value * factor);

// Of a height or an uncertainty.
export function length(m: Known, decimals = 0): string {
  return measures.units === "nautical" ? fixed(times(m, 1 / FOOT_M), Math.max(0, decimals - 1), " ft") : fixed(m, decimals, " m");
}

export function speed(m_s: Known, decimals = 0): string {
  if (measures.units === "nautical") return fixed(times(m_s, 3600 / MILE_M), decimals, " kn");
  return measures.units === "km_h" ? fixed(times(m_s, 3.6), decimals, " km/h") : fixed(m_s, decimals, " m/s");
}

// Of a vertical speed: "sinking 1.2 m/s". Level is what would be written as zero.
export function climb(up_m_s: Known): string {
  if (up_m_s == null || !isFinite(up_m_s)) return DASH;
  const written = speed(Math.abs(up_m_s), 1);
  if (written === speed(0, 1)) return t("level");
  return `${t(up_m_s > 0 ? "climbing" : "sinking")} ${written}`;
}

// In which unit rings and grids of about this step are round, and its name.
function unitOf(step_m: number): [unit_m: number, name: string] {
  if (measures.units === "nautical") return step_m < MILE_M ? [FOOT_M, "ft"] : [MILE_M, "NM"];
  return step_m < 1000 ? [1, "m"] : [1000, "km"];
}

// At least so long [m], and 1, 2 or 5 times a power of ten in the chosen unit. Between 5000 ft and a mile there is none.
export function roundStep(least_m: number): number {
  const [unit_m] = unitOf(measures.units === "nautical" && least_m > 5000 * FOOT_M ? Math.max(least_m, MILE_M) : least_m);
  const least = Math.max(least_m, 1) / unit_m;
  const power = 10 ** Math.floor(Math.log10(least));
  return unit_m * [1, 2, 5, 10].map((part) => part * power).find((step) => step >= least * (1 - 1e-9))!;
}

// Of the n-th ring, in the unit of the first.
export function ringName(step_m: number, n: number): string {
  const [unit_m, name] = unitOf(step_m * (1 + 1e-9));
  return `${Number(((n * step_m) / unit_m).toPrecision(6))} ${name}`;
}

export function distance(m: number): string {
  if (measures.units === "nautical") return m < MILE_M ? `${(m / FOOT_M).toFixed(0)} ft` : `${(m / MILE_M).toFixed(m < 10 * MILE_M ? 2 : 1)} NM`;
  return m < 1000 ? `${m.toFixed(m < 10 ? 1 : 0)} m` : `${(m / 1000).toFixed(m < 10_000 ? 2 : 1)} km`;
}

// "49°13.5654'N" or "49°13'33.92\"N": each about a decimetre. Rounded first, so that no 60 is written.
function sexagesimal(deg: number, sides: string, hasSeconds: boolean): string {
  const parts = hasSeconds ? 3600 * 100 : 60 * 1e4; // the least that is written, of a degree
  const all = Math.round(Math.abs(deg) * parts);
  const side = sides[deg < 0 ? 1 : 0];
  const whole = Math.floor(all / parts);
  const rest = all % parts;
  if (!hasSeconds) return `${whole}°${(rest / 1e4).toFixed(4).padStart(7, "0")}'${side}`;
  return `${whole}°${String(Math.floor(rest / 6000)).padStart(2, "0")}'${((rest % 6000) / 100).toFixed(2).padStart(5, "0")}"${side}`;
}

type Place = { latitude_deg: Known; longitude_deg: Known; mgrs?: string };

// In the chosen format.
export function position({ latitude_deg, longitude_deg, mgrs }: Place, format = measures.position, decimals = 6): string {
  if (format === "mgrs") return spacedMgrs(mgrs);
  if (latitude_deg == null || longitude_deg == null) return DASH;
  if (format === "degrees") return `${fixed(latitude_deg, decimals)}° ${fixed(longitude_deg, decimals)}°`;
  return `${sexagesimal(latitude_deg, "NS", format === "seconds")} ${sexagesimal(longitude_deg, "EW", format === "seconds")}`;
}
