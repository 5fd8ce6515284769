// Tables: sorted by a click on a heading, filtered by what stands under it. A long table holds only
// the rows that are near what is seen.
const WHOLE = 400, AROUND = 8;
// So many rows are seen at once, without a bar to scroll them.
const SHORT = 50;
const plain = document.createElement("textarea");

function textOf(html) {
  const text = html.slice(html.lastIndexOf(">") + 1);
  if (!text.includes("&")) return text;
  plain.innerHTML = text;
  return plain.value;
}

// The number in a cell: 2.41 ± 0.03, ≥ 2.4, 2.5×10⁵; NaN where there is none.
function numberOf(text) {
  const value = text.replace(/^≥ /, "").split(/ [±−] /)[0];
  const power = value.match(/^(?:(.*)×)?10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)$/);
  if (!power) return value === "" ? NaN : Number(value);
  const digits = [...power[2]].map((digit) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹".indexOf(digit)).map((at) => (at ? at - 1 : "-"));
  return Number(power[1] ?? 1) * 10 ** Number(digits.join(""));
}

// What a filter asks for: < 2, >= 0.5, 0.2..0.4, or a part of the text; null where it is not understood.
const NUMBER = "[-+]?(?:\\d+\\.?\\d*|\\.\\d+)(?:e[-+]?\\d+)?", SIGN = "<=|>=|<|>|=|≤|≥";
const BOUND = new RegExp("^(" + SIGN + ")\\s*(" + NUMBER + ")$", "i");
const RANGE = new RegExp("^(" + NUMBER + ")\\s*\\.\\.\\s*(" + NUMBER + ")$", "i");
const ALLOWED = "< 2, >= 0.5, 0.2..0.4, or a part of the text";
function asked(text, numeric) {
  text = text.trim();
  const bound = text.match(BOUND);
  if (bound) {
    const value = Number(bound[2]), sign = bound[1];
    return { number: (cell) => ({ "<": cell < value, ">": cell > value, "=": cell === value, "<=": cell <= value, "≤": cell <= value, ">=": cell >= value, "≥": cell >= value })[sign] };
  }
  const range = text.match(RANGE);
  if (range) return { number: (cell) => cell >= Number(range[1]) && cell <= Number(range[2]) };
  if (numeric && /^[<>=≤≥]|\.\.|\p{L}/u.test(text)) return null;
  const part = text.toLowerCase();
  return { text: (cell) => cell.toLowerCase().includes(part) };
}

class Grid {
  constructor(box) {
    const html = box.querySelector("noscript").textContent;
    const start = html.indexOf("<tbody>") + 7, end = html.lastIndexOf("</tbody>");
    this.name = box.dataset.table;
    this.lines = html.slice(start, end).trim().split("\n");
    this.rows = this.lines.map((line) => rowOf.get(line.slice(15, line.indexOf('"', 15))));
    this.lineOf = new Map(this.rows.map((row, line) => [row, line]));
    box.insertAdjacentHTML("beforeend", html.slice(0, start) + html.slice(end));
    this.scroll = box.querySelector(".wide");
    this.scroll.classList.toggle("long", this.lines.length > SHORT);
    this.unread = make("p", { className: "unread", hidden: true });
    this.unread.setAttribute("role", "status");
    this.scroll.before(this.unread);
    this.table = box.querySelector("table");
    this.body = this.table.tBodies[0];
    this.heads = [...this.table.tHead.rows[0].cells];
    this.columns = this.heads.map((head) => head.dataset.column);
    this.numbers = new Map();
    this.copies = this.name === "summary" && data.scenes;
    this.head();
    testers.set(this.name, (column, text) => this.test(column, text));
    this.top = 0;
    watchers.push({ box: this.scroll, act: () => this.renew() });
    this.scroll.addEventListener("scroll", () => {
      this.top = this.scroll.scrollTop;
      this.fill();
    });
    addEventListener("beforeprint", () => {
      settle();
      this.fill(true);
    });
    addEventListener("afterprint", () => this.fill());
    this.listen();
    if (this.lines.length > WHOLE) this.fix();
  }

