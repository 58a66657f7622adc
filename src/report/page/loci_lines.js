// Converts curves to polylines, with so many points that they look smooth at the present zoom.

const LARGEST_CORNER = 0.25;  // largest distance in px of the curve from a chord

/** The point { place, x, y, real } of a chart at a place; `real`: whether the eigenvalue is. */
const pointOn = (stretch, project) => (place) => {
  const s = stretch.at(place), [x, y] = project(place, s);
  return { place, x, y, real: stretch.isReal(s) };
};

/**
 * Points of one stretch. `project(place, s)` gives [x, y]. `view` has the pixels per unit and the
 * visible window; lines outside of it are not refined. `spacing` is the largest distance of points in px.
 */
function drawnLine(stretch, project, view, spacing) {
  const point = pointOn(stretch, project), line = [];
  const refine = (a, b, depth) => {
    const middle = point(0.5 * (a.place + b.place));
    const dx = (b.x - a.x) * view.perX, dy = (b.y - a.y) * view.perY, length = Math.hypot(dx, dy);
    const mx = (middle.x - a.x) * view.perX, my = (middle.y - a.y) * view.perY;
    const corner = length > 0 ? Math.abs(dx * my - dy * mx) / length : Math.hypot(mx, my);
    const hidden = Math.max(a.x, b.x, middle.x) < view.x[0] || Math.min(a.x, b.x, middle.x) > view.x[1] ||
      Math.max(a.y, b.y, middle.y) < view.y[0] || Math.min(a.y, b.y, middle.y) > view.y[1];
    if (depth < 16 && !hidden && (corner > LARGEST_CORNER || length > spacing)) {
      refine(a, middle, depth + 1);
      refine(middle, b, depth + 1);
    } else {
      line.push(b);
    }
  };
  let last = null;
  for (const place of stretch.samples()) {
    const next = point(place);
    if (last) refine(last, next, 0); else line.push(next);
    last = next;
  }
  return line;
}

/**
 * The parts of a line that look alike: { points, kind }. `kindAt(place)` is a text; it may change at the places `cuts`
 * and once between two points. Neighbouring parts share a point.
 */
function partsOf(line, cuts, kindAt, pointAt) {
  const parts = [];
  for (let i = 0; i + 1 < line.length; ++i) {
    const inner = cuts.filter((cut) => cut > line[i].place && cut < line[i + 1].place).sort((u, v) => u - v).map(pointAt);
    const coarse = [line[i], ...inner, line[i + 1]];
    for (let k = 0; k + 1 < coarse.length; ++k) {
      const change = changeOf(kindAt, coarse[k].place, coarse[k + 1].place);
      const fine = change === null ? [coarse[k], coarse[k + 1]] : [coarse[k], pointAt(change), coarse[k + 1]];
      for (let m = 0; m + 1 < fine.length; ++m) {
        const kind = kindAt(0.5 * (fine[m].place + fine[m + 1].place)), last = parts[parts.length - 1];
        if (last && last.kind === kind) last.points.push(fine[m + 1]);
        else parts.push({ kind, points: [fine[m], fine[m + 1]] });
      }
    }
  }
  return parts;
}

/** The place at which the kind changes between two places, by bisection; null if it is the same near both. */
function changeOf(kindAt, from, to) {
  const inset = 1e-3 * (to - from), first = kindAt(from + inset);
  if (kindAt(to - inset) === first) return null;
  for (let k = 0; k < 30; ++k) {
    const middle = 0.5 * (from + to);
    if (kindAt(middle) === first) from = middle; else to = middle;
  }
  return 0.5 * (from + to);
}

/** The coordinates of several lines as arrays for Plotly, with null between the lines. */
function joined(lines) {
  const x = [], y = [];
  for (const line of lines) {
    if (x.length) { x.push(null); y.push(null); }
    for (const point of line) { x.push(point.x); y.push(point.y); }
  }
  return { x, y };
}

/** The line nearest to a pixel, its distance in px, and the place on the path there: { distance, line, place }. */
function nearestOnLines(lines, px, py) {
  let best = null;
  for (const line of lines) {
    const { points, pixels } = line;
    for (let i = 0; i + 1 < points.length; ++i) {
      const ax = pixels[2 * i], ay = pixels[2 * i + 1], dx = pixels[2 * i + 2] - ax, dy = pixels[2 * i + 3] - ay;
      const square = dx * dx + dy * dy;
      const share = square > 0 ? Math.min(Math.max(((px - ax) * dx + (py - ay) * dy) / square, 0), 1) : 0;
      const distance = Math.hypot(px - ax - share * dx, py - ay - share * dy);
      if (best === null || distance < best.distance)
        best = { distance, line, place: points[i].place + share * (points[i + 1].place - points[i].place) };
    }
  }
  return best;
}
