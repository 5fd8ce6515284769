// Figures: points tell what they are, show their case, and fade where it is not chosen.
const NEAR = 14;
// So many series look different in every way.
const SERIES = 6;
let pointed = [], under = null, marksOf = null;
const tip = make("div", { className: "tip", hidden: true });
tip.setAttribute("role", "status");

const rowsOf = (element) => element.dataset.case.split(" ").map((id) => rowOf.get(id)).filter((row) => row !== undefined);
const isOn = (mark) => mark.rows.some((row) => chosen[row]);

// A figure's marks by their series, read from the page once.
function groupsOf(figure) {
  if (figure.groups) return figure.groups;
  const known = new Map();
  for (const element of figure.querySelectorAll("[data-case]")) {
    const rows = rowsOf(element);
    if (!rows.length) continue;
    const box = element.closest(".series") || element.parentNode;
    if (!known.has(box)) known.set(box, { box, marks: [], state: "" });
    known.get(box).marks.push({ element, rows, off: false });
  }
  return (figure.groups = [...known.values()]);
}

function fade(figure) {
  if (!figure.groups && chosen.every(Boolean)) return;
  for (const group of groupsOf(figure)) {
    let on = 0;
    for (const mark of group.marks) on += isOn(mark);
    const state = on === 0 ? "off" : on === group.marks.length ? "" : "some";
    if (state !== group.state) {
      group.box.classList.remove("off", "some");
      if (state) group.box.classList.add(state);
      group.state = state;
    }
    for (const mark of group.marks) {
      const off = state === "some" && !isOn(mark);
      if (off !== mark.off) mark.element.classList.toggle("off", (mark.off = off));
    }
  }
  // What has no points of its own, such as an entry of a legend, follows its key.
  for (const element of figure.querySelectorAll("[data-series]")) {
    if (element.dataset.case || element.querySelector("[data-case]")) continue;
    const [name, value] = element.dataset.series.split("=");
    const k = data.keys.findIndex((key) => key.name === name);
    if (k < 0) continue;
    const at = data.keys[k].literals.findIndex((literal) => literal === value || Number(literal) === Number(value));
    element.classList.toggle("off", picked[k].size > 0 && !picked[k].has(at));
  }
  reveal(figure);
}

// Spare panels and series come where a choice asks for them, panels of nothing that is chosen go, and a
// figure that shows nothing says so.
function reveal(figure) {
  const groups = groupsOf(figure), on = groups.filter(({ state }) => state !== "off");
  const panels = figure.querySelectorAll(".panels > svg");
  if (figure.querySelector(".spare")) {
    const all = chosen.every(Boolean), some = new Set(on.map(({ box }) => box.closest("svg")));
    const series = new Set(on.map(({ box }) => box.dataset.series)), few = !all && series.size <= SERIES;
    for (const svg of panels) svg.toggleAttribute("hidden", all || !on.length ? svg.classList.contains("spare") : !some.has(svg));
    for (const { box } of groups) {
      if (box.classList.contains("spare")) box.toggleAttribute("hidden", !few || !series.has(box.dataset.series));
    }
    for (const entry of figure.querySelectorAll("li.spare")) entry.hidden = !few || !series.has(entry.dataset.series);
  }
  if (!groups.length || (!figure.nothing && on.length)) return;
  figure.nothing ||= make("p", { className: "nothing", textContent: "None of the chosen cases is drawn here." });
  if (!figure.nothing.isConnected) panels[0]?.closest(".plot").before(figure.nothing);
  figure.nothing.hidden = on.length > 0;
}

// The same case everywhere.
function point(row) {
  for (const element of pointed) element.classList.remove("here");
  if (!marksOf) {
    marksOf = new Map();
    for (const { element, rows } of figures.flatMap(groupsOf).flatMap((group) => group.marks)) {
      for (const one of rows) marksOf.set(one, (marksOf.get(one) || []).concat(element));
    }
  }
  pointed = marksOf.get(row) || [];
  for (const element of pointed) element.classList.add("here");
}

function told(element) {
  const title = element.querySelector(":scope > title");
  if (title) {
    element.setAttribute("aria-label", title.textContent);
    title.remove(); // or else the browser shows it a second time
  }
  return element.getAttribute("aria-label") || words(rowOf.get(element.dataset.case.split(" ")[0]));
}

function rowUnder(element) {
  const rows = rowsOf(element);
  return rows.find((row) => chosen[row]) ?? rows[0] ?? -1;
}

