// A panel of a chart: what is drawn in it, moved with its view, and the points of its curves.
const NEAR = 30; // pixels within which a curve or a point is meant
const SVG = "http://www.w3.org/2000/svg";

function element(name, attributes, parent) {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  parent?.append(made);
  return made;
}

class Panel extends View {
  constructor(group, data) {
    super(data);
    this.group = group;
    this.title = data.title;
    this.curves = data.curves;
    this.marks = data.marks;
  }

  // What moves with the view: curves are stretched, everything with a shape of its own floats.
  prepare() {
    if (this.stretched) return;
    const clip = `url(#${this.group.querySelector(":scope > clipPath").id})`;
    const layer = (before, children, own) => {
      const outer = own ?? element("g", { "clip-path": clip });
      if (!own) before.before(outer);
      const inner = element("g", { class: "stretched" });
      inner.append(...children);
      outer.append(inner);
      return inner;
    };
    const all = (selector) => [...this.group.querySelectorAll(`:scope > ${selector}`)];
    const curves = this.group.querySelector(":scope > .curves");
    const dots = [...curves.querySelectorAll("circle")];
    this.stretched = [layer(null, [...curves.children], curves)];
    for (const parts of [all(".shade"), [...all(".hatch"), ...all(".limit")]]) {
      if (parts.length) this.stretched.push(layer(parts[0], parts));
    }
    const marks = this.group.querySelector(":scope > .marks");
    marks.before(...dots);
    const texts = [...this.group.querySelectorAll(":scope > .labels > text"), ...all("text.label")];
    const labels = texts.map((text) => {
      const whole = element("g", {});
      const gap = text.previousElementSibling;
      text.before(whole);
      if (gap?.classList.contains("paper")) whole.append(gap);
      whole.append(text);
      return whole;
    });
    this.floating = [...dots, ...marks.children, ...labels].map((node) => {
      const box = node.getBBox();
      return { node, centre: [box.x + box.width / 2, box.y + box.height / 2] };
    });
    this.grid = element("g", { class: "grid view" });
    this.group.querySelector(":scope > .grid").after(this.grid);
    this.axes = element("g", { class: "axis view" }, this.group);
  }

  show() {
    this.prepare();
    const zoomed = !this.isWhole;
    this.group.classList.toggle("zoomed", zoomed);
    const [left, top, width, height] = this.frame;
    const { x, y } = this.view;
    const a = 1 / (x[1] - x[0]);
    const d = 1 / (y[1] - y[0]);
    // From a place in the whole drawing to its place in the view.
    const e = left - a * (left + x[0] * width);
    const f = top - d * (top + (1 - y[1]) * height);
    for (const part of this.stretched) {
      if (zoomed) part.setAttribute("transform", `matrix(${a} 0 0 ${d} ${e} ${f})`);
      else part.removeAttribute("transform");
    }
    for (const { node, centre } of this.floating) {
      const to = [a * centre[0] + e, d * centre[1] + f];
      if (zoomed) {
        node.setAttribute("transform", `translate(${to[0] - centre[0]} ${to[1] - centre[1]})`);
      } else node.removeAttribute("transform");
      node.classList.toggle("outside", zoomed && !this.holds(to));
    }
    this.grid.replaceChildren();
    this.axes.replaceChildren();
    if (zoomed) this.rule();
  }

  rule() {
    const [left, top, width, height] = this.frame;
    const line = (d, kind, parent) => element("path", { class: kind, d }, parent);
    const text = (label, x, y, anchor) => {
      const made = element("text", { class: "tick-label", x, y, "text-anchor": anchor }, this.axes);
      made.textContent = label;
    };
    for (const [unit, [, factor]] of this.x.units.slice(0, 2).entries()) {
      for (const { value, label } of this.x.ticks(this.view.x, factor)) {
        const [at] = this.seen([this.x.fraction(value), 0]);
        const edge = unit ? top : top + height;
        line(`M${at} ${edge}v${unit ? -5 : 5}`, "tick", this.axes);
        text(label, at, unit ? edge - 8 : edge + 15, "middle");
        if (!unit) line(`M${at} ${top}v${height}`, "major", this.grid);
      }
    }
    for (const [unit, [, factor]] of this.y.units.slice(0, 2).entries()) {
      for (const { value, label } of this.y.ticks(this.view.y, factor)) {
        const [, at] = this.seen([0, this.y.fraction(value)]);
        const edge = unit ? left + width : left;
        line(`M${edge} ${at}h${unit ? 5 : -5}`, "tick", this.axes);
        text(label, edge + (unit ? 8 : -8), at + 4, unit ? "start" : "end");
        if (!unit) line(`M${left} ${at}h${width}`, "major", this.grid);
      }
    }
  }

  // The point of a curve nearest to a place, on the line between its points too.
  nearest(place) {
    let best = null;
    for (const [index, mark] of this.marks.entries()) {
      const at = this.place(mark.at);
      const far = Math.hypot(at[0] - place[0], at[1] - place[1]);
      if (far < 9 && this.holds(at) && !(best && best.far <= far)) best = { far, label: mark.label, point: mark.at, mark: index };
    }
    if (best) return best;
    for (const curve of this.curves) {
      for (const piece of curve.pieces) {
        let last = null;
        for (const point of piece) {
          const here = this.place(point);
          const along = last ? foot(last, here, place) : 0;
          const at = last ? last.map((c, k) => c + along * (here[k] - c)) : here;
          const far = Math.hypot(at[0] - place[0], at[1] - place[1]);
          if (far < NEAR && !(best && best.far <= far) && this.holds(at)) {
            const [fx, fy] = this.at(at);
            best = { far, label: curve.label, point: [this.x.value(fx), this.y.value(fy)] };
          }
          last = here;
        }
      }
    }
    return best;
  }
}

// Where on the way from one place to another a third is nearest, 0 to 1.
function foot(from, to, place) {
  const way = [to[0] - from[0], to[1] - from[1]];
  const long = way[0] ** 2 + way[1] ** 2;
  if (long === 0) return 0;
  const t = ((place[0] - from[0]) * way[0] + (place[1] - from[1]) * way[1]) / long;
  return Math.min(1, Math.max(0, t));
}
