// The map with its tools.

import { h } from "preact";
import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import type { Link } from "./link";
import { OwnMaps } from "./ownmaps";
import { SiteMap } from "./sitemap";
import { View3d } from "./view3d";
import { t } from "./words";

type Props = { link: Link; version: number; theme: string; selected: string; onPick: (pick: string) => void };

export function MapView({ link, version, theme, selected, onPick }: Props) {
  const element = useRef<HTMLDivElement>(null);
  const map = useRef<SiteMap | null>(null);
  const [options, setOptions] = useState({ rings: true, grid: true, trails: true, views: true, limits: true, follow: false, measuring: false });
  const [measured, setMeasured] = useState("");
  const [made, setMade] = useState<SiteMap | null>(null);
  const [isSolid, setSolid] = useState(false);
  useEffect(() => {
    const one = new SiteMap(link, element.current!);
    map.current = one;
    one.onMeasured = setMeasured;
    setMade(one);
    return () => one.map.setTarget(undefined);
  }, []);
  useEffect(() => map.current?.restyle(), [theme]);
  useEffect(() => {
    if (!map.current) return;
    map.current.onPick = onPick;
    map.current.selected = selected;
    map.current.draw();
  }, [selected, onPick]);
  // In the frame in which the news came: an effect and the map's own rendering would take two more.
  useLayoutEffect(() => map.current?.drawNow(), [version]);
  const toggle = (name: keyof typeof options) => {
    const value = !options[name];
    setOptions({ ...options, [name]: value });
    if (name === "measuring") setMeasured("");
    map.current?.setOption(name, value);
  };
  // What was measured belongs to the view in which it was.
  const showSolid = () => {
    setSolid(!isSolid);
    setMeasured("");
    map.current?.endMeasuring();
  };
  const button = (name: keyof typeof options, text: string) => (
    <button type="button" aria-pressed={options[name]} onClick={() => toggle(name)}>
      {text}
    </button>
  );
  return (
    <section class="map" aria-label={t("map")}>
      <div class="map-canvas" ref={element} tabIndex={0} role="application" aria-label={t("map")} />
      {isSolid && <View3d link={link} version={version} theme={theme} selected={selected} options={options} onPick={onPick} onMeasured={setMeasured} />}
      <div class="map-tools" role="toolbar" aria-label={t("layers")}>
        {!isSolid && (
          <button type="button" onClick={() => map.current?.fit()}>
            {t("fit")}
          </button>
        )}
        {button("follow", t("follow"))}
        <button type="button" aria-pressed={isSolid} onClick={showSolid}>
          {t("view_3d")}
        </button>
        {button("measuring", t("measure"))}
        <details class="layers">
          <summary>{t("layers")}</summary>
          <div>
            {button("grid", t("grid"))}
            {button("rings", t("rings"))}
            {button("trails", t("trails"))}
            {button("views", t("views"))}
            {button("limits", t("limits"))}
            {isSolid && <p class="layers-note">{t("flat_only")}</p>}
            {made && (
              <fieldset disabled={isSolid}>
                <OwnMaps map={made} />
              </fieldset>
            )}
          </div>
        </details>
      </div>
      {!isSolid && (
        <div class="map-north" aria-hidden="true">
          <span>N</span>
        </div>
      )}
      {options.measuring && (
        <output class="map-measure">{measured || t(isSolid ? "measure_hint_3d" : "measure_hint")}</output>
      )}
    </section>
  );
}
