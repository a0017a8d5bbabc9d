// The choice of the users' own maps, and of the accuracy that is drawn.

import { h, Fragment } from "preact";
import { useEffect, useState } from "preact/hooks";
import { inWords } from "./conditions";
import { ACCURACY_STEPS, AccuracyChoice, UserMap, userMaps, UserMaps } from "./maplayers";
import type { SiteMap } from "./sitemap";
import { t } from "./words";

const ABOVE_M = [50, 100, 300, 1000, 3000];

// Which of the users' maps there are, and which of them the map shows.
function useOwnMaps(map: SiteMap) {
  const [known, setKnown] = useState<UserMaps>({ maps: [], problem: "" });
  const [chosen, setChosen] = useState<string[] | null>(null); // null: all of them
  const look = () => void userMaps().then(setKnown);
  useEffect(() => {
    look();
    let waiting = 0;
    // Many tiles fail at once.
    map.onMapTrouble = () => (waiting ||= window.setTimeout(() => ((waiting = 0), look()), 1000));
    return () => clearTimeout(waiting);
  }, []);
  const isShown = (one: UserMap) => chosen === null || chosen.includes(one.id);
  useEffect(() => map.showMaps(known.maps.filter((one) => isShown(one))), [known, chosen]);
  const toggle = (id: string) => {
    const all = known.maps.filter(isShown).map((one) => one.id);
    setChosen(all.includes(id) ? all.filter((one) => one !== id) : [...all, id]);
  };
  return { known, isShown, toggle };
}

// On the map, as long as the accuracy is drawn.
export function Legend() {
  return (
    <ul class="legend" aria-label={t("accuracy")}>
      {ACCURACY_STEPS.map(([most, colour]) => (
        <li>
          <svg width="12" height="12" aria-hidden="true">
            <rect width="12" height="12" fill={colour} />
          </svg>
          1σ ≤ {most} m
        </li>
      ))}
    </ul>
  );
}

// At a height above the stations: that of the site as it is, or that of a plan.
function Accuracy({ map, plans, onAccuracy }: { map: SiteMap; plans: UserMap[]; onAccuracy: (isShown: boolean) => void }) {
  const [accuracy, setAccuracy] = useState<AccuracyChoice | null>(null);
  const [failed, setFailed] = useState(false);
  const choose = (choice: AccuracyChoice | null) => {
    setAccuracy(choice);
    void map.showAccuracy(choice).then((shown) => {
      setFailed(!shown);
      onAccuracy(choice !== null && shown);
    });
  };
  return (
    <Fragment>
      <label>
        {t("accuracy")}
        <select value={JSON.stringify(accuracy)} onChange={(e) => choose(JSON.parse(e.currentTarget.value))}>
          <option value="null">{t("off")}</option>
          <optgroup label={t("site_now")}>
            {ABOVE_M.map((above_m) => (
              <option value={JSON.stringify({ above_m })}>{`${t("above")} ${above_m} m`}</option>
            ))}
          </optgroup>
          {plans.map((one) => (
            <optgroup label={one.name} key={one.id}>
              {one.above_m!.map((above_m) => (
                <option value={JSON.stringify({ above_m, plan: one.id })}>{`${one.name}, ${t("above")} ${above_m} m`}</option>
              ))}
            </optgroup>
          ))}
        </select>
      </label>
      {failed && <p class="map-problem" role="alert">{t("no_accuracy")}</p>}
    </Fragment>
  );
}

// The users' maps, each with its trouble in words, and the accuracy.
export function OwnMaps({ map, onAccuracy }: { map: SiteMap; onAccuracy: (isShown: boolean) => void }) {
  const { known, isShown, toggle } = useOwnMaps(map);
  return (
    <Fragment>
      {known.problem && <p class="map-problem" role="alert">{inWords(known.problem)}</p>}
      {known.maps.map((one) => (
        <Fragment key={one.id}>
          {one.zoom && (
            <button type="button" aria-pressed={isShown(one)} onClick={() => toggle(one.id)}>
              {one.name}
            </button>
          )}
          {one.problem && <p class="map-problem" role="alert">{`${one.name}: ${inWords(one.problem)}`}</p>}
        </Fragment>
      ))}
      <Accuracy map={map} plans={known.maps.filter((one) => one.above_m)} onAccuracy={onAccuracy} />
    </Fragment>
  );
}
