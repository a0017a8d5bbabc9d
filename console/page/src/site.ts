// The site's state as the server sends it (docs/console.md): a snapshot, then the fields that changed.

export type Device = { name: string; state: string; text: string; age_s: number | null };
// Where a unit may not point: directions of the optical axis, once round; the first at its least pan and tilt.
export type Border = { keep_out: boolean; outline: [number, number][] }; // azimuth, elevation [deg]
export type Bearing = { utime_us: number; azimuth_deg: number; elevation_deg: number; sd_deg: number; belief: number };
// A guided procedure: a calibration.
export type Procedure = {
  procedure: string;
  utime_us: number;
  state: string; // running, asking, accepted, kept_old, aborted, failed
  step: string;
  progress: number | null;
  elapsed_s: number | null;
  question: number; // 0: none stands
  lines: string[];
  choices: string[];
  crosshair_px: [number, number] | null; // in the full frame
  full_px: [number, number];
  picture: number; // new with each picture; 0: none
};
export type Station = {
  id: string;
  stale: boolean;
  utime_us: number;
  state: string;
  track_id?: string; // "0": it has not followed anything yet
  belief: number | null;
  hidden_since_utime_us?: number; // 0: its target is not hidden
  hidden_until_utime_us?: number; // 0: not known
  latitude_deg: number | null;
  longitude_deg: number | null;
  height_m: number | null;
  mgrs?: string;
  position_sd_m: (number | null)[];
  position_source: string;
  heading_deg: number | null;
  heading_sd_deg: number | null;
  tilt_x_deg: number | null;
  tilt_y_deg: number | null;
  tilt_sd_deg: number | null;
  tilt_source: string;
  pan_deg: number | null;
  tilt_deg: number | null;
  pan_limits_deg: (number | null)[];
  tilt_limits_deg: (number | null)[];
  borders?: Border[];
  azimuth_deg: number | null;
  elevation_deg: number | null;
  field_of_view_deg: (number | null)[];
  image_px: number[];
  kind?: string; // tracking, overview, fixed
  pan_sign?: number;
  tilt_sign?: number;
  lens?: { zoom: number | null; focus: number | null; iris: number | null; focal_length_px: number | null; focal_length_sd_px: number | null } | null;
  devices: Device[];
  clock: { state: string; error_s: number | null };
  calibration?: StationCalibration;
  frame_latency_s: number | null;
  alarms: Alarm[];
  readings: Record<string, number | null>;
  counters: Record<string, number | null>;
  last_error: string;
  last_error_utime_us: number;
  bearing?: Bearing;
  control?: { by: string; viewer: number } | null;
  procedure?: Procedure;
};
// Of one axis of a direction, 1-sigma; utime_us of the last observation.
export type StationCalibration = { state: string; id: string; utime_us: number | null; sd_deg: number | null };
export type Ellipse = { semi_major_m: number; semi_minor_m: number; azimuth_deg: number };
export type Target = {
  id: string;
  name?: string; // that operators have given it
  stale: boolean;
  utime_us: number;
  state: string;
  solution: string;
  estimator: string;
  latitude_deg: number;
  longitude_deg: number;
  height_m: number;
  height_above_ground_m: number | null;
  height_above_ground_sd_m: number | null;
  mgrs?: string;
  sd_enu_m: (number | null)[];
  covariance_enu_m2?: (number | null)[]; // ee, en, eu, nn, nu, uu
  ellipse95: Ellipse | null;
  velocity_enu_m_s: (number | null)[];
  speed_m_s: number | null;
  course_deg: number | null;
  class: string;
  class_probability: number | null;
  size_m: number | null; // largest extent
  size_sd_m: number | null;
  signal: number | null; // to noise, in one picture
  crossing_angle_deg: number | null;
  residual: number | null;
  stations: { id: string; used: boolean; weight: number | null; age_s: number | null }[];
  hidden?: Hidden | null;
  trail: (TrailPoint | null)[]; // null: it was not seen meanwhile
};
// Longitude, latitude [deg], height [m], and the stations from which the land hid the target there; "*": no other saw it.
export type TrailPoint = [number, number, number, string[]?];
export type Hidden = { from: { id: string; since_us: number; back_us: number }[]; all: boolean }; // back_us 0: not known
export type Line = { id: string; stale: boolean; target: string; azimuth_deg: number; elevation_deg: number; sd_deg: number };
// What others know of a target, or a target that detectors have found (id: its number); stations are led
// there when an operator allows it.
export type Cue = {
  id: string;
  label: string;
  state: "waiting" | "searched" | "found" | "forbidden";
  target: string;
  age_s: number | null;
  latitude_deg: number | null;
  longitude_deg: number | null;
  height_m: number | null;
  horizontal_sd_m: number | null;
  vertical_sd_m: number | null;
};
export type HandoverMode = "off" | "propose" | "automatic";
export type Fusion = {
  stale: boolean;
  handover: HandoverMode | ""; // which targets of detections lead stations; "": it does not say
  utime_us: number;
  latency_s: number | null;
  alarms: Alarm[];
  last_error: string;
  counters: Record<string, number | null>;
  cues: Cue[];
  stations: { id: string; rate_hz: number | null; quarantine: string; residual: number | null; clock_offset_s: number | null }[];
};
// A row of the table of conditions with its parameters.
export type Said = {
  id: string; // empty: none
  text: string; // in English
  parameters: Record<string, string>;
};
export type Alarm = Said & {
  key: string; // its event's
};
export type SiteEvent = {
  number: number;
  utime_us: number;
  kind: string;
  station: string;
  who: string;
  text: string;
  key: string; // the same for the same alarm, whatever its numbers
  said: Said | null; // of an alarm, and of what the console has noted
  outcome: string; // of a command: empty while it is not known
  refusal: Said | null; // why it is not carried out
  over_us: number | null; // of an alarm; null: it holds
  acknowledged: string; // by whom
  times: number;
};

