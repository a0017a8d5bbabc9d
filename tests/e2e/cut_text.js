// Texts of the page that a person cannot read: cut by what they stand in, or covered by something else.
// What lies outside of a scrolled part is looked at where it is scrolled to; what would have to be
// scrolled sideways counts as cut, and so does what the pictures' part would have to be scrolled for: it has
// the small pictures alone to scroll to. What is written on the map is looked at by drawn_text.js.
// Within one element, if a selector names it: a dialog covers what it stands before.
async (selector) => {
  const whole = document.querySelector(selector);
  const style = new CSSStyleSheet();
  style.replaceSync("* { pointer-events: auto !important; }"); // or nothing is found where nothing can be clicked
  document.adoptedStyleSheets = [style];
  const found = [];
  const isHidden = (element) => element.closest("option, [aria-hidden=true]") || getComputedStyle(element).clipPath !== "none" || !element.checkVisibility({ checkOpacity: true, checkVisibilityCSS: true });
  const say = (what, text, element) => found.push(`${what}: "${text.trim().slice(0, 40)}" in ${element.tagName.toLowerCase()}.${element.className}`);

  function cutBy(element, box) {
    for (let around = element; around && around !== document.documentElement; around = around.parentElement) {
      const { overflowX, overflowY } = getComputedStyle(around);
      const frame = around.getBoundingClientRect();
      if (overflowX !== "visible" && (box.left < frame.left - 1 || box.right > frame.right + 1)) return around;
      const isFixed = around.matches(".video") && element.closest(".cell.large");
      if ((overflowY === "hidden" || overflowY === "clip" || isFixed) && (box.top < frame.top - 1 || box.bottom > frame.bottom + 1)) return around;
    }
    return box.left < -1 || box.right > innerWidth + 1 ? document.body : null;
  }

  function bringToTheMiddle(element, box) {
    for (let around = element; around; around = around.parentElement) {
      if (around.scrollHeight <= around.clientHeight || !/auto|scroll/.test(getComputedStyle(around).overflowY)) continue;
      const frame = around.getBoundingClientRect();
      around.scrollBy(0, box.top + box.height / 2 - frame.top - frame.height / 2);
      return;
    }
  }

  function look(element, text, boxes) {
    if (isHidden(element) || element.closest(".notice")) return;
    element.scrollIntoView({ block: "center" });
    for (let around = element; around; around = around.parentElement) around.scrollLeft = 0;
    for (let i = 0; i < boxes().length; i++) {
      bringToTheMiddle(element, boxes()[i]);
      element.closest(".cell.large")?.closest(".video").scrollTo(0, 0);
      const box = boxes()[i];
      if (box.width < 1) continue;
      if (cutBy(element, box)) return say("cut", text, element);
      const [x, y] = [box.left + box.width / 2, box.top + box.height / 2];
      const top = document.elementsFromPoint(x, y).find((one) => !one.closest(".notice")); // which goes by itself
      if (!top || !(element.contains(top) || top.contains(element))) return say(`covered by ${top?.tagName}.${top?.className}`, text, element);
    }
  }

  function hasRoom(control, text) {
    const computed = getComputedStyle(control);
    const pen = document.createElement("canvas").getContext("2d");
    pen.font = computed.font;
    const arrow = control.tagName === "SELECT" ? 16 : 0;
    return pen.measureText(text).width + arrow <= control.clientWidth - parseFloat(computed.paddingLeft) - parseFloat(computed.paddingRight) + 1;
  }

  function lookAtMap() {
    const map = document.querySelector(".map-canvas");
    map.scrollIntoView({ block: "center" });
    const frame = map.getBoundingClientRect();
    const isCover = (one) => !map.contains(one) || one.closest(".ol-control");
    return window.drawnWithin(map).flatMap(({ text, left, wide, middle }) => {
      if (left < -1 || left + wide > frame.width + 1) return [`cut on the map: "${text}"`];
      const over = [left + 1, left + wide / 2, left + wide - 1].map((x) => document.elementsFromPoint(frame.left + x, frame.top + middle).find((one) => !one.closest(".notice") && !one.matches(".map-tools")));
      const cover = over.find((one) => one && isCover(one));
      return cover ? [`covered on the map by ${cover.tagName}.${cover.className}: "${text}"`] : [];
    });
  }

  // The map follows the page's new size when it is next drawn.
  async function lookAtMapOnceItIsDrawn() {
    const until = performance.now() + 10_000;
    let seen = lookAtMap();
    while (seen.length && performance.now() < until) {
      await new Promise(requestAnimationFrame);
      seen = lookAtMap();
    }
    found.push(...seen);
  }

  if (whole.querySelector(".map-canvas")?.checkVisibility()) await lookAtMapOnceItIsDrawn();
  const walker = document.createTreeWalker(whole, NodeFilter.SHOW_TEXT);
  const texts = [];
  while (walker.nextNode()) if (walker.currentNode.data.trim()) texts.push(walker.currentNode);
  for (const node of texts) {
    const range = document.createRange();
    range.selectNodeContents(node);
    look(node.parentElement, node.data, () => range.getClientRects());
  }
  for (const control of whole.querySelectorAll("select, input:not([type=checkbox], [type=range])")) {
    const text = control.tagName === "SELECT" ? (control.selectedOptions[0]?.text ?? "") : control.value;
    look(control, text, () => [control.getBoundingClientRect()]);
    if (!isHidden(control) && !hasRoom(control, text)) say("cut", text, control);
  }
  document.adoptedStyleSheets = [];
  document.querySelectorAll("*").forEach((one) => one.scrollTo(0, 0));
  scrollTo(0, 0);
  return found;
}