function say(element) {
  if (element === under) return;
  under = element;
  tip.hidden = !element;
  if (!element) return point(-1);
  const row = rowUnder(element), film = row >= 0 && filmOf(row) ? " and film" : "";
  tip.replaceChildren(...told(element).split("\n").map((line) => make("div", { textContent: line })));
  if (row >= 0) tip.append(make("small", { textContent: "Click for its history" + film }));
  const at = element.getBoundingClientRect(), [wide, tall] = [tip.offsetWidth, tip.offsetHeight];
  const left = Math.min(Math.max(4, (at.left + at.right - wide) / 2), document.documentElement.clientWidth - wide - 4);
  tip.style.left = left + scrollX + "px";
  tip.style.top = (at.top - tall - 8 > 0 ? at.top - tall - 8 : at.bottom + 8) + scrollY + "px";
  point(row);
}

// Middles of a figure's marks, in shares of its size.
function middles(svg) {
  if (svg.middles) return svg.middles;
  const box = svg.getBoundingClientRect();
  const middle = (element) => {
    const at = element.getBoundingClientRect();
    return { element, x: ((at.left + at.right) / 2 - box.left) / box.width, y: ((at.top + at.bottom) / 2 - box.top) / box.height };
  };
  return (svg.middles = [...svg.querySelectorAll("[data-case]:not(.series)")].map(middle));
}

// The mark under the pointer, or the nearest one within a few pixels.
function markAt(svg, event) {
  const direct = event.target.closest("[data-case]");
  if (direct && !direct.closest(".off")) return direct;
  const box = svg.getBoundingClientRect();
  let best = null, least = NEAR;
  for (const { element, x, y } of middles(svg)) {
    const away = Math.hypot(box.left + x * box.width - event.clientX, box.top + y * box.height - event.clientY);
    if (away < least && !element.closest(".off")) [best, least] = [element, away];
  }
  return best;
}

// Arrows go along a series, and from one to the next.
function step(element, key) {
  const svg = element.closest("svg"), own = groupsOf(element.closest("figure")).filter((one) => svg.contains(one.box) && one.state !== "off");
  const group = own.find((one) => one.marks.some((mark) => mark.element === element));
  if (!group) return null;
  const at = group.marks.findIndex((mark) => mark.element === element), g = own.indexOf(group);
  const along = { ArrowRight: 1, ArrowLeft: -1 }[key], across = { ArrowDown: 1, ArrowUp: -1 }[key];
  const marks = across ? own[g + across]?.marks : group.marks;
  if (!marks) return null;
  let to = across ? Math.min(at, marks.length - 1) : at + along;
  while (marks[to]?.off) to += along || 1;
  return marks[to]?.element || null;
}

// A curve that is one case: as wide to the pointer as a point, and with its entry in the legend.
function widen(element) {
  element.dataset.case = element.dataset.series.slice("case=".length);
  for (const line of element.querySelectorAll("polyline")) {
    const reach = line.cloneNode();
    reach.setAttribute("class", "reach");
    line.after(reach);
  }
}

function enter(svg) {
  const marks = svg.querySelectorAll("[data-case]");
  if (!marks.length) return;
  svg.setAttribute("role", "group");
  marks[0].setAttribute("tabindex", 0);
  const clear = (event) => say(event.target.closest?.("[data-case]") && event.type === "focusin" ? event.target.closest("[data-case]") : null);
  svg.addEventListener("pointermove", (event) => {
    const mark = markAt(svg, event);
    svg.style.cursor = mark ? "pointer" : "";
    say(mark);
  });
  svg.addEventListener("pointerleave", clear);
  svg.addEventListener("focusin", clear);
  svg.addEventListener("focusout", clear);
  svg.addEventListener("click", (event) => {
    const mark = markAt(svg, event);
    if (mark && rowUnder(mark) >= 0) show(rowUnder(mark), mark);
  });
  svg.addEventListener("keydown", (event) => {
    const mark = event.target.closest("[data-case]");
    if (!mark) return;
    if (event.key.startsWith("Arrow")) {
      const next = step(mark, event.key);
      if (next) {
        mark.setAttribute("tabindex", -1);
        next.setAttribute("tabindex", 0);
        told(next);
        next.focus();
      }
    } else if (event.key === "Enter" || event.key === " ") show(rowUnder(mark), mark);
    else if (event.key === "Escape") say(null);
    else return;
    event.preventDefault();
  });
}
