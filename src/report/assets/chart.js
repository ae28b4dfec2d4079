// Charts: values under the pointer, along curves by keyboard, and a closer look at a panel.
//
// A chart's data stand beside it in SI units. A panel is looked at through a view: the part of each
// axis that its frame shows, in fractions of the axis as it was drawn.
const SVG = "http://www.w3.org/2000/svg";
const NEAR = 30; // pixels within which a curve or a point is meant
const CLOSEST = 1 / 500; // least part of an axis that a view shows

function element(name, attributes, parent) {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  parent?.append(made);
  return made;
}

const RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹";

function raised(power) {
  return [...String(power)].map((c) => (c === "-" ? "⁻" : RAISED[c])).join("");
}

// A number with some significant figures, powers of ten only where plain digits get unreadable.
function written(x, figures) {
  if (x === 0) return "0";
  if (!Number.isFinite(x)) return "–";
  const [digits, exponent] = x.toExponential(figures - 1).split("e");
  if (exponent < -4 || exponent > 6) {
    return `${Number(digits)}·10${raised(Number(exponent))}`;
  }
  return Number(x.toPrecision(figures)).toFixed(Math.max(0, figures - 1 - exponent));
}

class Axis {
  constructor(data) {
    Object.assign(this, data);
    [this.first, this.last] = data.range.map((v) => this.scaled(v));
  }

  scaled(value) {
    return this.log ? Math.log(value) : value;
  }

  fraction(value) {
    return (this.scaled(value) - this.first) / (this.last - this.first);
  }

  value(fraction) {
    const scaled = this.first + fraction * (this.last - this.first);
    return this.log ? Math.exp(scaled) : scaled;
  }

  // A value in its units, as in "1760 kN m/rad (1.30·10⁶ lbf ft/rad)".
  written(value) {
    const texts = this.units.map(([label, factor]) => {
      const space = label === "" || label === "°" ? "" : " ";
      return written(value / factor, 4) + space + label;
    });
    return texts.length > 1 ? `${texts[0]} (${texts[1]})` : texts[0];
  }

  // Round values of a unit within a part of the axis, SI.
  ticks([from, to], factor) {
    const [low, high] = [this.value(from) / factor, this.value(to) / factor];
    const found = [];
    if (this.log && high / low > 8) {
      for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high); power += 1) {
        for (const digit of [1, 2, 5]) found.push(digit * 10 ** power);
      }
    } else {
      const size = 10 ** Math.floor(Math.log10((high - low) / 4));
      const step = [1, 2, 5, 10].find((s) => s * size >= (high - low) / 6) * size;
      for (let k = Math.ceil(low / step); k * step <= high; k += 1) found.push(k * step);
    }
    return found
      .filter((v) => v >= low * (1 - 1e-9) && v <= high * (1 + 1e-9))
      .map((v) => ({ value: v * factor, label: tick(v) }));
  }
}

// A value at an axis: narrow, for its title stands beside it.
function tick(value) {
  const plain = Number(value.toPrecision(6));
  const size = Math.abs(plain);
  if (size === 0 || (size >= 1e-3 && size < 1e4)) return String(plain);
  const [digits, exponent] = plain.toExponential().split("e");
  const power = `10${raised(Number(exponent))}`;
  return digits === "1" ? power : `${digits}·${power}`;
}

