// The map's scale, in metres however near it is: OpenLayers says "1000 mm".

import ScaleLine from "ol/control/ScaleLine";
import type MapEvent from "ol/MapEvent";
import { inMetres } from "./format";

export class ScaleInMetres extends ScaleLine {
  render(event: MapEvent) {
    super.render(event);
    const line = (this.element as HTMLElement).querySelector(".ol-scale-line-inner");
    if (line?.textContent?.endsWith(" mm")) line.textContent = inMetres(line.textContent);
  }
}
