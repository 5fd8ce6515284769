// Measures a page as it is laid out, in frames of several widths, and writes what is wrong.
"use strict";
const LEAST_SIZE = 9, LEAST_CONTRAST = 3, FEWEST_TICKS = 4, TOUCH = 0.75, FULL = 0.75;
const problems = [], counts = {};
let where = "";

function wrong(rule, words) {
  problems.push(`${where}: ${rule}: ${words}`);
}

function count(name, by = 1) {
  counts[name] = (counts[name] || 0) + by;
}

function shown(box) {
  return box.width > 0 && box.height > 0;
}

// Every piece of text that can be seen: its words, its element, its box.
function texts(document) {
  const found = [];
  for (const element of document.querySelectorAll("svg text")) {
    found.push({ words: element.textContent, element, box: element.getBoundingClientRect(), drawn: true });
  }
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (walker.nextNode()) {
    const node = walker.currentNode, element = node.parentElement;
    if (!node.data.trim() || element.closest("svg, script, style, details:not([open]) > :not(summary)")) continue;
    const range = document.createRange();
    range.selectNodeContents(node);
    for (const box of range.getClientRects()) found.push({ words: node.data.trim(), element, box, drawn: false });
  }
  return found.filter((text) => text.words && shown(text.box));
}

function overlaps(a, b) {
  return a.left < b.right - TOUCH && b.left < a.right - TOUCH && a.top < b.bottom - TOUCH && b.top < a.bottom - TOUCH;
}

function checkOverlaps(all) {
  const sorted = [...all].sort((a, b) => a.box.top - b.box.top);
  sorted.forEach((a, index) => {
    for (let next = index + 1; next < sorted.length && sorted[next].box.top < a.box.bottom; next++) {
      const b = sorted[next];
      if ((a.drawn || b.drawn) && overlaps(a.box, b.box)) wrong("texts overlap", `"${a.words}" and "${b.words}"`);
    }
  });
}

function checkFrames(all, document) {
  for (const { words, element, box, drawn } of all) {
    const frame = drawn ? element.closest("svg").getBoundingClientRect() : null;
    if (frame && (box.left < frame.left - TOUCH || box.right > frame.right + TOUCH || box.top < frame.top - TOUCH || box.bottom > frame.bottom + TOUCH)) {
      wrong("text leaves its frame", `"${words}"`);
    }
    if (!element.closest(".wide table") && box.right > document.documentElement.clientWidth + TOUCH) {
      wrong("text leaves the page", `"${words}"`);
    }
  }
}

function checkSizes(all) {
  for (const { words, element, drawn } of all) {
    const svg = element.closest("svg"), size = parseFloat(getComputedStyle(element).fontSize);
    const scale = drawn ? svg.getBoundingClientRect().width / svg.viewBox.baseVal.width : 1;
    if (size * scale < LEAST_SIZE - 0.01) wrong("small text", `"${words}" is ${(size * scale).toFixed(2)} px`);
  }
}

function channels(colour) {
  const parts = colour.match(/[\d.]+/g);
  return parts && parts.length >= 3 && !(parts.length > 3 && +parts[3] === 0) ? parts.slice(0, 3).map(Number) : null;
}