class Panel {
  constructor(group, data) {
    this.group = group;
    this.title = data.title;
    this.frame = data.frame;
    this.x = new Axis(data.x);
    this.y = new Axis(data.y);
    this.curves = data.curves;
    this.marks = data.marks;
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

class Chart {
  constructor(figure) {
    this.figure = figure;
    this.plot = figure.querySelector(".plot");
    this.svg = this.plot.querySelector("svg");
    this.output = figure.querySelector("output");
    const data = JSON.parse(figure.querySelector("script[type='application/json']").textContent);
    const groups = [...this.svg.querySelectorAll(".panel")];
    this.panels = data.panels.map((panel, i) => new Panel(groups[i], panel));
    this.active = this.panels[0];
    this.cross = element("g", { class: "crosshair" }, this.svg);
    this.lines = element("path", {}, this.cross);
    this.ring = element("circle", { r: 5 }, this.cross);
    this.walk = null;
    this.tools();
    this.pointer();
    this.plot.addEventListener("keydown", (event) => this.key(event));
  }

  tools() {
    const tools = this.figure.querySelector(".chart-tools");
    tools.hidden = false;
    tools.addEventListener("click", (event) => {
      const action = event.target.closest("button")?.dataset.action;
      if (action) this.act(action);
    });
  }

  act(action) {
    const panel = this.active;
    const { x, y } = panel.view;
    const middle = [(x[0] + x[1]) / 2, (y[0] + y[1]) / 2];
    const moves = { left: [-0.25, 0], right: [0.25, 0], up: [0, 0.25], down: [0, -0.25] };
    if (action === "in") panel.zoom(1.5, this.focus(middle));
    else if (action === "out") panel.zoom(1 / 1.5, this.focus(middle));
    else if (action === "whole") panel.whole();
    else panel.pan(...moves[action]);
    this.refresh();
  }

  // What to look closer at: the point read out, if it is in view.
  focus(middle) {
    if (!this.read) return middle;
    return this.active.holds(this.active.place(this.read))
      ? [this.active.x.fraction(this.read[0]), this.active.y.fraction(this.read[1])]
      : middle;
  }

  refresh() {
    this.active.show();
    this.plot.classList.toggle("closer", this.panels.some((panel) => !panel.isWhole));
    this.target();
  }

  pointer() {
    const svg = this.svg;
    let drag = null;
    const place = (event) => {
      const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
      return [at.x, at.y];
    };
    const under = (at) => this.panels.find((panel) => panel.holds(at));
    svg.addEventListener("pointerdown", (event) => {
      const at = place(event);
      const panel = under(at);
      if (panel && !panel.isWhole && event.button === 0) {
        drag = { panel, at };
        svg.setPointerCapture(event.pointerId);
      }
    });
    svg.addEventListener("pointerup", () => {
      drag = null;
    });
    svg.addEventListener("pointercancel", () => {
      drag = null;
    });
    svg.addEventListener("pointermove", (event) => {
      const at = place(event);
      if (drag) {
        const [, , width, height] = drag.panel.frame;
        drag.panel.pan((drag.at[0] - at[0]) / width, (at[1] - drag.at[1]) / height);
        drag.at = at;
        this.refresh();
        return;
      }
      const panel = under(at);
      if (!panel) return;
      this.active = panel;
      this.walk = null;
      const near = panel.nearest(at);
      const [fx, fy] = panel.at(at);
      this.say(near?.label ?? "", near?.point ?? [panel.x.value(fx), panel.y.value(fy)], Boolean(near));
    });
    svg.addEventListener("click", (event) => {
      const at = place(event);
      const near = under(at)?.nearest(at);
      if (near?.mark !== undefined) this.pick(near.mark);
    });
    svg.addEventListener("pointerleave", () => {
      if (!this.walk) this.read = null;
      this.target();
    });
    svg.addEventListener("dblclick", () => this.act("whole"));
    // The wheel scrolls the page unless it is clearly meant for the chart.
    svg.addEventListener(
      "wheel",
      (event) => {
        const panel = under(place(event));
        const meant = event.ctrlKey || event.metaKey || document.activeElement === this.plot;
        if (!panel || !meant) return;
        event.preventDefault();
        this.active = panel;
        panel.zoom(1.2 ** (-event.deltaY / 100), panel.at(place(event)));
        this.refresh();
      },
      { passive: false },
    );
  }

  // What arrow keys walk along: the points by themselves, then every curve.
  get paths() {
    const panel = this.active;
    const marks = panel.marks.map((mark) => ({ at: mark.at, label: mark.label }));
    const curves = panel.curves.map((curve) =>
      curve.pieces.flat().map((at) => ({ at, label: curve.label })),
    );
    return [marks, ...curves]
      .map((points, i) => ({ points, marks: i === 0 }))
      .filter((path) => path.points.length);
  }

  key(event) {
    const pans = { ArrowLeft: "left", ArrowRight: "right", ArrowUp: "up", ArrowDown: "down" };
    const acts = { "+": "in", "=": "in", "-": "out", "−": "out", 0: "whole" };
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.shiftKey && pans[event.key]) this.act(pans[event.key]);
    else if (acts[event.key]) this.act(acts[event.key]);
    else if (event.key === "PageDown" || event.key === "PageUp") this.turn(event.key === "PageDown" ? 1 : -1);
    else if (event.key === "Escape") {
      this.walk = null;
      this.read = null;
      this.output.textContent = "";
      this.target();
    } else if (event.key === "Enter" && this.walk?.marks) this.pick(this.walk.point);
    else if (pans[event.key]) this.step(event.key);
    else return;
    event.preventDefault();
  }

  turn(by) {
    const count = this.panels.length;
    this.active = this.panels[(this.panels.indexOf(this.active) + by + count) % count];
    this.walk = null;
    this.read = null;
    this.target();
    this.output.textContent = this.active.title;
  }

  step(key) {
    const paths = this.paths;
    if (!paths.length) return;
    const walk = this.walk ?? { path: 0, point: -1 };
    if (key === "ArrowUp" || key === "ArrowDown") {
      const from = paths[walk.path].points[Math.max(0, walk.point)].at;
      const by = key === "ArrowDown" ? 1 : -1;
      walk.path = (walk.path + by + paths.length) % paths.length;
      walk.point = closest(paths[walk.path].points, from, this.active);
    } else {
      const { points } = paths[walk.path];
      const stride = paths[walk.path].marks ? 1 : Math.max(1, Math.round(points.length / 60));
      const to = walk.point + (key === "ArrowRight" ? stride : -stride);
      walk.point = Math.min(points.length - 1, Math.max(0, to));
    }
    const path = paths[walk.path];
    walk.marks = path.marks;
    this.walk = walk;
    const { at, label } = path.points[walk.point];
    this.say(label, at, true);
    if (path.marks) this.pick(walk.point);
  }

  pick(mark) {
    this.figure.dispatchEvent(new CustomEvent("pick", { detail: mark }));
  }

  say(label, point, on) {
    this.read = point;
    this.on = on;
    const { x, y } = this.active;
    const values = `${x.name} ${x.written(point[0])}, ${y.name} ${y.written(point[1])}`;
    this.output.textContent = label ? `${label}: ${values}` : values;
    this.target();
  }

  target() {
    const panel = this.active;
    const at = this.read ? panel.place(this.read) : null;
    const shown = at && panel.holds(at);
    this.cross.classList.toggle("shown", Boolean(shown));
    if (!shown) return;
    const [left, top, width, height] = panel.frame;
    this.lines.setAttribute("d", `M${at[0]} ${top}v${height}M${left} ${at[1]}h${width}`);
    this.ring.setAttribute("cx", at[0]);
    this.ring.setAttribute("cy", at[1]);
    this.ring.classList.toggle("on", this.on);
  }
}

function closest(points, from, panel) {
  const place = panel.place(from);
  const far = points.map(({ at }) => {
    const here = panel.place(at);
    return Math.hypot(here[0] - place[0], here[1] - place[1]);
  });
  return far.indexOf(Math.min(...far));
}

for (const figure of document.querySelectorAll("figure.chart")) new Chart(figure);
