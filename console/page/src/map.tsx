// The map with its tools.

import { h, type RefObject } from "preact";
import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import { useEscape, useHeld } from "./escape";
import { useLand } from "./land";
import type { Link } from "./link";
import { measures } from "./measures";
import { Menu } from "./menu";
import { Legend, OwnMaps } from "./ownmaps";
import { OPTIONS, SiteMap } from "./sitemap";
import type { Corner } from "./site";
import { View3d } from "./view3d";
import { t } from "./words";

type Options = typeof OPTIONS;
type Props = { link: Link; version: number; theme: string; selected: string; draft: Corner[] | null; onPick: (pick: string) => void; onCorner: (corner: Corner) => void };

// The map in its element, which follows what the page shows; null until it is made.
function useSiteMap(element: RefObject<HTMLDivElement>, { link, version, theme, selected, draft, onPick, onCorner }: Props, onMeasured: (text: string) => void): SiteMap | null {
  const map = useRef<SiteMap | null>(null);
  const [made, setMade] = useState<SiteMap | null>(null);
  useEffect(() => {
    const one = new SiteMap(link, element.current!);
    map.current = one;
    one.onMeasured = onMeasured;
    setMade(one);
    return () => one.map.setTarget(undefined);
  }, []);
  useEffect(() => map.current?.restyle(), [theme]);
  useEffect(() => map.current?.remeasure(), [measures.units]);
  useEffect(() => {
    if (!map.current) return;
    map.current.onPick = onPick;
    map.current.onCorner = onCorner;
    map.current.selected = selected;
    map.current.draft = draft;
    map.current.draw();
  }, [selected, draft, onPick, onCorner]);
  // In the frame in which the news came: an effect and the map's own rendering would take two more.
  useLayoutEffect(() => map.current?.drawNow(), [version]);
  return made;
}

type ToolsProps = { map: SiteMap | null; options: Options; isSolid: boolean; hasLand: boolean; onToggle: (name: keyof Options) => void; onSolid: () => void; onAccuracy: (isShown: boolean) => void };

function Tools({ map, options, isSolid, hasLand, onToggle, onSolid, onAccuracy }: ToolsProps) {
  const button = (name: keyof Options, text: string) => (
    <button type="button" aria-pressed={options[name]} onClick={() => onToggle(name)}>
      {text}
    </button>
  );
  return (
    <div class="map-tools" role="toolbar" aria-label={t("layers")}>
      {!isSolid && (
        <button type="button" onClick={() => map?.fit()}>
          {t("fit")}
        </button>
      )}
      {button("follow", t("follow"))}
      <button type="button" aria-pressed={isSolid} onClick={onSolid}>
        {t("view_3d")}
      </button>
      {button("measuring", t("measure"))}
      {!isSolid && button("placing", t("place"))}
      <Menu class="layers" word={t("layers")}>
        <div>
          {isSolid && hasLand && button("terrain", t("terrain"))}
          {button("grid", t("grid"))}
          {button("rings", t("rings"))}
          {button("trails", t("trails"))}
          {button("views", t("views"))}
          {button("limits", t("limits"))}
          {isSolid && <p class="layers-note">{t("flat_only")}</p>}
          {map && (
            <fieldset disabled={isSolid}>
              <OwnMaps map={map} onAccuracy={onAccuracy} />
            </fieldset>
          )}
        </div>
      </Menu>
    </div>
  );
}

export function MapView(props: Props) {
  const element = useRef<HTMLDivElement>(null);
  const [options, setOptions] = useState(OPTIONS);
  const [measured, setMeasured] = useState("");
  const [isSolid, setSolid] = useState(false);
  const [hasAccuracy, setAccuracy] = useState(false);
  const [ground, setGround] = useState("");
  const land = useLand(props.link);
  const map = useSiteMap(element, props, setMeasured);
  const set = (changed: Partial<Options>) => {
    setOptions((before) => ({ ...before, ...changed }));
    for (const [name, value] of Object.entries(changed)) map?.setOption(name as keyof Options, value);
  };
  const toggle = (name: keyof Options) => {
    setMeasured(name === "measuring" ? "" : measured);
    // A click means one thing at a time.
    const other = name === "measuring" ? { placing: false } : name === "placing" ? { measuring: false } : {};
    set({ ...other, [name]: !options[name] });
  };
  if (map) map.onPlaced = () => set({ placing: false });
  if (map) map.onGround = setGround;
  if (map) map.hasGround = land != null;
  useEscape(options.measuring, () => toggle("measuring"));
  useEscape(options.placing, () => toggle("placing"));
  const hold = useHeld(() => map?.cancelBox());
  // What was measured belongs to the view in which it was.
  const showSolid = () => {
    setSolid(!isSolid);
    setMeasured("");
    map?.endMeasuring();
  };
  return (
    <section class="map" aria-label={t("map")} onPointerDown={hold}>
      <div class="map-canvas" ref={element} tabIndex={0} role="application" aria-label={t("map")} />
      {isSolid && <View3d {...props} land={land} options={options} onMeasured={setMeasured} />}
      <Tools map={map} options={options} isSolid={isSolid} hasLand={land != null} onToggle={toggle} onSolid={showSolid} onAccuracy={setAccuracy} />
      {hasAccuracy && !isSolid && <Legend />}
      {!isSolid && (
        <div class="map-north" aria-hidden="true">
          <span>N</span>
        </div>
      )}
      {ground && !isSolid && <p class="map-ground">{ground}</p>}
      {options.placing && !isSolid && <output class="map-measure">{t("place_hint")}</output>}
      {options.measuring && (
        <output class="map-measure">{measured || t(isSolid ? "measure_hint_3d" : "measure_hint")}</output>
      )}
    </section>
  );
}
