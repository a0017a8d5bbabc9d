// How high the ground is under the map's cursor. One question at a time: the next one is about where the cursor is
// by then.

import { askLand } from "./land";
import { length } from "./measures";
import { t } from "./words";

export type Ground = { ground_m: number | null; top_m: number | null; sd_m: number | null };

// "Ground 412 m ± 4 m, top 430 m"; what stands there only where something does.
export function groundText({ ground_m, top_m, sd_m }: Ground): string {
  if (ground_m == null) return t("land_unknown");
  const top = top_m != null && top_m > ground_m + 0.5 ? `, ${t("land_top")} ${length(top_m)}` : "";
  return `${t("ground")} ${length(ground_m)} ± ${length(sd_m)}${top}`;
}

export class GroundProbe {
  private wanted = ""; // "LATITUDE,LONGITUDE"; empty: nowhere
  private isAsking = false;

  constructor(private onText: (text: string) => void) {}

  at(latitude_deg: number, longitude_deg: number) {
    this.wanted = `${latitude_deg.toFixed(6)},${longitude_deg.toFixed(6)}`;
    if (!this.isAsking) void this.ask();
  }

  leave() {
    this.wanted = "";
    this.onText("");
  }

  private async ask() {
    this.isAsking = true;
    for (let asked = ""; this.wanted && this.wanted !== asked; ) {
      asked = this.wanted;
      const ground = await askLand<Ground>(`/ground?at=${asked}`);
      if (this.wanted) this.onText(ground && "ground_m" in ground ? groundText(ground) : "");
    }
    this.isAsking = false;
  }
}
