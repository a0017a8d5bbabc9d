// Numbers as people read and write them.

export const DASH = "–";

// What is rounded to zero has no sign.
export function fixed(value: number | null | undefined, decimals: number, unit = ""): string {
  return value == null || !isFinite(value) ? DASH : value.toFixed(decimals).replace(/^-(?=[0.]+$)/, "") + unit;
}

// Of "1000 mm".
export const inMetres = (mm: string) => `${parseFloat(mm) / 1000} m`;

// Of a line of the grid, in kilometres, with as many digits as tell it from the next.
export function gridName(at_m: number, step_m: number): string {
  return (at_m / 1000).toFixed(Math.max(0, 3 - Math.floor(Math.log10(step_m) + 1e-9)));
}

// From 000° to less than 360°, also once it is rounded.
export function bearing(deg: number | null | undefined, decimals = 1): string {
  if (deg == null || !isFinite(deg)) return DASH;
  const rounded = Number((((deg % 360) + 360) % 360).toFixed(decimals)) % 360;
  return `${rounded.toFixed(decimals).padStart(decimals ? 4 + decimals : 3, "0")}°`;
}

export function utc(utime_us: number, withDate = false): string {
  const iso = new Date(utime_us / 1000).toISOString();
  return withDate ? iso.slice(0, 19).replace("T", " ") : iso.slice(11, 19);
}

// Of a minute of the day: "22:30".
export const localTime = (minute: number) => `${String(Math.floor(minute / 60)).padStart(2, "0")}:${String(minute % 60).padStart(2, "0")}`;

// "3 d", "5 h", "12 min".
export function age(s: number): string {
  if (s >= 2 * 86400) return `${(s / 86400).toFixed(0)} d`;
  return s >= 2 * 3600 ? `${(s / 3600).toFixed(0)} h` : `${(s / 60).toFixed(0)} min`;
}

export function clockError(s: number | null): string {
  if (s == null) return DASH;
  if (s < 1e-3) return `±${(s * 1e6).toFixed(0)} µs`;
  return s < 1 ? `±${(s * 1e3).toFixed(1)} ms` : `±${s.toFixed(1)} s`;
}

// "33U XQ 16432 51958".
export function spacedMgrs(name: string | undefined): string {
  const parts = /^(.*?[A-Z])([A-Z]{2})(\d*)$/.exec(name ?? "");
  if (!parts) return DASH;
  const half = parts[3].length / 2;
  return [parts[1], parts[2], parts[3].slice(0, half), parts[3].slice(half)].join(" ").trim();
}

// What a person wrote; null: not a number.
export function numberOf(text: string): number | null {
  return isFinite(Number(text)) && text.trim() !== "" ? Number(text) : null;
}
