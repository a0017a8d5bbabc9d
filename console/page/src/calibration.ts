// Whether a station is calibrated, since when and how well, as people read it.

import { fixed, utc } from "./format";
import type { StationCalibration } from "./site";
import { named, t } from "./words";

export function calibrationText(calibration?: StationCalibration): string {
  const state = named("v", calibration?.state ?? "none");
  if (!calibration || calibration.state === "none" || calibration.state === "refused") return state;
  const since = calibration.utime_us ? `, ${t("calibrated_at")} ${utc(calibration.utime_us, true)} UTC` : "";
  const arcsec = calibration.sd_deg == null ? null : 3600 * calibration.sd_deg;
  return `${state} (${calibration.id})${since}, ±${fixed(arcsec, 1, "″")}`;
}
