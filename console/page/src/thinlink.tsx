// The choice of a thin link: pictures as H.264, where this browser decodes it.

import { h } from "preact";
import { useEffect, useState } from "preact/hooks";
import { decodesH264 } from "./h264";
import type { Codec, Link } from "./link";
import { remember, remembered } from "./memory";
import { t } from "./words";

type ThinLink = { isThin: boolean; isRefused: boolean; codec: Codec; choose: (isThin: boolean) => void };

export function useThinLink(link: Link): ThinLink {
  const [isThin, setThin] = useState(remembered("thin", "no") === "yes");
  const [decodes, setDecodes] = useState<boolean | null>(null); // null: it has not said yet
  useEffect(() => {
    void decodesH264().then(setDecodes);
    link.onNoStream = () => setDecodes(false);
  }, []);
  const choose = (wanted: boolean) => {
    setThin(wanted);
    remember("thin", wanted ? "yes" : "no");
  };
  return { isThin, isRefused: isThin && decodes === false, codec: isThin && decodes ? "h264" : "jpeg", choose };
}

export function ThinLinkChoice({ isThin, isRefused, choose }: ThinLink) {
  return (
    <label class="thin">
      <input type="checkbox" checked={isThin} onChange={(event) => choose(event.currentTarget.checked)} />
      {t("thin_link")} <span role="status">{isRefused ? t("thin_no") : ""}</span>
    </label>
  );
}
