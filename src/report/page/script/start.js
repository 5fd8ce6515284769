// Puts it all to work.
const grids = [...document.querySelectorAll(".listing")].map((box) => new Grid(box));
document.querySelectorAll("figure [data-series^='case=']").forEach(widen);
const figures = [...document.querySelectorAll("figure")].filter((figure) => figure.querySelector("[data-case]"));
for (const figure of figures) watchers.push({ box: figure, act: () => fade(figure) });
chooser();
document.body.append(tip);
figures.flatMap((figure) => [...figure.querySelectorAll("svg")]).forEach(enter);
document.querySelectorAll("figure.film").forEach((figure) => {
  const poster = figure.querySelector(".poster"), id = figure.dataset.film;
  if (!document.getElementById("film-" + id)) return;
  const play = make("button", { type: "button", className: "play", textContent: "Play" });
  play.addEventListener("click", () => poster.replaceWith(player(id)) || play.remove());
  figure.querySelector("figcaption").prepend(play);
});
document.addEventListener("keydown", (event) => {
  if (event.key === "Escape" && !pane.hidden) hide();
});
function restore() {
  recall();
  const open = opened;
  choose();
  if (open >= 0) show(open);
  else if (!pane.hidden) hide();
}
addEventListener("hashchange", () => {
  if (location.hash.length > 1 && !location.hash.includes("=")) return remember(); // a link within the page
  restore();
});
restore();
document.documentElement.classList.add("alive");
// Sections that are not near what is seen are left out, so that the page opens and answers at once. When there is
// nothing else to do, each is laid out once, and the browser keeps its size: then nothing moves when one scrolls. In a
// window of another width, and after a choice, sizes are others, and each is laid out once more.
// Idle is what a busy page or one that is not seen may never be.
const whenIdle = (act) => (window.requestIdleCallback ? requestIdleCallback(act, { timeout: 200 }) : setTimeout(act));
const parts = [...document.querySelectorAll("main > section, main > .beside")];
let left = null, wide = innerWidth;
function layOut() {
  const part = left.shift();
  if (part) {
    part.style.contentVisibility = "visible";
    part.getBoundingClientRect();
    return whenIdle(layOut);
  }
  left = null;
  // Sizes are kept at the end of a frame, and what is near is found in the next one. Where none comes, all stays laid out.
  afterFrame(() => {
    for (const part of parts) part.style.contentVisibility = "";
    afterFrame(atRest);
  });
  setTimeout(() => left || atRest(), 2000);
}
function afterFrame(act) {
  requestAnimationFrame(() => setTimeout(() => left || act()));
}
function atRest() {
  document.documentElement.classList.remove("opening");
}
function layOutAll() {
  document.documentElement.classList.add("opening");
  if (!left) whenIdle(layOut);
  left = [...parts];
}
addEventListener("resize", () => {
  if (innerWidth !== wide) layOutAll();
  wide = innerWidth;
});
layOutAll();
