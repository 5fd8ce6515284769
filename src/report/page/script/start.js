// Puts it all to work.
const grids = [...document.querySelectorAll(".listing")].map((box) => new Grid(box));
watchers.push(fade);
chooser();
document.body.append(tip);
document.querySelectorAll("figure svg").forEach(enter);
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
