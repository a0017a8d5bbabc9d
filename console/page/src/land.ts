// The imported land around the site, as the console tells of it (docs/console.md): which land it is, and questions
// about it.

import { useEffect, useState } from "preact/hooks";
import type { HttpAnswer } from "./conditions";
import type { Link } from "./link";

export type Land = { version: string; latitude_deg: number; longitude_deg: number; radius_km: number };

export async function askLand<T>(path: string): Promise<(T & HttpAnswer) | null> {
  const response = await fetch(`/api/land${path}`).catch(() => null);
  return response ? response.json().catch(() => null) : null;
}

// Null while there is none. A console that was restarted may have another.
export function useLand(link: Link): Land | null {
  const [land, setLand] = useState<Land | null>(null);
  useEffect(() => {
    if (!link.isUp) return;
    void askLand<Land>("").then((found) => setLand((before) => (found?.version === before?.version ? before : found?.version ? found : null)));
  }, [link.isUp]);
  return land;
}
