// What is large on the page: the map, the pictures, or one picture alone. A browser remembers it.

import { h, Fragment } from "preact";
import { useState } from "preact/hooks";
import { useEscape } from "./escape";
import { remember, remembered } from "./memory";
import { t } from "./words";

export function useArrangement() {
  const [large, setLarge] = useState(remembered("large", "map") === "pictures" ? "pictures" : "map");
  const [isAlone, setAlone] = useState(remembered("alone", "no") === "yes");
  const exchange = () => {
    const wanted = large === "map" ? "pictures" : "map";
    remember("large", wanted);
    setLarge(wanted);
  };
  const toggleAlone = () => {
    remember("alone", isAlone ? "no" : "yes");
    setAlone(!isAlone);
  };
  useEscape(isAlone, toggleAlone);
  return { large, isAlone, exchange, toggleAlone };
}
export type Arrangement = ReturnType<typeof useArrangement>;

export function ArrangementChoice({ large, isAlone, exchange, toggleAlone }: Arrangement) {
  return (
    <Fragment>
      {!isAlone && (
        <button type="button" onClick={exchange}>
          {t(large === "map" ? "pictures_large" : "map_large")}
        </button>
      )}
      <button type="button" aria-pressed={isAlone} onClick={toggleAlone}>
        {t("picture_alone")}
      </button>
    </Fragment>
  );
}
