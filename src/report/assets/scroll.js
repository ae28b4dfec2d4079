// Tables and charts wider than the page scroll on their own; the keyboard must reach them.
const scrollers = [...document.querySelectorAll(".table, .plot-scroll, pre")];
const reach = () => {
  for (const box of scrollers) {
    if (box.scrollWidth > box.clientWidth) box.tabIndex = 0;
    else box.removeAttribute("tabindex");
  }
};
reach();
addEventListener("resize", reach);
