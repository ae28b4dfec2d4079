// A chart that answers: values at a point, and a closer look at a panel. Its data stand beside it in
// SI units.
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
    pointer(this);
    new Keyboard(this);
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

for (const figure of document.querySelectorAll("figure.chart")) new Chart(figure);
