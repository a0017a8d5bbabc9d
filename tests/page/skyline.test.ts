// The land's skyline in a picture: where it is, what it leaves out, and how often it is asked for and projected.

import assert from "node:assert/strict";
import { test } from "node:test";
import { type Camera, ecef, moved, onGround } from "../../console/page/src/projection";
import { Skylines } from "../../console/page/src/skyline";

const [LATITUDE, LONGITUDE, FOCAL_PX] = [49.2, 16.6, 4000];
const PLACE = ecef(LATITUDE, LONGITUDE, 300);
const axis = (enu: number[]) => moved([0, 0, 0], LATITUDE, LONGITUDE, enu);

// Level, to an azimuth.
function camera(azimuth_deg: number, lens = "pinhole"): Camera {
  const a = (azimuth_deg * Math.PI) / 180;
  const rows = [axis([Math.cos(a), -Math.sin(a), 0]), axis([0, 0, -1]), axis([Math.sin(a), Math.cos(a), 0])];
  return { ecef_m: PLACE, from_ecef: rows.flat(), matrix_px: [FOCAL_PX, FOCAL_PX, 640, 480, 0], lens, distortion: [0, 0, 0, 0, 0, 0] };
}
const picture = (of: Camera) => ({ station: "alfa", utime_us: 0, full_px: [1280, 960] as [number, number], box_px: null, camera: of, image: null as any });

// 0.05 degrees apart, one degree high, unknown from 91.5 to 92 degrees.
const ELEVATIONS = Array.from({ length: 7200 }, (_, i) => (i >= 1830 && i <= 1840 ? null : 1));

function console_with(answer: object) {
  const asked: string[] = [];
  globalThis.fetch = (async (path: string) => (asked.push(path), { json: async () => answer })) as any;
  return asked;
}
const settled = () => new Promise(setImmediate);
// Debian's Node does not let it be assigned.
const at = (ms: number) => Object.defineProperty(performance, "now", { value: () => ms, configurable: true });

test("the skyline is where the camera sees it, broken where the land is not known", async () => {
  const asked = console_with({ camera_ecef_m: PLACE, elevation_deg: ELEVATIONS });
  let news = 0;
  const skylines = new Skylines(() => news++);
  for (const [azimuth_deg, parts] of [[90, 2], [0, 1], [359.97, 1]] as const) {
    for (const lens of ["pinhole", "fisheye", "polynomial"]) {
      skylines.linesIn(picture(camera(azimuth_deg, lens)));
      await settled();
      const lines = skylines.linesIn(picture(camera(azimuth_deg, lens)));
      assert.equal(lines.length, parts, `${azimuth_deg} ${lens}`);
      const points = lines.flat();
      const middle = points.reduce((best, one) => (Math.abs(one[0] - 640) < Math.abs(best[0] - 640) ? one : best));
      assert.ok(Math.abs(middle[0] - 640) < 3 && Math.abs(middle[1] - (480 - FOCAL_PX * Math.tan(Math.PI / 180))) < 0.05, String(middle));
      assert.ok(Math.min(...points.map(([x]) => x)) < 0 && Math.max(...points.map(([x]) => x)) > 1280, "from edge to edge");
    }
  }
  assert.deepEqual([asked, news], [["/api/land/skyline/alfa"], 1]);
});

test("while it is being computed, it is asked for again a second later", async () => {
  const asked = console_with({ computing: true });
  const skylines = new Skylines(() => assert.fail("nothing has come"));
  for (const ms of [50_000, 50_900, 51_100]) {
    at(ms);
    assert.deepEqual(skylines.linesIn(picture(camera(90))), []);
    await settled();
  }
  assert.equal(asked.length, 2);
});

test("it is projected once for each pose, and asked for again where the camera has moved", async () => {
  const asked = console_with({ camera_ecef_m: PLACE, elevation_deg: ELEVATIONS });
  const skylines = new Skylines(() => {});
  skylines.linesIn(picture(camera(90)));
  await settled();
  const lines = skylines.linesIn(picture(camera(90)));
  assert.equal(skylines.linesIn(picture(camera(90))), lines);
  assert.notEqual(skylines.linesIn(picture({ ...camera(90), matrix_px: [4100, 4100, 640, 480, 0] })), lines);
  skylines.linesIn(picture({ ...camera(90), ecef_m: PLACE.map((v) => v + 5) }));
  assert.equal(asked.length, 1, "not at once");
  const later_ms = performance.now() + 20_000;
  at(later_ms);
  skylines.linesIn(picture(camera(90)));
  assert.equal(asked.length, 1, "it stands where it stood");
  skylines.linesIn(picture({ ...camera(90), ecef_m: PLACE.map((v) => v + 5) }));
  assert.equal(asked.length, 2);
});

test("why there is none is kept", async () => {
  console_with({ error: "the camera is under the ground" });
  const skylines = new Skylines(() => {});
  assert.deepEqual(skylines.linesIn(picture(camera(90))), []);
  await settled();
  assert.equal(skylines.problems.get("alfa")!.error, "the camera is under the ground");
});

test("a place's latitude and longitude", () => {
  for (const [latitude, longitude, height] of [[49.2, 16.6, 300], [-33, -179.9, 4000], [0, 10, -100], [78, 15, 10_000]]) {
    const found = onGround(ecef(latitude, longitude, height));
    assert.ok(Math.abs(found.latitude_deg - latitude) < 1e-7 && Math.abs(found.longitude_deg - longitude) < 1e-7);
  }
});

test("where the picture disagrees is drawn at the picture's elevation, and renewed", async () => {
  let differing = [[90.025, 2], [90.125, 2], [90.525, 2]];
  const asked: string[] = [];
  globalThis.fetch = (async (path: string) => (asked.push(path), { json: async () => ({ differing }) })) as any;
  const skylines = new Skylines(() => {});
  const points = () => skylines.differingIn(picture(camera(90)));
  at(100_000);
  assert.deepEqual(points(), []);
  await settled();
  const [line, ...others] = points();
  assert.equal(others.length, 0, "one column alone is no line");
  assert.equal(line.length, 3, "with the gap between two columns of a wide lens");
  const [x, y] = line[0];
  assert.ok(Math.abs(x - 640 - FOCAL_PX * Math.tan((0.025 * Math.PI) / 180)) < 1 && Math.abs(y - (480 - FOCAL_PX * Math.tan((2 * Math.PI) / 180))) < 1, String(line[0]));
  differing = [];
  at(104_000);
  assert.equal(points().length, 1);
  at(106_000);
  points();
  await settled();
  assert.deepEqual(points(), []);
  assert.deepEqual(asked, ["/api/land/seen/alfa", "/api/land/seen/alfa"]);
});
