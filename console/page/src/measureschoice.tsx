// The choice of units and of how positions are written.

import { h, Fragment } from "preact";
import { measures, POSITIONS, setPositionFormat, setUnits, UNITS } from "./measures";
import { t, type Word } from "./words";

// Everything that shows them is drawn anew with the next state, a moment later.
export function MeasuresChoice() {
  return (
    <Fragment>
      <select aria-label={t("units")} value={measures.units} onChange={(e) => setUnits(UNITS[e.currentTarget.selectedIndex])}>
        {UNITS.map((one) => (
          <option value={one}>{t(`u_${one}` as Word)}</option>
        ))}
      </select>
      <select aria-label={t("position_format")} value={measures.position} onChange={(e) => setPositionFormat(POSITIONS[e.currentTarget.selectedIndex])}>
        {POSITIONS.map((one) => (
          <option value={one}>{t(`f_${one}` as Word)}</option>
        ))}
      </select>
    </Fragment>
  );
}
