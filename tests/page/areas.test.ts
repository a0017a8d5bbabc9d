// Areas and incidents in the page's copy of the site, and corners as people write them.

import assert from "node:assert/strict";
import { test } from "node:test";
import { cornersOf, newArea, textOfCorners } from "../../console/page/src/areapanel";
import { apply, emptySite } from "../../console/page/src/site";

test("areas and incidents come, change and go", () => {
  const site = emptySite();
  apply(site, { kind: "snapshot", areas: [{ id: "Gate", name: "Gate" }], incidents: [{ id: "1", number: 1, verdict: "open" }] });
  apply(site, { kind: "delta", incidents: [{ id: "1", verdict: "dismissed" }, { id: "2", number: 2 }], gone: { areas: ["Gate"] } });
  assert.equal(site.areas.size, 0);
  assert.equal(site.incidents.get("1")!.verdict, "dismissed");
  assert.equal(site.incidents.get("1")!.number, 1);
  apply(site, { kind: "delta", gone: { incidents: ["1"] } });
  assert.deepEqual([...site.incidents.keys()], ["2"]);
});

test("a new area reaches from below the stations to drones above them", () => {
  const span = (heights_m: number[]) => [newArea(heights_m).lowest_m, newArea(heights_m).highest_m];
  assert.deepEqual(span([812, 1204.5]), [760, 2210]);
  assert.deepEqual(span([]), [-50, 1000]);
});

test("corners are read as they are written", () => {
  const corners: [number, number][] = [
    [16.5, -49.25],
    [-179.999999, 0],
  ];
  assert.deepEqual(cornersOf(textOfCorners(corners)), corners);
  assert.deepEqual(cornersOf("49.1, 16.2\n\n 49.3° 16.4° "), [[16.2, 49.1], [16.4, 49.3]]);
  for (const bad of ["49.1", "49.1 16.2 3", "north 16.2"]) assert.equal(cornersOf(bad), null, bad);
});