export type Corner = [longitude_deg: number, latitude_deg: number];
// What is watched: a volume, for these classes (none: for all) from a time of day to another.
export type Area = { name: string; polygon: Corner[]; lowest_m: number; highest_m: number; classes: string[]; from: string; to: string };
// A target in an area.
export type Incident = {
  id: string;
  number: number;
  area: string;
  target: string; // "BOOT/NUMBER" of the fusion and of its target
  class: string;
  class_probability: number; // 0: unknown
  begun_us: number;
  ended_us: number; // 0: it is inside
  entries: number;
  stations: string[];
  verdict: "open" | "confirmed" | "dismissed";
  judged_by: string;
  judged_us: number;
  picture: { station: string; full_px: [number, number] | null; box_px: [number, number, number, number] | null } | null;
};
export const isInside = (one: Incident) => one.ended_us === 0;
// Somebody should look at it.
export const isOpen = (one: Incident) => one.verdict === "open";

export type Site = {
  areas: Map<string, Area>;
  incidents: Map<string, Incident>;
  stations: Map<string, Station>;
  targets: Map<string, Target>;
  lines: Map<string, Line>;
  fusion: Fusion | null;
  events: SiteEvent[]; // newest first
};

export const isTarget = (cue: Cue) => /^\d+$/.test(cue.id);
// A target that is there is drawn as such.
export const cuesOnMap = (fusion: Fusion | null | undefined) => (fusion?.cues ?? []).filter((cue) => !isTarget(cue) || !cue.target);
export const nameOf = (target: Target) => target.name || target.id;

const MOST_EVENTS = 500;
const MOST_TRAIL_POINTS = 600;
const TRAIL_PERIOD_US = 400_000;
const TRAIL_GAP_US = 1_500_000; // kTargetStale_s of console/site_state.h

export function emptySite(): Site {
  return { areas: new Map(), incidents: new Map(), stations: new Map(), targets: new Map(), lines: new Map(), fusion: null, events: [] };
}

// The target that is to stay in the middle: the one that is selected; where none is, the only one.
export function followed(site: Site, selected: string): Target | undefined {
  if (selected.startsWith("target:")) return site.targets.get(selected.slice(7));
  const heard = [...site.targets.values()].filter((target) => !target.stale);
  return heard.length === 1 ? heard[0] : undefined;
}

// The target that a station helps to place.
export const seenBy = (site: Site, station: string) => [...site.targets.values()].find((target) => !target.stale && target.stations?.some((one) => one.used && one.id === station));

type Entity = { id: string };

function merge<T extends Entity>(known: Map<string, T>, changed: Partial<T>[] | undefined, gone: string[] | undefined) {
  for (const id of gone ?? []) known.delete(id);
  for (const fields of changed ?? []) {
    const id = fields.id!;
    known.set(id, { ...known.get(id), ...fields } as T);
  }
}

