// The page's copy of the site: what is not heard of any more, and trails with gaps.

import assert from "node:assert/strict";
import { test } from "node:test";
import { canGoBack, isAtWork, lostForAll, stopped } from "../../console/page/src/byhand";
import { apply, cuesOnMap, emptySite, isTarget, silence, stationState, stretches, targetState, type Cue, type Fusion, type Station, type Target } from "../../console/page/src/site";
import { runsOf } from "../../console/page/src/heights";
import { hiddenInShort, hiddenText, stateText, stationWords } from "../../console/page/src/statetext";

const station = (id: string, state: string, more = {}) => ({ id, state, stale: false, ...more });
const target = (second: number, more = {}) => ({ id: "7", state: "confirmed", stale: false, utime_us: second * 1e6, longitude_deg: second, latitude_deg: 1, height_m: 2, ...more });

function siteOf(stations: object[], targets: object[] = []) {
  const site = emptySite();
  apply(site, { kind: "snapshot", stations, targets, lines: [{ id: "alfa", stale: false }], fusion: { stale: false } });
  return site;
}

test("of a site that is not heard everything is old, and nothing in the state that it was in", () => {
  const site = siteOf([station("alfa", "tracking")], [target(1)]);
  silence(site);
  assert.equal(stationState(site.stations.get("alfa")!), "silent");
  assert.equal(targetState(site.targets.get("7")!), "stale");
  assert.ok(site.fusion!.stale && site.lines.get("alfa")!.stale);
});

test("a target that is heard of again is what it is", () => {
  const site = siteOf([], [target(1, { stale: true })]);
  assert.equal(targetState(site.targets.get("7")!), "stale");
  apply(site, { kind: "delta", targets: [target(2)] });
  assert.equal(targetState(site.targets.get("7")!), "confirmed");
});

const places = (of: Target) => stretches(of).map((one) => one.map(([longitude]) => longitude));

test("a trail is not drawn where the target was not seen", () => {
  const site = siteOf([], [target(1, { trail: [[0.5, 1, 2], [1, 1, 2]] })]);
  for (const second of [1.5, 2, 6, 6.5]) apply(site, { kind: "delta", targets: [target(second)] });
  assert.deepEqual(places(site.targets.get("7")!), [[0.5, 1, 1.5, 2], [6, 6.5, 6.5]]);
});

test("a trail is dashed where the land hid the target from the selected station, or from all", () => {
  const from = [{ id: "alfa", since_us: 1e6, back_us: 0 }];
  const site = siteOf([], [target(1, { trail: [[0.5, 1, 2], [1, 1, 2, ["bravo"]]] })]);
  apply(site, { kind: "delta", targets: [target(1.5, { hidden: { from, all: false } })] });
  apply(site, { kind: "delta", targets: [target(2, { hidden: { from, all: true } })] });
  apply(site, { kind: "delta", targets: [target(2.5, { hidden: null })] });
  const [whole] = stretches(site.targets.get("7")!);
  const cases: [string, boolean[]][] = [
    ["station:alfa", [false, true, false]],
    ["station:bravo", [true, false]],
    ["target:7", [false, true, false]],
    ["station:charlie", [false]],
  ];
  for (const [selected, hidden] of cases) {
    const runs = runsOf(whole, [0, 10], 3, selected);
    assert.deepEqual(runs.map((one) => one.isHidden), hidden, selected);
    assert.equal(runs.reduce((sum, one) => sum + one.places.length - 1, 0), whole.length - 1);
  }
});

test("a hidden target says from whom and for how long", () => {
  const from = [{ id: "alfa", since_us: 1e6, back_us: 0 }, { id: "bravo", since_us: 3e6, back_us: 43_267_000_000 }];
  const one = (all: boolean) => ({ ...target(5), hidden: { from, all } }) as Target;
  assert.equal(hiddenInShort(one(false), 5e6), "   hidden from alfa, bravo for 4 s");
  assert.equal(hiddenInShort(one(true), 5e6), "   hidden for 2 s");
  assert.equal(hiddenInShort(target(5) as Target, 5e6), "");
  assert.equal(hiddenText(one(true), 5e6), "alfa for 4 s; bravo for 2 s, back 12:01:07");
  const alfa = station("alfa", "hidden", { hidden_since_utime_us: 1e6, hidden_until_utime_us: 9e6 }) as Station;
  assert.equal(stationWords(alfa, 5e6), "alfa   hidden for 4 s");
});

test("a gap that the server knows of is one", () => {
  const site = siteOf([], [target(9, { trail: [[1, 1, 2], [2, 1, 2], null, [9, 1, 2]] })]);
  assert.deepEqual(places(site.targets.get("7")!), [[1, 2], [9, 9]]);
  assert.deepEqual(places({ ...target(9), trail: undefined } as unknown as Target), []);
});

test("a station is at work as long as it follows something", () => {
  const states = ["idle", "manual", "tracking", "coasting", "lost", "slewed", "stopped", "emergency"];
  assert.deepEqual(states.filter((state) => isAtWork(station("a", state) as Station)), ["tracking", "coasting", "slewed"]);
});

test("only a station in hand that has followed something goes back to it", () => {
  const back = (state: string, track_id?: string) => canGoBack(station("a", state, { track_id }) as Station);
  assert.deepEqual([back("manual", "3"), back("manual", "0"), back("manual"), back("stopped", "3")], [true, false, false, false]);
});

test("who is to be released are those that are heard and stopped", () => {
  const site = siteOf([station("c", "stopped"), station("a", "stopped"), station("b", "manual"), station("d", "stopped", { stale: true })]);
  assert.deepEqual(stopped(site), ["a", "c"]);
});

test("stations are lost for all when no target has a position", () => {
  const stations = [station("b", "lost"), station("a", "lost"), station("c", "tracking")];
  assert.deepEqual(lostForAll(siteOf(stations)), ["a", "b"]);
  assert.deepEqual(lostForAll(siteOf(stations, [target(1, { stale: true })])), ["a", "b"]);
  assert.deepEqual(lostForAll(siteOf(stations, [target(1)])), []);
});

test("a cue whose name is a number is a target of detectors, drawn as a cue only while it is lost", () => {
  const cue = (id: string, target: string) => ({ id, target }) as Cue;
  assert.deepEqual([isTarget(cue("7", "7")), isTarget(cue("tak.7", "7"))], [true, false]);
  const fusion = { cues: [cue("tak.a", "7"), cue("7", "7"), cue("8", "")] } as Fusion;
  assert.deepEqual(cuesOnMap(fusion).map((one) => one.id), ["tak.a", "8"]);
  assert.deepEqual(cuesOnMap(null), []);
});

test("a station says for how long its target has been hidden, and when it comes out", () => {
  const at = (more: object) => stateText(station("alfa", "hidden", more) as unknown as Station, 12e6);
  assert.equal(at({ hidden_since_utime_us: 8e6, hidden_until_utime_us: 15e6 }), "hidden for 4 s, back 00:00:15");
  assert.equal(at({ hidden_since_utime_us: 8e6, hidden_until_utime_us: 0 }), "hidden for 4 s");
  assert.equal(at({ hidden_since_utime_us: 8e6, stale: true }), "silent");
});
