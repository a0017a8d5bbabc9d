// On which side of its point each name on the map is written, so that names near one another can all be read.

export type Named = { id: string; at: [number, number]; width: number }; // [px] the point, and its words
export type Side = "right" | "left" | "below" | "above";
export type Box = [x: number, y: number, width: number, height: number]; // [px] its upper left corner, and its size

const HEIGHT = 15;
const POINT = 9; // half of the symbol's width
// From the point to the middle of the words' near edge; of those above and below, to their middle.
export const OFFSETS: Record<Side, [number, number]> = { right: [13, 0], left: [-13, 0], below: [0, 19], above: [0, -18] };

function boxOf({ at, width }: Named, side: Side): Box {
  const [dx, dy] = OFFSETS[side];
  const left = side === "right" ? dx : side === "left" ? dx - width : -width / 2;
  return [at[0] + left, at[1] + dy - HEIGHT / 2, width, HEIGHT];
}

export const meet = (a: Box, b: Box) => a[0] < b[0] + b[2] && b[0] < a[0] + a[2] && a[1] < b[1] + b[3] && b[1] < a[1] + a[3];

// The first of them come first; null: there is no room. `before`: a name does not change sides without need.
// `over`: what would cover it.
export function sidesOf(names: Named[], before: Map<string, Side | null>, over: Box[] = []): Map<string, Side | null> {
  const symbols = names.map(({ id, at }) => ({ id, box: [at[0] - POINT, at[1] - POINT, 2 * POINT, 2 * POINT] as Box }));
  const taken = [...over];
  const chosen = new Map<string, Side | null>();
  for (const name of names) {
    const last = before.get(name.id);
    const sides = [...(last ? [last] : []), ...(Object.keys(OFFSETS) as Side[])];
    const isFree = (box: Box) => !taken.some((other) => meet(box, other)) && !symbols.some((one) => one.id !== name.id && meet(box, one.box));
    const side = sides.find((one) => isFree(boxOf(name, one))) ?? null;
    chosen.set(name.id, side);
    if (side) taken.push(boxOf(name, side));
  }
  return chosen;
}
