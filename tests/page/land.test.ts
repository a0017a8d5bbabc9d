// What the page makes of the imported land: the text of a height, the drawing of a profile, the lattice of the 3-D view.

import assert from "node:assert/strict";
import { test } from "node:test";
import { groundText } from "../../console/page/src/groundprobe";
import { drawn, profileText } from "../../console/page/src/profile";
import { boxAround, terrainOf } from "../../console/page/src/terrain3d";
import type { Station } from "../../console/page/src/site";

test("the height of the ground in words", () => {
  assert.equal(groundText({ ground_m: 412.3, top_m: 412.3, sd_m: 4 }), "Ground 412 m ± 4 m");
  assert.equal(groundText({ ground_m: 412.3, top_m: 430, sd_m: 4 }), "Ground 412 m ± 4 m, top 430 m");
  assert.equal(groundText({ ground_m: null, top_m: null, sd_m: null }), "Ground not known");
});

test("a profile is drawn to its ends, and what is blocked apart", () => {
  const points: [number, number | null, number | null, number][] = [[0, 0, 0, 10], [50, null, null, 15], [100, 90, 90, 20], [150, 0, 0, 25], [200, 0, 0, 30]];
  const { ground, seen, blocked, lowest, highest } = drawn({ points, blocked_m: 100 });
  assert.deepEqual([lowest, highest], [0, 90]);
  assert.equal(ground, "M0.0 90.0V96H0.0ZM135.0 4.0L202.5 90.0L270.0 90.0V96H135.0Z", "broken where it is not known");
  assert.equal((seen.match(/[ML]/g) ?? []).length, 3);
  assert.ok(blocked.startsWith(seen.slice(seen.lastIndexOf("L") + 1).replace(/^/, "M")), `${seen} ${blocked}`);
  assert.equal(drawn({ points, blocked_m: null }).blocked, "");
});

test("a line of sight is clear only where the land is known", () => {
  assert.equal(profileText({ blocked_m: null, known_to_m: null }), "clear");
  assert.equal(profileText({ blocked_m: null, known_to_m: 4200 }), "clear, known up to 4.20 km");
  assert.equal(profileText({ blocked_m: 670, known_to_m: 4200 }), "blocked at 670 m");
});

test("the lattice is around the site, lit from the north-west, without what is not known", () => {
  const stations = [{ latitude_deg: 49, longitude_deg: 16 }, { latitude_deg: 49.02, longitude_deg: 16 }, { latitude_deg: null }] as Station[];
  const [west, south, east, north] = boxAround(stations, [])!;
  assert.ok(Math.abs((south + north) / 2 - 49.01) < 1e-9 && Math.abs((north - south) / 2 - 3000 / 111_200) < 1e-9);
  const [, low, , high] = boxAround(stations, [{ latitude_deg: 49.06, longitude_deg: 16 }])!;
  assert.ok(Math.abs((high - low) / (north - south) - 4) < 1e-9, "7.2 km for a target that is 5.6 km away: 12 km");
  assert.ok(Math.abs((east - west) / (north - south) - 1 / Math.cos((49.01 * Math.PI) / 180)) < 1e-9);
  const place = (latitude: number, longitude: number, height_m: number) => [longitude * 100, latitude * 100, height_m] as [number, number, number];
  const of = (heights_m: (number | null)[]) => terrainOf({ columns: 3, rows: 2, heights_m }, [0, 0, 2, 1], place).shade;
  const [level] = of([0, 0, 0, 0, 0, 0]);
  const [west_side, east_side, edge] = of([0, 50, 0, 0, 50, 0]);
  assert.ok(west_side! > level! && level! > east_side! && edge === null);
  assert.deepEqual(of([0, 0, null, 0, 0, 0]).map((one) => one !== null), [true, false, false, false, false, false]);
});
