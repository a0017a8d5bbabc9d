// Where a lens images points, against values computed from the models' definitions (geometry/lens.h).

import assert from "node:assert/strict";
import { test } from "node:test";
import { offAxis_deg, pixelOf } from "../../console/page/src/projection";

const camera = (lens: string, distortion: number[]) => ({
  ecef_m: [0, 0, 0],
  from_ecef: [1, 0, 0, 0, 1, 0, 0, 0, 1],
  matrix_px: [300, 310, 640, 480, 2],
  lens,
  distortion,
});
const FISHEYE = camera("fisheye", [-0.03, 0.004, 0, 0, -0.001, 0.0002]);

test("a lens images points where its model says, and none where it ends", () => {
  const cases: [ReturnType<typeof camera>, number[], [number, number] | null][] = [
    [camera("pinhole", [0, 0, 0, 0, 0, 0]), [0.1, -0.2, 1], [669.6, 418]],
    [camera("pinhole", [0, 0, 0, 0, 0, 0]), [0.1, -0.2, -1], null],
    [FISHEYE, [2, -1, 0.5], [984.893958, 301.208818]],
    [FISHEYE, [1, 1, -0.5], [1019.717127, 869.775859]],
    [camera("polynomial", [0.02, -0.09, 0, 0, 0.011, 0.001]), [2, -1, 0.5], [962.683369, 312.722668]],
    [FISHEYE, [0, 0, 5], [640, 480]],
    [FISHEYE, [0, 0, -5], null],
    [camera("fisheye", [-0.2, 0, 0, 0, 0, 0]), [Math.sin(1.3), 0, Math.cos(1.3)], null], // ends at 1.291
  ];
  for (const [lens, point, pixel] of cases) {
    const found = pixelOf(lens, point);
    assert.deepEqual(found && found.map((value) => Math.round(1e6 * value) / 1e6), pixel);
  }
});

test("how far off the axis a distance on the picture is", () => {
  assert.equal(Math.round(offAxis_deg(camera("pinhole", []), 300)), 45);
  assert.equal(Math.round(offAxis_deg(FISHEYE, 300)), 57);
  assert.equal(offAxis_deg(FISHEYE, 3000), 180);
});
