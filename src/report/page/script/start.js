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
// nothing else to do, each is laid out once and keeps its size: then nothing moves when one scrolls.
// Idle is what a busy page or one that is not seen may never be.
const whenIdle = (act) => (window.requestIdleCallback ? requestIdleCallback(act, { timeout: 200 }) : setTimeout(act));
const parts = [...document.querySelectorAll("main > section, main > .beside")];
function layOut() {
  const part = parts.shift();
  if (!part) return document.documentElement.classList.remove("opening");
  part.style.contentVisibility = "visible";
  const own = getComputedStyle(part), around = [own.paddingTop, own.paddingBottom, own.borderTopWidth, own.borderBottomWidth];
  const inside = around.reduce((tall, width) => tall - parseFloat(width), part.getBoundingClientRect().height);
  part.style.containIntrinsicHeight = "auto " + inside + "px";
  part.style.contentVisibility = "";
  whenIdle(layOut);
}
whenIdle(layOut);
