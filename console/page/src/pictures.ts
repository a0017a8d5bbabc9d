// The newest picture of each station: asked for, kept until the next one comes, and freed.

import { useEffect, useRef, useState } from "preact/hooks";
import type { Codec, Link, Picture } from "./link";

// Pictures under a person's box: their pixels stay until it is done.
export const drawnOn = new Set<Picture>();

// Pixels of a decoded picture lie outside of what the collector counts.
function free(picture: Picture) {
  if (!drawnOn.has(picture)) picture.image.close();
}

// By station. `wanted`: the stations that are watched; `known`: all there are.
export function usePictures(link: Link, wanted: string[], known: string[], codec: Codec): Map<string, Picture> {
  const pictures = useRef(new Map<string, Picture>());
  const [, redraw] = useState(0);
  useEffect(() => {
    link.onPicture = (picture) => {
      const replaced = pictures.current.get(picture.station);
      pictures.current.set(picture.station, picture);
      if (replaced) free(replaced);
      redraw((n) => n + 1);
    };
  }, []);
  useEffect(() => link.watch(wanted, codec), [wanted.join(), codec]);
  useEffect(() => {
    for (const [id, picture] of pictures.current) {
      if (known.includes(id)) continue;
      pictures.current.delete(id);
      free(picture);
    }
  }, [known.join()]);
  return pictures.current;
}