  // Widths by the longest cells, as rows that are not there cannot widen a column.
  fix() {
    const widest = this.heads.map((head) => head.textContent.length + 2);
    for (let line = 0; line < this.lines.length; line++) {
      this.cells(line).forEach((cell, at) => { if (cell.length > widest[at]) widest[at] = cell.length; });
    }
    const widths = widest.map((letters) => make("col", { style: "width:" + Math.min(letters + 2, 60) + "ch" }));
    this.table.prepend(make("colgroup", {}, ...widths));
    this.table.style.tableLayout = "fixed";
    this.table.style.width = "max-content";
  }

  cells(line) {
    return this.lines[line].split("</td>").slice(0, this.columns.length).map(textOf);
  }

  column(name) {
    const at = this.columns.indexOf(name);
    return this.lines.map((line) => textOf(line.split("</td>", at + 1)[at] ?? ""));
  }

  numbersOf(name) {
    if (!this.numbers.has(name)) this.numbers.set(name, this.column(name).map(numberOf));
    return this.numbers.get(name);
  }

  test(name, text) {
    if (!this.columns.includes(name)) return () => true;
    const wanted = asked(text, this.isNumeric(name));
    if (!wanted) return () => true;
    const cells = wanted.number ? this.numbersOf(name) : this.column(name);
    const fits = wanted.number || wanted.text;
    return (row) => this.lineOf.has(row) && fits(cells[this.lineOf.get(row)]);
  }

  isNumeric(name) {
    return this.heads[this.columns.indexOf(name)].classList.contains("number");
  }

  // A filter that is not understood holds nothing back, and says so.
  complain() {
    const own = this.columns.map((name) => filters.get(this.name + "." + name) || "");
    const wrong = own.map((text, at) => text && !asked(text, this.isNumeric(this.columns[at])));
    wrong.forEach((is, at) => this.fields[at].setAttribute("aria-invalid", is));
    const told = own.filter((text, at) => wrong[at] && !/^[<>=≤≥]+$/.test(text));
    this.unread.hidden = !told.length;
    this.unread.textContent = told.map((text) => "“" + text + "”").join(" and ") + (told.length > 1 ? " are" : " is")
      + " not understood and left out. Write a number without its unit: " + ALLOWED + ".";
  }

  head() {
    const example = this.cells(this.lines.length >> 1).map(numberOf);
    const fields = this.heads.map((head, at) => {
      const name = this.columns[at], label = head.textContent;
      const button = make("button", { type: "button", textContent: label });
      button.addEventListener("click", () => {
        const [column, down] = sorts.get(this.name) || [];
        if (column !== name) sorts.set(this.name, [name, false]);
        else if (!down) sorts.set(this.name, [name, true]);
        else sorts.delete(this.name);
        this.renew();
        remember();
      });
      head.replaceChildren(button);
      const number = head.classList.contains("number");
      const hint = Number.isFinite(example[at]) ? (example[at] ? "< " + Number(example[at].toPrecision(2)) : "> 0") : "number";
      const field = make("input", { type: "search", placeholder: number ? hint : "text", size: 6, title: number ? ALLOWED : "a part of the text" });
      field.setAttribute("aria-label", "Filter " + label);
      field.addEventListener("input", () => {
        if (field.value.trim()) filters.set(this.name + "." + name, field.value.trim());
        else filters.delete(this.name + "." + name);
        choose();
      });
      return field;
    });
    this.fields = fields;
    this.table.tHead.append(make("tr", { className: "filters" }, ...fields.map((field) => make("td", {}, field))));
    if (this.copies) {
      this.table.tHead.rows[0].append(make("td"));
      this.table.tHead.rows[1].append(make("td"));
    }
  }

