// One case: its numbers, its history, its film, and its scene as a file.
const LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
const pane = document.getElementById("case");
let cameFrom = null;

const filmOf = (row) => document.querySelector('figure[data-film="' + data.ids[row] + '"]');

// The curves of a case, as src/report/page/thin.rs packs them.
function curves(row) {
  const [first, last, ...rest] = (data.histories[data.ids[row]] || "").split(" ");
  const found = [];
  for (let k = 0; k + 3 < rest.length; k += 4) {
    const low = Number(rest[k + 1]), high = Number(rest[k + 2]), text = rest[k + 3], points = [];
    const share = (at) => (LETTERS.indexOf(text[at]) * 64 + LETTERS.indexOf(text[at + 1])) / 4095;
    for (let at = 0; at + 3 < text.length; at += 4) {
      points.push([Number(first) + share(at) * (last - first), low + share(at + 2) * (high - low)]);
    }
    found.push({ symbol: rest[k], first: Number(first), last: Number(last), low, high, points });
  }
  return found;
}

// Round values within a range, at least four of them.
function ticks(low, high) {
  const span = high - low, power = 10 ** Math.floor(Math.log10(span / 3));
  const inside = (step) => Math.floor(high / step + 1e-9) - Math.ceil(low / step - 1e-9) + 1;
  const step = [5, 2, 1, 0.5, 0.2].map((factor) => factor * power).find((one) => inside(one) >= 4);
  return Array.from({ length: inside(step) }, (_, k) => Number(((Math.ceil(low / step - 1e-9) + k) * step).toPrecision(6)));
}

function chart({ symbol, first, last, low, high, points }) {
  const [wide, tall, left, below] = [440, 120, 44, 18];
  const bottom = Math.min(low, 0);
  const x = (time) => left + (wide - left - 6) * (time - first) / (last - first);
  const y = (value) => 6 + (tall - below - 6) * (1 - (value - bottom) / (high - bottom));
  const level = (value) => '<path class="line" d="M' + left + " " + y(value).toFixed(1) + "H" + wide + '"/><text x="' + (left - 5) + '" y="' + (y(value) + 4).toFixed(1) + '" text-anchor="end">' + value + "</text>";
  const instant = (time) => '<text x="' + x(time).toFixed(1) + '" y="' + (tall - 3) + '" text-anchor="middle">' + time + "</text>";
  const box = make("figure", { className: "curve" });
  box.innerHTML = '<figcaption><b>' + symbol + '</b> <output></output></figcaption><svg viewBox="0 0 ' + wide + " " + tall + '" role="img">'
    + ticks(bottom, high).map(level).join("") + ticks(first, last).map(instant).join("")
    + '<polyline points="' + points.map(([time, value]) => x(time).toFixed(1) + "," + y(value).toFixed(1)).join(" ") + '"/><path class="cursor"/></svg>';
  const svg = box.querySelector("svg"), output = box.querySelector("output"), cursor = box.querySelector(".cursor");
  svg.setAttribute("aria-label", symbol + " over time in s, from " + low.toPrecision(3) + " to " + high.toPrecision(3));
  const rest = () => { output.textContent = "over t, s"; cursor.removeAttribute("d"); };
  svg.addEventListener("pointermove", (event) => {
    const area = svg.getBoundingClientRect();
    const time = first + (last - first) * ((event.clientX - area.left) / area.width * wide - left) / (wide - left - 6);
    const after = points.findIndex((one) => one[0] >= time);
    if (after < 1) return rest();
    const [[t0, v0], [t1, v1]] = [points[after - 1], points[after]];
    const value = v0 + (v1 - v0) * (time - t0) / (t1 - t0 || 1);
    output.textContent = "= " + value.toPrecision(3) + " at t = " + time.toFixed(2) + " s";
    cursor.setAttribute("d", "M" + x(time) + " 0V" + (tall - below));
  });
  svg.addEventListener("pointerleave", rest);
  rest();
  return box;
}

// The film's own page in a frame, as high as what it shows.
function player(id) {
  const text = document.getElementById("film-" + id);
  if (!text) return null;
  const frame = make("iframe", { title: "Film of case " + id, srcdoc: JSON.parse(text.textContent) });
  frame.addEventListener("load", () => {
    const page = frame.contentDocument?.documentElement;
    if (!page) return;
    const fit = () => { frame.style.height = frame.contentDocument.body.scrollHeight + 8 + "px"; };
    new ResizeObserver(fit).observe(frame.contentDocument.body);
    fit();
  });
  return frame;
}

function scene(row) {
  const template = data.scenes?.texts[data.scenes.at[row]];
  if (!template) return null;
  let text = template.replaceAll("{id}", data.ids[row]);
  for (const key of data.keys) {
    if (key.at[row] >= 0) text = text.replaceAll("{" + key.name + "}", key.literals[key.at[row]]);
  }
  return text;
}

async function copyScene(row, button) {
  const text = scene(row), before = button.textContent;
  if (!text) return;
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    const field = make("textarea", { value: text });
    document.body.append(field);
    field.select();
    document.execCommand("copy");
    field.remove();
  }
  button.textContent = "copied";
  setTimeout(() => { button.textContent = before; }, 1500);
}

// Every cell of the case, from every table.
function values(row) {
  const seen = new Set(["case_id", ...data.keys.map((key) => key.name)]), list = make("dl");
  for (const grid of grids) {
    const line = grid.lineOf.get(row);
    if (line === undefined) continue;
    grid.cells(line).forEach((cell, at) => {
      if (!cell || seen.has(grid.columns[at])) return;
      seen.add(grid.columns[at]);
      list.append(make("dt", { textContent: grid.heads[at].textContent }), make("dd", { textContent: cell }));
    });
  }
  return list;
}

function show(row, from) {
  opened = row;
  cameFrom = from || null;
  const id = data.ids[row], close = make("button", { type: "button", className: "close", textContent: "Close" });
  close.addEventListener("click", hide);
  const parts = [make("header", {}, make("h2", { textContent: words(row) }), close)];
  const drawn = curves(row).map(chart);
  if (drawn.length) parts.push(make("div", { className: "curves" }, ...drawn));
  const film = filmOf(row);
  if (film) {
    const play = make("button", { type: "button", className: "play", textContent: "Play its film" });
    play.addEventListener("click", () => {
      const frame = player(id);
      if (frame) play.replaceWith(frame); else location.href = "films/" + id + ".html";
    });
    parts.push(play);
  }
  parts.push(values(row));
  if (scene(row)) {
    const copy = make("button", { type: "button", className: "copy", textContent: "Copy scene file" });
    copy.addEventListener("click", () => copyScene(row, copy));
    parts.push(make("h3", { textContent: "For seawall run" }), copy, make("pre", { tabIndex: 0, textContent: scene(row) }));
  }
  const file = "histories/" + id + ".csv";
  if (drawn.length || data.cut) parts.push(make("p", { className: "file" }, make("a", { href: file, textContent: file })));
  pane.replaceChildren(...parts);
  pane.hidden = false;
  pane.scrollTop = 0;
  close.focus({ preventScroll: true });
  remember();
}

function hide() {
  opened = -1;
  pane.hidden = true;
  pane.replaceChildren();
  cameFrom?.focus?.({ preventScroll: true });
  remember();
}