function trailPoint({ longitude_deg, latitude_deg, height_m, hidden }: Target): TrailPoint {
  if (!hidden) return [longitude_deg, latitude_deg, height_m];
  return [longitude_deg, latitude_deg, height_m, [...hidden.from.map((one) => one.id), ...(hidden.all ? ["*"] : [])]];
}

// Whether the land hid it there from the station that is selected; with another selection, from all.
export const wasHidden = (point: TrailPoint, selected: string) => point[3]?.includes(selected.startsWith("station:") ? selected.slice(8) : "*") ?? false;

// The server sends the trail with a snapshot; from then on it grows here.
function extendTrails(site: Site, changed: Partial<Target>[] | undefined, before: Map<string, number>) {
  for (const { id } of changed ?? []) {
    const target = site.targets.get(id!);
    if (!target || target.latitude_deg == null) continue;
    target.trail = target.trail ?? [];
    const last = before.get(id!) ?? 0;
    if (target.utime_us - last < TRAIL_PERIOD_US) continue;
    before.set(id!, target.utime_us);
    if (target.utime_us - last > TRAIL_GAP_US && target.trail.length > 0) target.trail.push(null);
    target.trail.push(trailPoint(target));
    while (target.trail.length > MOST_TRAIL_POINTS) target.trail.shift();
  }
}

// The trail's stretches in which the target was seen all along; the last goes on to where it is.
export function stretches(target: Target): TrailPoint[][] {
  const all: TrailPoint[][] = [[]];
  for (const point of target.trail ?? []) {
    if (point) all[all.length - 1].push(point);
    else all.push([]);
  }
  all[all.length - 1].push(trailPoint(target));
  return all.filter((one) => one.length > 1);
}

// What a target's row and its label say of it: what has not been heard of is nothing any more.
export const targetState = (target: Target) => (target.stale ? "stale" : target.state);
export const stationState = (station: Station) => (station.stale ? "silent" : station.state);

// Nothing is heard of the site any more.
export function silence(site: Site): void {
  for (const things of [site.stations, site.targets, site.lines] as Map<string, { stale: boolean }>[]) {
    for (const [id, one] of things) things.set(id, { ...one, stale: true });
  }
  if (site.fusion) site.fusion = { ...site.fusion, stale: true };
}

function addEvents(site: Site, events: SiteEvent[] | undefined) {
  for (const event of events ?? []) {
    const known = site.events.findIndex((one) => one.number === event.number);
    const isAgain = known >= 0 && site.events[known].utime_us !== event.utime_us;
    if (isAgain) site.events.splice(known, 1);
    if (known < 0 || isAgain) site.events.unshift(event);
    else site.events[known] = event;
  }
  // As the server does: what holds stays.
  while (site.events.length > MOST_EVENTS) {
    let oldest = site.events.length - 1;
    while (oldest > 0 && site.events[oldest].kind === "alarm" && site.events[oldest].over_us == null) oldest--;
    site.events.splice(oldest, 1);
  }
}

const trailTimes = new Map<string, number>();

// [m, ellipsoidal] of the stations that have said where they stand.
export const stationHeights = (site: Site) => [...site.stations.values()].flatMap((one) => (one.height_m == null ? [] : [one.height_m]));

// Applies a message of the kind "snapshot" or "delta" in place.
export function apply(site: Site, message: any): void {
  if (message.kind === "snapshot") {
    Object.assign(site, emptySite());
    trailTimes.clear();
  }
  const gone = message.gone ?? {};
  merge(site.stations, message.stations, gone.stations);
  merge(site.targets, message.targets, gone.targets);
  merge(site.lines, message.lines, gone.lines);
  merge(site.areas as Map<string, Area & Entity>, message.areas, gone.areas);
  merge(site.incidents, message.incidents, gone.incidents);
  for (const id of gone.targets ?? []) trailTimes.delete(id);
  if (message.kind === "snapshot") for (const { id, utime_us } of site.targets.values()) trailTimes.set(id, utime_us);
  if (message.kind === "delta") extendTrails(site, message.targets, trailTimes);
  if (message.fusion) site.fusion = { ...(site.fusion ?? {}), ...message.fusion };
  addEvents(site, message.events);
}
