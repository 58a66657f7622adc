"""Places texts on a panel so that they do not lie on each other, on marks, and as little as possible on lines."""

import numpy as np

from .picture import Label, Line, Marks

CHARACTER = 0.6   # width of a character, as a share of the size of the text
HEIGHT = 1.15     # of a line of text
SIDES = [("center", 0, 1), ("center", 0, -1), ("left", 1, 0), ("right", -1, 0), ("left", 1, 1), ("right", -1, 1),
         ("left", 1, -1), ("right", -1, -1)]
GAP = 3.0         # points between texts beside each other
SPACING = 3.0     # points between the places of a line that are kept free


def text_width(text, size):
    """Width of a text in points, at least as wide as it is drawn."""
    return CHARACTER * size * len(text)


class Room:
    """What is taken on a panel, in points."""

    def __init__(self, panel):
        self._panel = panel
        self._boxes = np.empty((0, 4))
        dots = np.vstack([np.empty((0, 2)), *(_along(*panel.place(line.x, line.y)) for line in panel.of(Line))])
        self._dots = dots[np.isfinite(dots).all(axis=1)].T
        for marks in panel.of(Marks):
            x, y = panel.place(marks.x, marks.y)
            half = 0.5 * marks.size + 1
            self.take(np.column_stack([x - half, x + half, y - half, y + half]))

    def take(self, boxes):
        """Boxes (n, 4): left, right, bottom, top."""
        boxes = np.atleast_2d(boxes)
        self._boxes = np.vstack([self._boxes, boxes[np.isfinite(boxes).all(axis=1)]])

    def free(self, box):
        """Whether a box lies on the panel and on no other."""
        left, right, bottom, top = box
        width, height = self._panel.points
        if left < 0 or right > width or bottom < 0 or top > height:
            return False
        boxes = self._boxes
        return not np.any((boxes[:, 0] < right) & (boxes[:, 1] > left) & (boxes[:, 2] < top) & (boxes[:, 3] > bottom))

    def covered(self, box):
        """Number of places of lines under a box."""
        left, right, bottom, top = box
        x, y = self._dots
        return int(np.sum((x >= left) & (x < right) & (y > bottom) & (y < top)))

    def beside(self, x, y, text, size, distance, colour="#1a1a1a"):
        """Puts a label on the side of a place (data coordinates) that covers least; whether a side was free."""
        px, py = self._panel.place(x, y)
        if not (np.isfinite(px) and np.isfinite(py)):
            return False
        width, height = text_width(text, size) + GAP, HEIGHT * size
        places = []
        for align, dx, dy in SIDES:
            left = px + (dx * distance if dx else -width / 2) - (width if align == "right" else 0)
            bottom = py + dy * (distance + height / 2 if not dx else 0.6 * height) - height / 2
            places.append(((left, left + width, bottom, bottom + height),
                           Label(x, y, text, colour, size, align, dx * distance, bottom + height / 2 - py)))
        return self._put_best(places)

    def _put_best(self, places):
        """Puts the first one of those labels (box, label) that are free and cover least; whether there is one."""
        costs = [(self.covered(box), i) for i, (box, _) in enumerate(places) if self.free(box)]
        if costs:
            cost, best = min(costs)
            box, label = places[best]
            label.halo = cost > 0
            self.take(box)
            self._panel.items.append(label)
        return bool(costs)

    def on_line(self, xs, ys, text, size, colour, most=2):
        """Puts labels on the best of these places of a line (data coordinates), far from each other; whether one was free."""
        width, height = text_width(text, size) + 1, HEIGHT * size
        px, py = self._panel.place(xs, ys)
        boxes = np.column_stack([px - width / 2, px + width / 2, py - height / 2, py + height / 2])
        places = []
        for at in sorted(np.flatnonzero([self.free(box) for box in boxes]), key=lambda at: self.covered(boxes[at])):
            if len(places) < most and all(np.hypot(px[at] - a, py[at] - b) > self._panel.points[0] / 3 for a, b in places):
                self.take(boxes[at])
                places.append((px[at], py[at]))
                self._panel.items.append(Label(xs[at], ys[at], text, colour, size, "center", boxed=True))
        return bool(places)

    def at_end(self, xs, ys, text, size, colour):
        """Puts a label left above a line that ends at the last place, as near to the end as the text covers no other line."""
        px, py = self._panel.place(xs, ys)
        width, height = text_width(text, size), HEIGHT * size
        self._put_best([((px[at] - 4 - width, px[at] - 4, py[at] + 1, py[at] + 1 + height),
                         Label(xs[at], ys[at], text, colour, size, "right", -4, 1 + height / 2))
                        for at in range(len(px) - 1, int(0.5 * len(px)), -1)])


def _along(x, y):
    """Places (k, 2) along a line at most SPACING points apart."""
    x, y = (np.where(np.isfinite(values), values, np.nan) for values in (x, y))
    if len(x) < 2:
        return np.empty((0, 2))
    with np.errstate(invalid="ignore"):
        count = np.minimum(np.hypot(np.diff(x), np.diff(y)) / SPACING, 400)
    count = np.where(np.isfinite(count), np.maximum(np.ceil(count), 1), 0).astype(int)
    which = np.repeat(np.arange(len(count)), count)
    share = (np.arange(len(which)) - np.repeat(np.cumsum(count) - count, count)) / np.maximum(count[which], 1)
    return np.column_stack([x[which] + share * (x[which + 1] - x[which]), y[which] + share * (y[which + 1] - y[which])])


def spread(heights, gap, low, high):
    """Heights (n) moved as little as needed so that they are `gap` apart and lie between low and high."""
    order = np.argsort(heights, kind="stable")
    placed = np.array(heights, float)[order]
    for i in range(1, len(placed)):
        placed[i] = max(placed[i], placed[i - 1] + gap)
    ceiling = high
    for i in reversed(range(len(placed))):
        placed[i] = min(placed[i], ceiling)
        ceiling = placed[i] - gap
    result = np.empty_like(placed)
    result[order] = np.maximum(placed, low) if len(placed) * gap <= high - low else placed
    return result
