// Numbers as people read them.

import assert from "node:assert/strict";
import { test } from "node:test";
import { bearing, fixed } from "../../console/page/src/format";
import { climb, measures } from "../../console/page/src/measures";
import { setLanguage } from "../../console/page/src/words";

test("whether a target climbs is a word, and how fast has no sign", (of) => {
  Object.assign(globalThis, { document: { documentElement: {} } });
  of.after(() => void (measures.units = "m_s"));
  const speeds = [1.23, -1.23, 0, 0.04, -0.04, null, undefined, NaN];
  assert.deepEqual(speeds.map(climb), ["climbing 1.2 m/s", "sinking 1.2 m/s", "level", "level", "level", "–", "–", "–"]);
  setLanguage("de");
  assert.deepEqual([1.23, -1.23, 0].map(climb), ["steigt 1.2 m/s", "sinkt 1.2 m/s", "waagrecht"]);
  measures.units = "km_h";
  assert.equal(climb(-0.04), "sinkt 0.1 km/h");
});

test("what is written as zero has no sign", () => {
  assert.deepEqual([-0.04, -0.06, 0.04].map((value) => fixed(value, 1, "°")), ["0.0°", "-0.1°", "0.0°"]);
});

test("a bearing has three digits, and none is written as 360", () => {
  assert.deepEqual([0, 5.2, 359.6, -0.4].map((deg) => bearing(deg, 0)), ["000°", "005°", "000°", "000°"]);
  assert.deepEqual([-0.04, 359.94, NaN, null].map((deg) => bearing(deg)), ["000.0°", "359.9°", "–", "–"]);
});
