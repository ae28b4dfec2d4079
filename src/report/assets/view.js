// A panel is looked at through a view: the part of each axis that its frame shows, in fractions of
// the axis as it was drawn.
const CLOSEST = 1 / 500; // least part of an axis that a view shows

class View {
  constructor(data) {
    this.frame = data.frame;
    this.x = new Axis(data.x);
    this.y = new Axis(data.y);
    this.whole();
  }

  whole() {
    this.view = { x: [0, 1], y: [0, 1] };
  }

  get isWhole() {
    return this.view.x[1] - this.view.x[0] >= 1 && this.view.y[1] - this.view.y[0] >= 1;
  }

  // Where a point of the data stands, pixels of the drawing.
  place([x, y]) {
    return this.seen([this.x.fraction(x), this.y.fraction(y)]);
  }

  seen([fx, fy]) {
    const [left, top, width, height] = this.frame;
    const { x, y } = this.view;
    return [
      left + (width * (fx - x[0])) / (x[1] - x[0]),
      top + height * (1 - (fy - y[0]) / (y[1] - y[0])),
    ];
  }

  // Fractions of the axes at a place.
  at([px, py]) {
    const [left, top, width, height] = this.frame;
    const { x, y } = this.view;
    return [
      x[0] + ((px - left) / width) * (x[1] - x[0]),
      y[0] + (1 - (py - top) / height) * (y[1] - y[0]),
    ];
  }

  holds([px, py]) {
    const [left, top, width, height] = this.frame;
    return px >= left - 0.5 && px <= left + width + 0.5 && py >= top - 0.5 && py <= top + height + 0.5;
  }

  // Looks closer (factor > 1) about a point that stays where it is.
  zoom(factor, [fx, fy]) {
    for (const [axis, fixed] of [["x", fx], ["y", fy]]) {
      const [from, to] = this.view[axis];
      const span = Math.min(1, Math.max(CLOSEST, (to - from) / factor));
      this.set(axis, fixed - ((fixed - from) / (to - from)) * span, span);
    }
  }

  // Moves the view by shares of what it shows.
  pan(dx, dy) {
    for (const [axis, share] of [["x", dx], ["y", dy]]) {
      const [from, to] = this.view[axis];
      this.set(axis, from + share * (to - from), to - from);
    }
  }

  set(axis, from, span) {
    const start = Math.min(1 - span, Math.max(0, from));
    this.view[axis] = [start, start + span];
  }
}
