// The drawing of the land below a line of sight, and what it says.

import { distance } from "./measures";
import { t } from "./words";

// Each point: distance [m], then heights [m]: of the ground, of what stands on it, of the line of sight.
type Point = [number, number | null, number | null, number];
export type Profile = { points: Point[]; blocked_m: number | null; known_to_m: number | null };

export const [WIDTH, HEIGHT] = [270, 96]; // [px]

// "blocked at 670 m", "clear, known up to 4.20 km", "clear".
export function profileText({ blocked_m, known_to_m }: Pick<Profile, "blocked_m" | "known_to_m">): string {
  if (blocked_m != null) return `${t("line_blocked")} ${distance(blocked_m)}`;
  return known_to_m != null ? `${t("line_known")} ${distance(known_to_m)}` : t("line_clear");
}

// Outlines in a drawing of this size, y downwards: the ground filled, broken where it is not known.
export function drawn({ points, blocked_m }: Omit<Profile, "known_to_m">) {
  const heights = points.flatMap(([, ground, top, line]) => [ground, top, line].filter((v): v is number => v != null));
  const [lowest, highest] = [Math.min(...heights), Math.max(...heights)];
  const x = (m: number) => (WIDTH * m) / points[points.length - 1][0];
  const y = (m: number) => 4 + (HEIGHT - 10) * (1 - (m - lowest) / Math.max(1, highest - lowest));
  const path = (of: (point: Point) => number | null, isIn = (_: Point) => true) => {
    let text = "";
    let isOn = false;
    for (const point of points) {
      const height_m = isIn(point) ? of(point) : null;
      if (height_m != null) text += `${isOn ? "L" : "M"}${x(point[0]).toFixed(1)} ${y(height_m).toFixed(1)}`;
      isOn = height_m != null;
    }
    return text;
  };
  const end_m = blocked_m ?? Infinity;
  return {
    ground: path((point) => point[1]).replace(/M([\d.]+) ([\d.]+)([^M]*)/g, (part, from) => `${part}V${HEIGHT}H${from}Z`),
    top: path((point) => point[2]),
    seen: path((point) => point[3], (point) => point[0] <= end_m),
    blocked: path((point) => point[3], (point) => point[0] >= end_m),
    lowest,
    highest,
  };
}