  // Which lines there are, and in which order.
  renew() {
    const lines = this.order = [];
    for (let line = 0; line < this.rows.length; line++) if (chosen[this.rows[line]]) lines.push(line);
    const [column, down] = sorts.get(this.name) || [];
    if (this.columns.includes(column)) {
      const numbers = this.numbersOf(column), sign = down ? -1 : 1;
      const numeric = numbers.some((number) => !Number.isNaN(number));
      const keys = numeric ? numbers : this.column(column), empty = (key) => key === "" || Number.isNaN(key);
      lines.sort((a, b) => {
        const [x, y] = [keys[a], keys[b]];
        if (empty(x) || empty(y)) return empty(x) - empty(y);
        return x < y ? -sign : x > y ? sign : 0;
      });
    }
    this.heads.forEach((head, at) => {
      if (this.columns[at] !== column) head.removeAttribute("aria-sort");
      else head.setAttribute("aria-sort", down ? "descending" : "ascending");
      const value = filters.get(this.name + "." + this.columns[at]) || "";
      if (this.fields[at].value.trim() !== value) this.fields[at].value = value;
    });
    this.complain();
    this.from = -1;
    if (this.top) this.scroll.scrollTop = this.top = 0;
    this.fill();
  }

  // Puts the rows near what is seen into the table, all of them where they are few or printed.
  fill(all) {
    const lines = this.order, tall = this.tall || 24;
    let from = 0, to = lines.length;
    if (!all && lines.length > WHOLE) {
      const first = Math.floor(this.top / tall);
      from = Math.max(0, first - (first % AROUND) - AROUND);
      to = Math.min(lines.length, from + 6 * AROUND);
    }
    if (from === this.from && to === this.to) return;
    [this.from, this.to] = [from, to];
    const gap = (rows) => (rows > 0 ? '<tr class="gap" aria-hidden="true"><td style="height:' + rows * tall + 'px"></td></tr>' : "");
    const copy = this.copies ? '<td><button type="button" class="copy" tabindex="-1">copy</button></td></tr>' : "</tr>";
    let html = gap(from);
    for (let at = from; at < to; at++) html += this.lines[lines[at]].replace("<tr ", '<tr tabindex="' + (at === from ? 0 : -1) + '" ').replace("</tr>", copy);
    const focused = this.body.contains(document.activeElement) && document.activeElement.closest("tr").dataset.case;
    this.body.innerHTML = html + gap(lines.length - to);
    if (focused) this.body.querySelector('[data-case="' + focused + '"]')?.focus({ preventScroll: true });
    this.table.setAttribute("aria-rowcount", lines.length + 2);
    if (!this.tall && lines.length > WHOLE) this.tall = this.body.rows[0]?.offsetHeight;
  }

  listen() {
    const rowAt = (event) => event.target.closest("tr[data-case]");
    const row = (line) => rowOf.get(line.dataset.case);
    this.body.addEventListener("click", (event) => {
      const line = rowAt(event);
      if (!line) return;
      if (event.target.closest(".copy")) copyScene(row(line), event.target.closest(".copy"));
      else show(row(line), line);
    });
    this.body.addEventListener("keydown", (event) => {
      const line = rowAt(event);
      if (!line) return;
      const near = { ArrowDown: line.nextElementSibling, ArrowUp: line.previousElementSibling }[event.key];
      if (near?.dataset.case) {
        line.tabIndex = -1;
        near.tabIndex = 0;
        near.focus();
      } else if (event.key === "Enter") show(row(line), line);
      else if (event.key === "c" && !event.ctrlKey && !event.metaKey && this.copies) copyScene(row(line), line.querySelector(".copy"));
      else return;
      event.preventDefault();
    });
    for (const kind of ["pointerover", "focusin"]) this.body.addEventListener(kind, (event) => { const line = rowAt(event); point(line ? row(line) : -1); });
    this.body.addEventListener("pointerleave", () => point(-1));
  }
}
