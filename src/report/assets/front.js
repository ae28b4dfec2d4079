// The front: the design behind the point that is picked on the chart or in the table.
for (const section of document.querySelectorAll(".front")) {
  const figure = section.querySelector("figure.chart");
  const buttons = [...section.querySelectorAll("button[data-point]")];
  const designs = [...section.querySelectorAll("[data-design]")];
  const panels = [...figure.querySelectorAll(".panel")].map((panel) => [...panel.querySelectorAll(".mark")]);
  const select = (point) => {
    if (!(point >= 0 && point < buttons.length)) return;
    for (const [i, design] of designs.entries()) design.hidden = i !== point;
    for (const [i, button] of buttons.entries()) {
      button.setAttribute("aria-pressed", String(i === point));
      button.closest("tr").classList.toggle("picked", i === point);
    }
    for (const marks of panels) {
      for (const [i, mark] of marks.entries()) mark.classList.toggle("picked", i === point);
    }
  };
  figure.addEventListener("pick", (event) => select(event.detail));
  for (const [i, button] of buttons.entries()) {
    button.addEventListener("click", () => select(i));
    button.addEventListener("keydown", (event) => {
      const to = { ArrowDown: i + 1, ArrowUp: i - 1, Home: 0, End: buttons.length - 1 }[event.key];
      if (to === undefined || !buttons[to]) return;
      event.preventDefault();
      buttons[to].focus();
      select(to);
    });
  }
  select(0);
}
