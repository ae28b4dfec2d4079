// The keyboard at a chart: arrow keys walk along its points and curves and move the view.
class Keyboard {
  constructor(chart) {
    this.chart = chart;
    chart.plot.addEventListener("keydown", (event) => this.key(event));
  }

  // What arrow keys walk along: the points by themselves, then every curve.
  get paths() {
    const panel = this.chart.active;
    const marks = panel.marks.map((mark) => ({ at: mark.at, label: mark.label }));
    const curves = panel.curves.map((curve) =>
      curve.pieces.flat().map((at) => ({ at, label: curve.label })),
    );
    return [marks, ...curves]
      .map((points, i) => ({ points, marks: i === 0 }))
      .filter((path) => path.points.length);
  }

  key(event) {
    const { chart } = this;
    const pans = { ArrowLeft: "left", ArrowRight: "right", ArrowUp: "up", ArrowDown: "down" };
    const acts = { "+": "in", "=": "in", "-": "out", "−": "out", 0: "whole" };
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.shiftKey && pans[event.key]) chart.act(pans[event.key]);
    else if (acts[event.key]) chart.act(acts[event.key]);
    else if (event.key === "PageDown" || event.key === "PageUp") this.turn(event.key === "PageDown" ? 1 : -1);
    else if (event.key === "Escape") {
      chart.walk = null;
      chart.read = null;
      chart.output.textContent = "";
      chart.target();
    } else if (event.key === "Enter" && chart.walk?.marks) chart.pick(chart.walk.point);
    else if (pans[event.key]) this.step(event.key);
    else return;
    event.preventDefault();
  }

  turn(by) {
    const { chart } = this;
    const count = chart.panels.length;
    const to = (chart.panels.indexOf(chart.active) + by + count) % count;
    chart.active = chart.panels[to];
    chart.walk = null;
    chart.read = null;
    chart.target();
    chart.output.textContent = chart.active.title;
  }

  step(key) {
    const { chart } = this;
    const paths = this.paths;
    if (!paths.length) return;
    const walk = chart.walk ?? { path: 0, point: -1 };
    if (key === "ArrowUp" || key === "ArrowDown") {
      const from = paths[walk.path].points[Math.max(0, walk.point)].at;
      const by = key === "ArrowDown" ? 1 : -1;
      walk.path = (walk.path + by + paths.length) % paths.length;
      walk.point = closest(paths[walk.path].points, from, chart.active);
    } else {
      const { points } = paths[walk.path];
      const stride = paths[walk.path].marks ? 1 : Math.max(1, Math.round(points.length / 60));
      const to = walk.point + (key === "ArrowRight" ? stride : -stride);
      walk.point = Math.min(points.length - 1, Math.max(0, to));
    }
    const path = paths[walk.path];
    walk.marks = path.marks;
    chart.walk = walk;
    const { at, label } = path.points[walk.point];
    chart.say(label, at, true);
    if (path.marks) chart.pick(walk.point);
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
