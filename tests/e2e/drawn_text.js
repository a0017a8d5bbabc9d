// Before the page begins: keeps what is written on each canvas, and where, until it is cleared.
(() => {
  const drawn = new Map(); // canvas -> size, texts
  const { fillText, clearRect } = CanvasRenderingContext2D.prototype;
  const before = { center: 0.5, right: 1, end: 1 }; // how much of a text is left of its place

  CanvasRenderingContext2D.prototype.clearRect = function (x, y, width, height) {
    if (width >= this.canvas.width && height >= this.canvas.height) drawn.delete(this.canvas);
    return clearRect.call(this, x, y, width, height);
  };
  CanvasRenderingContext2D.prototype.fillText = function (text, x, y, ...more) {
    const { width, height } = this.canvas;
    let of = drawn.get(this.canvas);
    if (of?.width !== width || of?.height !== height) drawn.set(this.canvas, (of = { width, height, texts: [] }));
    const at = new DOMPoint(x, y).matrixTransform(this.getTransform());
    const wide = this.measureText(text).width;
    of.texts.push({ text, left: at.x - wide * (before[this.textAlign] ?? 0), wide, middle: at.y });
    return fillText.call(this, text, x, y, ...more);
  };
  // Of the canvases within an element.
  window.drawnWithin = (element) => [...drawn].flatMap(([canvas, { texts }]) => (element.contains(canvas) && canvas.checkVisibility() ? texts : []));
})();
