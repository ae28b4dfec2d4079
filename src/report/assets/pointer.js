// The pointer at a chart: it reads values, drags the view, picks points; the wheel looks closer.
function pointer(chart) {
  const { svg } = chart;
  let drag = null;
  const place = (event) => {
    const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
    return [at.x, at.y];
  };
  const under = (at) => chart.panels.find((panel) => panel.holds(at));
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
      chart.refresh();
      return;
    }
    const panel = under(at);
    if (!panel) return;
    chart.active = panel;
    chart.walk = null;
    const near = panel.nearest(at);
    const [fx, fy] = panel.at(at);
    chart.say(near?.label ?? "", near?.point ?? [panel.x.value(fx), panel.y.value(fy)], Boolean(near));
  });
  svg.addEventListener("click", (event) => {
    const at = place(event);
    const near = under(at)?.nearest(at);
    if (near?.mark !== undefined) chart.pick(near.mark);
  });
  svg.addEventListener("pointerleave", () => {
    if (!chart.walk) chart.read = null;
    chart.target();
  });
  svg.addEventListener("dblclick", () => chart.act("whole"));
  // The wheel scrolls the page unless it is clearly meant for the chart.
  svg.addEventListener(
    "wheel",
    (event) => {
      const panel = under(place(event));
      const meant = event.ctrlKey || event.metaKey || document.activeElement === chart.plot;
      if (!panel || !meant) return;
      event.preventDefault();
      chart.active = panel;
      panel.zoom(1.2 ** (-event.deltaY / 100), panel.at(place(event)));
      chart.refresh();
    },
    { passive: false },
  );
}
