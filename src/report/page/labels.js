// Places texts in figures so that they lie neither on each other nor on marks. All lengths are in px, y downwards.

const LABEL_HEIGHT = 13;
const MARK_SIZE = 12;  // of the square that an event's mark takes

/** Width of a text in px. */
const textWidth = (() => {
  let pen = null;
  return (text, size) => {
    pen = pen || document.createElement("canvas").getContext("2d");
    pen.font = `${size}px system-ui, sans-serif`;
    return pen.measureText(text).width;
  };
})();

/** A box { left, right, top, bottom } of a width and height about a middle. */
const boxAbout = (x, y, width, height) => ({ left: x - width / 2, right: x + width / 2, top: y - height / 2, bottom: y + height / 2 });
const boxesOverlap = (a, b) => a.left < b.right && a.right > b.left && a.top < b.bottom && a.bottom > b.top;
const boxInside = (a, b) => a.left >= b.left && a.right <= b.right && a.top >= b.top && a.bottom <= b.bottom;

const SIDES = [[0, -1], [0, 1], [1, 0], [-1, 0], [1, -1], [-1, -1], [1, 1], [-1, 1]];

/** Middles of a text of this width beside a mark at (x, y), best first; then the same farther away. */
function besideMark(x, y, width) {
  return [1, 2.1].flatMap((far) => SIDES.map(([dx, dy]) =>
    [x + dx * (width / 2 + 8 * (dy ? far : 1)), y + dy * 13.5 * far]));
}

/** Whether the straight line from a to b has a point in a box. */
function lineMeetsBox([ax, ay], [bx, by], box) {
  let from = 0, to = 1;
  for (const [begin, step, low, high] of [[ax, bx - ax, box.left, box.right], [ay, by - ay, box.top, box.bottom]]) {
    if (step === 0) {
      if (begin < low || begin > high) return false;
      continue;
    }
    const [first, last] = [(low - begin) / step, (high - begin) / step].sort((a, b) => a - b);
    from = Math.max(from, first);
    to = Math.min(to, last);
  }
  return from <= to;
}

/**
 * Chooses the place of every label: the first of its middles at which it is inside of `area`, free of the boxes
 * `taken`, to which it is added, and on none of `lines` (lists of points [x, y]); if there is none, the first on a
 * line. A label { texts, size, middles(width) } may have shorter texts for want of room. Sets its `text`, `x`, `y` and
 * `box`; the text is empty if there is no room.
 */
function placeLabels(labels, taken, area, lines = []) {
  const onLine = (box) => lines.some((line) => line.some((point, i) => i > 0 && lineMeetsBox(line[i - 1], point, box)));
  for (const label of labels) {
    Object.assign(label, { text: "", x: null, y: null, box: null });
    label.texts.some((text) => {
      const width = textWidth(text, label.size || 11) + 4;
      const free = label.middles(width).map(([x, y]) => ({ text, x, y, box: boxAbout(x, y, width, LABEL_HEIGHT) }))
        .filter(({ box }) => boxInside(box, area) && !taken.some((other) => boxesOverlap(box, other)));
      if (!free.length) return false;
      Object.assign(label, free.find(({ box }) => !onLine(box)) || free[0]);
      taken.push(label.box);
      return true;
    });
  }
  return labels.filter((label) => label.text);
}

/** Lines of a chart in pixels of its view. */
function linePixels(lines, view) {
  const { fromX, fromY } = viewPixels(view);
  return lines.map(({ points }) => points.map(({ x, y }) => [fromX(x), fromY(y)]));
}

/**
 * Heights of labels in one column that want to stand at `wanted`, with at least `gap` between them, from `top` to
 * `bottom`, moved as little as possible; null for those that find no room: first those with the nearest neighbours.
 */
function spreadLabels(wanted, gap, top, bottom) {
  let order = wanted.map((y, i) => ({ y: Math.min(Math.max(y, top), bottom), i })).sort((a, b) => a.y - b.y || a.i - b.i);
  const room = Math.max(Math.floor((bottom - top) / gap) + 1, 1);
  while (order.length > room) {
    let nearest = 1;
    for (let k = 2; k < order.length; ++k)
      if (order[k].y - order[k - 1].y < order[nearest].y - order[nearest - 1].y) nearest = k;
    order = order.filter((_, k) => k !== nearest);
  }
  // Groups of labels that touch stand about the mean of their wishes.
  const groups = [];
  for (const { y } of order) {
    groups.push({ sum: y, n: 1 });
    for (;;) {
      const last = groups[groups.length - 1], before = groups[groups.length - 2];
      const begin = (group) => Math.min(Math.max(group.sum / group.n - (gap * (group.n - 1)) / 2, top), bottom - gap * (group.n - 1));
      last.begin = begin(last);
      if (!before || before.begin + gap * before.n <= last.begin) break;
      groups.pop();
      before.sum += last.sum;
      before.n += last.n;
    }
  }
  const heights = groups.flatMap((group) => Array.from({ length: group.n }, (_, k) => group.begin + k * gap));
  const placed = wanted.map(() => null);
  order.forEach(({ i }, k) => { placed[i] = heights[k]; });
  return placed;
}

/** The trace of placed labels; their pixels are turned into coordinates of the view. */
function labelTrace(placed, view, plot, meta) {
  const pixels = viewPixels(view);
  return {
    x: placed.map(({ x }) => pixels.toX(x)), y: placed.map(({ y }) => pixels.toY(y)), text: placed.map(({ text }) => plotText(text)),
    type: "scatter", mode: "text", textposition: "middle center", cliponaxis: false, hoverinfo: "skip", showlegend: false,
    textfont: { color: placed.map(({ colour }) => colour || INK), size: placed.map(({ size }) => size || 11) }, meta: { labels: meta }, ...plot,
  };
}

/** Conversions between coordinates and pixels of a view, from its upper left corner. */
function viewPixels(view) {
  return {
    toX: (px) => view.x[0] + px / view.perX, toY: (py) => view.y[1] - py / view.perY,
    fromX: (x) => (x - view.x[0]) * view.perX, fromY: (y) => (view.y[1] - y) * view.perY,
    area: { left: 1, top: 1, right: (view.x[1] - view.x[0]) * view.perX - 1, bottom: (view.y[1] - view.y[0]) * view.perY - 1 },
  };
}