function shine(colour) {
  const [r, g, b] = colour.map((c) => (c /= 255) <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

function contrast(a, b) {
  const [dark, light] = [shine(a), shine(b)].sort((x, y) => x - y);
  return (light + 0.05) / (dark + 0.05);
}

function ground(element) {
  const field = element.closest(".field");
  if (field) return channels(getComputedStyle(field.querySelector("rect")).fill);
  for (let at = element; at; at = at.parentElement) {
    const colour = channels(getComputedStyle(at).backgroundColor);
    if (colour) return colour;
  }
  return [255, 255, 255];
}

function checkContrast(all, document) {
  const told = new Set();
  const check = (element, colour, what) => {
    const ink = channels(colour);
    if (!ink) return;
    count("contrasts");
    const ratio = contrast(ink, ground(element)), words = `${what} ${colour}: ${ratio.toFixed(2)}`;
    if (ratio < LEAST_CONTRAST && !told.has(words)) wrong("little contrast", words);
    told.add(words);
  };
  for (const { element, drawn } of all) {
    const style = getComputedStyle(element);
    check(element, drawn ? style.fill : style.color, "text");
  }
  for (const stroke of document.querySelectorAll(".plot .line, .plot .mark, .plot .bar, .plot .arrow, .plot .strokes")) {
    check(stroke, getComputedStyle(stroke).stroke, "stroke");
  }
}

function checkTicks(document) {
  for (const panel of document.querySelectorAll("svg[data-x]")) {
    count("panels");
    for (const axis of [".axis.x", ".axis.y"]) {
      const ticks = panel.querySelectorAll(`${axis} .tick`).length;
      if (ticks < FEWEST_TICKS) wrong("few ticks", `${ticks} on ${axis} of ${panel.getAttribute("aria-label")}`);
    }
  }
}

// The papers' numbers for one of several curves have its colour.
function isOfACurve(series) {
  const titles = [...series.querySelectorAll(".point title")].map((title) => title.textContent);
  return titles.length > 0 && titles.every((title) => /^printed in Fig\. .* for /.test(title));
}

// No two of the first six series share a colour, a dash or a shape.
function checkSeries(document) {
  for (const panel of document.querySelectorAll("svg[data-x]")) {
    const curves = [...panel.querySelectorAll(".series")].filter((series) => !isOfACurve(series));
    const looks = curves.slice(0, 6).map((series) => {
      const line = series.querySelector(".line:not(.loose)"), mark = series.querySelector(".mark");
      return {
        colour: getComputedStyle(series).color,
        dash: line && (line.getAttribute("stroke-dasharray") || "solid"),
        shape: mark && mark.getAttribute("d").replace(/^M[^m]*/, ""),
      };
    });
    looks.forEach((a, index) => looks.slice(0, index).forEach((b) => {
      count("pairs of series");
      for (const trait of ["colour", "dash", "shape"]) {
        if (a[trait] && a[trait] === b[trait]) wrong("series look alike", `${trait} ${a[trait]} in ${panel.getAttribute("aria-label")}`);
      }
    }));
  }
}

// A bound is open, has an arrow, and no line but dots goes through it.
function checkBounds(document) {
  for (const series of document.querySelectorAll(".series")) {
    const solid = [...series.querySelectorAll(".line:not(.loose)")].map((line) => ` ${line.getAttribute("points")} `).join(" ");
    for (const point of series.querySelectorAll(".point")) {
      const mark = point.querySelector(".mark"), title = point.querySelector("title"), bound = title && title.textContent.includes("≥");
      if (!point.dataset.case || !title || title.textContent.startsWith("printed")) continue; // An open star is a paper's number.
      if (bound !== !!point.querySelector(".arrow") || bound !== mark.classList.contains("open")) wrong("a bound looks like a value", title.textContent);
      const [, x, y] = mark.getAttribute("d").match(/^M(\S+) ([-\d.]+?)m/);
      if (bound) count("bounds");
      if (bound && solid.includes(` ${x},${y} `)) wrong("a line goes through a bound", title.textContent);
    }
  }
}

// Where a page is wide, panels, legends and captions of a line of figures fill most of its width.
function checkWidth(document) {
  const main = document.querySelector("main"), style = main && getComputedStyle(main);
  if (!main || main.clientWidth < 1000) return;
  const room = main.clientWidth - parseFloat(style.paddingLeft) - parseFloat(style.paddingRight);
  for (const line of document.querySelectorAll("main > section:has(> figure:not(.film)), main > .beside")) {
    count("figures");
    const boxes = [...line.querySelectorAll(".panels > svg:not([hidden]), .alone > figcaption")].map((one) => one.getBoundingClientRect());
    const used = Math.max(...boxes.map((box) => box.right)) - Math.min(...boxes.map((box) => box.left));
    if (used < FULL * room) wrong("a figure wastes the width", `${used.toFixed(0)} of ${room} px: ${line.querySelector("h2").textContent}`);
  }
}

// With the rules of print in force: nothing that belongs together is torn apart.
function checkPrint(document) {
  const rules = [["h1, h2, h3, ul.legend", "breakAfter"], ["h1, h2, h3, tr, ul.legend, .panels svg", "breakInside"]];
  for (const [selector, rule] of rules) {
    for (const element of document.querySelectorAll(selector)) {
      count(rule);
      const value = getComputedStyle(element)[rule];
      if (!value.startsWith("avoid")) wrong("torn in print", `${element.tagName} has ${rule}: ${value}`);
    }
  }
  for (const heading of document.querySelectorAll("main > section > h2")) {
    const room = parseFloat(getComputedStyle(heading, "::after").height);
    if (!(room > 4 * parseFloat(getComputedStyle(heading).fontSize))) wrong("a heading may stand alone", heading.textContent);
  }
  for (const head of document.querySelectorAll("thead")) {
    // Chromium repeats no head with a button in it.
    const buttons = [...head.querySelectorAll("button")].filter((button) => getComputedStyle(button).display !== "contents");
    count("heads");
    if (getComputedStyle(head).display !== "table-header-group" || buttons.length) wrong("a table's head is not repeated", head.textContent);
  }
}

// Pages go on laying out what is below after they have loaded.
async function settled(frame) {
  while (frame.contentDocument.querySelector(".opening")) await new Promise((done) => setTimeout(done, 5));
}

addEventListener("load", async () => {
  for (const frame of document.querySelectorAll("iframe")) await settled(frame);
  for (const frame of document.querySelectorAll("iframe")) {
    const page = frame.contentDocument;
    where = frame.title;
    if (frame.title.startsWith("print")) {
      checkPrint(page);
      continue;
    }
    const all = texts(page);
    count("texts", all.length);
    checkOverlaps(all);
    checkFrames(all, page);
    checkSizes(all);
    checkContrast(all, page);
    checkTicks(page);
    checkSeries(page);
    checkBounds(page);
    checkWidth(page);
  }
  const result = document.createElement("pre");
  result.id = "measured";
  result.textContent = JSON.stringify({ problems, counts });
  document.body.append(result);
});
