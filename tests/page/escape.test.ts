// What Escape means.

import assert from "node:assert/strict";
import { test } from "node:test";
import { Opened, press } from "../../console/page/src/escape";

const KEY = { key: "Escape", repeat: false, isComposing: false, ctrlKey: false, altKey: false, metaKey: false, shiftKey: false };

test("it stops with nothing open", () => {
  assert.equal(press(KEY, new Opened(), null), "stop");
});

test("it closes what was opened last, one thing with each press, and stops then", () => {
  const opened = new Opened();
  const closed: string[] = [];
  opened.add(() => closed.push("menu"));
  opened.add(() => closed.push("drag"));
  const pressed = [1, 2, 3].map(() => [press(KEY, opened, null), opened.isEmpty]);
  assert.deepEqual(pressed, [["closed", false], ["closed", true], ["stop", true]]);
  assert.deepEqual(closed, ["drag", "menu"]);
});

test("what has closed by itself is not open", () => {
  const opened = new Opened();
  opened.add(() => assert.fail())();
  assert.equal(press(KEY, opened, null), "stop");
});

test("who writes in a field leaves it", () => {
  let isLeft = false;
  assert.equal(press(KEY, new Opened(), { blur: () => (isLeft = true) }), "closed");
  assert.ok(isLeft);
});

for (const not of [{ key: "a" }, { repeat: true }, { isComposing: true }, { ctrlKey: true }, { altKey: true }, { metaKey: true }, { shiftKey: true }]) {
  test(`${JSON.stringify(not)} is no Escape`, () => {
    const opened = new Opened();
    opened.add(() => assert.fail());
    assert.equal(press({ ...KEY, ...not }, opened, null), "nothing");
  });
}
