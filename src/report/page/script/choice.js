// What is chosen: values of swept keys, filters of columns, how tables are sorted, which case is
// open. All of it stands in the address, so that a link shows what its sender saw.
const data = JSON.parse(document.getElementById("data").textContent);
const count = data.ids.length;
const rowOf = new Map(data.ids.map((id, row) => [id, row]));
const picked = data.keys.map(() => new Set());
const filters = new Map();
const sorts = new Map();
const chosen = new Uint8Array(count).fill(1);
// What follows a choice: an act, and where on the page it shows; null for always.
const watchers = [];
let opened = -1, waiting = [], timer = 0;

function make(tag, properties, ...children) {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
}

// The case in words: H/h = 0.5, k = 10 N/m.
function words(row) {
  const parts = data.keys.map((key) => {
    const at = key.at[row];
    if (at < 0) return "";
    const unit = key.heading.includes(", ") ? " " + key.heading.split(", ").pop() : "";
    return key.symbol.split(", ")[0] + " = " + key.shown[at] + unit;
  });
  return parts.filter(Boolean).join(", ") || "case " + data.ids[row];
}

// Tests of rows by the names of their filters; tables put theirs in.
const testers = new Map();

// Marks the chosen rows. What is seen follows at once, all else right after it.
function choose() {
  const tests = [];
  for (const [name, text] of filters) {
    const tester = testers.get(name.split(".")[0]);
    if (tester) tests.push(tester(name.slice(name.indexOf(".") + 1), text));
  }
  const keys = data.keys.map((key, k) => [key.at, picked[k]]).filter(([, values]) => values.size);
  for (let row = 0; row < count; row++) {
    chosen[row] = keys.every(([at, values]) => values.has(at[row])) && tests.every((test) => test(row)) ? 1 : 0;
  }
  // By whole sections: what is inside of one that is not seen has no place yet.
  const seen = (box) => {
    const at = box?.closest("main > *")?.getBoundingClientRect();
    return !at || (at.bottom > 0 && at.top < innerHeight);
  };
  const now = new Set(watchers.filter((watcher) => seen(watcher.box)));
  for (const watcher of now) watcher.act();
  waiting = watchers.filter((watcher) => !now.has(watcher)).map((watcher) => watcher.act).concat(remember, layOutAll);
  document.body.setAttribute("aria-busy", "true");
  clearTimeout(timer);
  timer = setTimeout(next);
}

function next() {
  waiting.shift()?.();
  if (waiting.length) timer = setTimeout(next);
  else document.body.removeAttribute("aria-busy");
}

// Does at once what is still to be done.
function settle() {
  clearTimeout(timer);
  while (waiting.length) next();
  clearTimeout(timer);
}

function remember() {
  const words = new URLSearchParams();
  data.keys.forEach((key, k) => {
    if (picked[k].size) words.set(key.name, [...picked[k]].map((at) => key.literals[at]).join(","));
  });
  for (const [name, text] of filters) words.set(name, text);
  for (const [table, [column, down]] of sorts) words.set("sort." + table, column + (down ? ".down" : ""));
  if (opened >= 0) words.set("case", data.ids[opened]);
  const hash = words.toString();
  if (hash !== location.hash.slice(1)) history.replaceState(null, "", hash ? "#" + hash : "#");
}

// Reads the address; true where it says anything.
function recall() {
  const words = new URLSearchParams(location.hash.slice(1));
  picked.forEach((values) => values.clear());
  filters.clear();
  sorts.clear();
  opened = -1;
  for (const [name, text] of words) {
    const k = data.keys.findIndex((key) => key.name === name);
    if (k >= 0) {
      const literals = data.keys[k].literals;
      for (const literal of text.split(",")) {
        if (literals.includes(literal)) picked[k].add(literals.indexOf(literal));
      }
    } else if (name === "case") opened = rowOf.get(text) ?? -1;
    else if (name.startsWith("sort.")) sorts.set(name.slice(5), [text.replace(/\.down$/, ""), text.endsWith(".down")]);
    else if (text && name.includes(".")) filters.set(name, text);
  }
}

// A bar of buttons: one line for each swept key, one button for each of its values.
function chooser() {
  const told = make("output"), clear = make("button", { type: "button", textContent: "Show all" });
  const lines = data.keys.map((key, k) => {
    if (key.literals.length < 2) return null;
    const buttons = key.shown.map((shown, at) => {
      const button = make("button", { type: "button", textContent: shown });
      button.addEventListener("click", () => {
        if (!picked[k].delete(at)) picked[k].add(at);
        choose();
      });
      return button;
    });
    const line = make("fieldset", {}, make("legend", { textContent: key.heading }), make("div", {}, ...buttons));
    return { line, mark: () => buttons.forEach((button, at) => button.setAttribute("aria-pressed", picked[k].has(at))) };
  }).filter(Boolean);
  clear.addEventListener("click", () => {
    picked.forEach((values) => values.clear());
    filters.clear();
    choose();
  });
  const tell = () => {
    const shown = chosen.reduce((sum, one) => sum + one, 0);
    told.textContent = shown === count ? "All " + count + " cases are shown" : shown + " of " + count + " cases are shown";
    clear.hidden = shown === count && !filters.size;
    lines.forEach((line) => line.mark());
  };
  const box = document.getElementById("choose");
  watchers.push({ box: null, act: tell });
  box.append(make("summary", {}, "Choose cases. ", told), ...lines.map((line) => line.line), clear);
  told.setAttribute("aria-live", "polite");
  box.open = matchMedia("(min-width: 40rem)").matches;
  box.hidden = count < 2;
}
