// Where things with a known place are in a station's picture: WGS84 and the camera's lens model, by the
// camera that came with the very picture (docs/video.md).

export type Camera = {
  ecef_m: number[];
  from_ecef: number[]; // rotation by rows; x right, y down, z forward
  matrix_px: number[]; // fx, fy, cx, cy, skew
  lens: string; // pinhole, fisheye, polynomial
  distortion: number[]; // k1, k2, p1, p2, k3, k4
};

const A_M = 6378137;
const E2 = 0.00669437999014;

export function ecef(latitude_deg: number, longitude_deg: number, height_m: number): number[] {
  const [lat, lon] = [(latitude_deg * Math.PI) / 180, (longitude_deg * Math.PI) / 180];
  const n = A_M / Math.sqrt(1 - E2 * Math.sin(lat) ** 2);
  const across = (n + height_m) * Math.cos(lat);
  return [across * Math.cos(lon), across * Math.sin(lon), (n * (1 - E2) + height_m) * Math.sin(lat)];
}

// Latitude and longitude [deg] of a place near the ground: to 1e-7 deg up to 10 km above it (Bowring).
export function onGround([x, y, z]: number[]): { latitude_deg: number; longitude_deg: number } {
  const b = A_M * Math.sqrt(1 - E2);
  const across = Math.hypot(x, y);
  const reduced = Math.atan2(z * A_M, across * b);
  const latitude = Math.atan2(z + (E2 / (1 - E2)) * b * Math.sin(reduced) ** 3, across - E2 * A_M * Math.cos(reduced) ** 3);
  return { latitude_deg: (latitude * 180) / Math.PI, longitude_deg: (Math.atan2(y, x) * 180) / Math.PI };
}

// Unit vectors (ECEF) of elevations [deg] at equal steps of azimuth, clockwise from north, the first after a part of a
// step; null where there is none.
export function unitsEcef({ latitude_deg, longitude_deg }: { latitude_deg: number; longitude_deg: number }, elevations_deg: (number | null)[], first = 0): (number[] | null)[] {
  return elevations_deg.map((elevation_deg, i) => {
    if (elevation_deg == null) return null;
    const [a, e] = [(2 * Math.PI * (i + first)) / elevations_deg.length, (elevation_deg * Math.PI) / 180];
    return moved([0, 0, 0], latitude_deg, longitude_deg, [Math.cos(e) * Math.sin(a), Math.cos(e) * Math.cos(a), Math.sin(e)]);
  });
}

// A place moved along east, north, up [m]: of a target, to the instant of a picture.
export function moved(place: number[], latitude_deg: number, longitude_deg: number, enu_m: number[]): number[] {
  const [lat, lon] = [(latitude_deg * Math.PI) / 180, (longitude_deg * Math.PI) / 180];
  const [e, n, u] = enu_m;
  const out = u * Math.cos(lat) - n * Math.sin(lat); // away from the axis
  return [
    place[0] - e * Math.sin(lon) + out * Math.cos(lon),
    place[1] + e * Math.cos(lon) + out * Math.sin(lon),
    place[2] + n * Math.cos(lat) + u * Math.sin(lat),
  ];
}

// A place far away in a direction, as a camera at this latitude and longitude sees it.
export function towards(camera: Camera, latitude_deg: number, longitude_deg: number, azimuth_deg: number, elevation_deg: number): number[] {
  const far_m = 1e6;
  const [a, e] = [(azimuth_deg * Math.PI) / 180, (elevation_deg * Math.PI) / 180];
  const across = far_m * Math.cos(e);
  return moved(camera.ecef_m, latitude_deg, longitude_deg, [across * Math.sin(a), across * Math.cos(a), far_m * Math.sin(e)]);
}

// The direction of the optical axis at this latitude and longitude: azimuth clockwise from north, elevation.
export function axisOf(camera: Camera, latitude_deg: number, longitude_deg: number): { azimuth_deg: number; elevation_deg: number } {
  const [lat, lon] = [(latitude_deg * Math.PI) / 180, (longitude_deg * Math.PI) / 180];
  const [x, y, z] = camera.from_ecef.slice(6, 9);
  const out = x * Math.cos(lon) + y * Math.sin(lon);
  const east = -x * Math.sin(lon) + y * Math.cos(lon);
  const north = -Math.sin(lat) * out + z * Math.cos(lat);
  const up = Math.cos(lat) * out + z * Math.sin(lat);
  const degrees = (angle: number) => (angle * 180) / Math.PI;
  return { azimuth_deg: (degrees(Math.atan2(east, north)) + 360) % 360, elevation_deg: degrees(Math.atan2(up, Math.hypot(east, north))) };
}

// A point before the camera on the plane that the camera matrix takes to pixels (geometry/lens.h): null behind
// the camera or far outside of its lens.
type Plane = [number, number] | null;

function pinhole([k1, k2, p1, p2, k3]: number[], [px, py, pz]: number[]): Plane {
  if (pz <= 0) return null;
  const [x, y] = [px / pz, py / pz];
  const r2 = x * x + y * y;
  if (r2 > 1) return null; // the distortion's polynomial means nothing there
  const radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  return [x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x), y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y];
}

// The radius is a polynomial of the angle off the axis: theta (1 + k1 s + k2 s^2 + ...), s = theta^power. It
// images as far as that grows.
function radial(power: number, [k1, k2, , , k3, k4]: number[]): (p: number[]) => Plane {
  const terms = [1, k1, k2, k3, k4];
  const radius = (angle: number) => angle * terms.reduceRight((sum, term) => sum * angle ** power + term, 0);
  const grows = (angle: number) => terms.reduceRight((sum, term, i) => sum * angle ** power + term * (1 + power * i), 0) > 0;
  const steps = 512; // of the half circle
  let grown = 0;
  while (grown < steps && grows((Math.PI * (grown + 1)) / steps)) grown++;
  const last = (Math.PI * grown) / steps;
  return ([x, y, z]) => {
    const away = Math.hypot(x, y);
    const theta = Math.atan2(away, z);
    if (theta > last) return null;
    if (away === 0) return z > 0 ? [0, 0] : null;
    return [(radius(theta) / away) * x, (radius(theta) / away) * y];
  };
}

const PLANES: Record<string, (k: number[]) => (p: number[]) => Plane> = {
  pinhole: (k) => (p) => pinhole(k, p),
  fisheye: (k) => radial(2, k),
  polynomial: (k) => radial(1, k),
};

// About the angle off the axis at this distance from the principal point.
export function offAxis_deg(camera: Camera, away_px: number): number {
  const away = away_px / camera.matrix_px[0];
  return Math.min(180, ((camera.lens === "pinhole" ? Math.atan(away) : away) * 180) / Math.PI);
}

// From directions (ECEF, from the camera, of any length) to pixels in the full frame; null behind the camera or far
// outside of its lens.
export function projectorOf(camera: Camera): (direction: number[]) => [number, number] | null {
  const r = camera.from_ecef;
  const [fx, fy, cx, cy, skew] = camera.matrix_px;
  const plane = PLANES[camera.lens](camera.distortion);
  return ([x, y, z]) => {
    const row = (i: number) => r[3 * i] * x + r[3 * i + 1] * y + r[3 * i + 2] * z;
    const xy = plane([row(0), row(1), row(2)]);
    return xy && [fx * xy[0] + skew * xy[1] + cx, fy * xy[1] + cy];
  };
}

export function pixelOf(camera: Camera, place: number[]): [number, number] | null {
  return projectorOf(camera)(place.map((value, i) => value - camera.ecef_m[i]));
}
