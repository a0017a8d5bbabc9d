// Where things with a known place are in a station's picture: WGS84 and OpenCV's camera model, by the
// camera that came with the very picture (docs/video.md).

export type Camera = {
  ecef_m: number[];
  from_ecef: number[]; // rotation by rows; x right, y down, z forward
  matrix_px: number[]; // fx, fy, cx, cy, skew
  distortion: number[]; // k1, k2, p1, p2, k3
};

const A_M = 6378137;
const E2 = 0.00669437999014;

export function ecef(latitude_deg: number, longitude_deg: number, height_m: number): number[] {
  const [lat, lon] = [(latitude_deg * Math.PI) / 180, (longitude_deg * Math.PI) / 180];
  const n = A_M / Math.sqrt(1 - E2 * Math.sin(lat) ** 2);
  const across = (n + height_m) * Math.cos(lat);
  return [across * Math.cos(lon), across * Math.sin(lon), (n * (1 - E2) + height_m) * Math.sin(lat)];
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

// The pixel in the full frame; null behind the camera or far outside of its lens.
export function pixelOf(camera: Camera, place: number[]): [number, number] | null {
  const d = place.map((value, i) => value - camera.ecef_m[i]);
  const r = camera.from_ecef;
  const row = (i: number) => r[3 * i] * d[0] + r[3 * i + 1] * d[1] + r[3 * i + 2] * d[2];
  const z = row(2);
  if (z <= 0) return null;
  const [x, y] = [row(0) / z, row(1) / z];
  const r2 = x * x + y * y;
  if (r2 > 1) return null; // the distortion's polynomial means nothing there
  const [k1, k2, p1, p2, k3] = camera.distortion;
  const radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const xd = x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x);
  const yd = y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y;
  const [fx, fy, cx, cy, skew] = camera.matrix_px;
  return [fx * xd + skew * yd + cx, fy * yd + cy];
}
