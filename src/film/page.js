(() => {
  const film = JSON.parse(document.getElementById("film").textContent);
  const find = (id) => document.getElementById(id);
  const count = film.particles, frames = film.times.length;

  const shots = decode(film);
  const colours = film.colours;
  const levels = colours.length;
  // The water at this instant, metres and levels, between two frames.
  const now = { x: new Float32Array(count), y: new Float32Array(count), c: new Uint8Array(count), apart: new Float32Array(count), left: 0, right: 0 };
  let time = film.times[film.crest], playing = false, touched = false, last = 0;

  function place(times) {
    let low = 0, high = times.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (times[middle] <= time) low = middle; else high = middle;
    }
    const span = times[high] - times[low];
    return [low, high, span > 0 ? Math.min(1, Math.max(0, (time - times[low]) / span)) : 0];
  }

  function mix(values, [low, high, share]) {
    return values[low] + share * (values[high] - values[low]);
  }

  function settle() {
    const where = place(film.times), [low, high, share] = where, a = shots[low], b = shots[high];
    for (let k = 0; k < count; k++) {
      const p = 3 * k;
      now.x[k] = film.x0 + film.quantum * (a[p] + share * (b[p] - a[p]));
      now.y[k] = film.y0 + film.quantum * (a[p + 1] + share * (b[p + 1] - a[p + 1]));
      const level = Math.round(a[p + 2] + share * (b[p + 2] - a[p + 2]));
      now.c[k] = level < 0 ? 0 : level >= levels ? levels - 1 : level;
    }
    now.left = mix(film.left, where);
    now.right = mix(film.right, where);
  }

  // Particles by colour, so that the canvas changes its colour 64 times and no more.
  const byColour = new Int32Array(count), starts = new Int32Array(levels + 1);
  function sort() {
    starts.fill(0);
    for (let k = 0; k < count; k++) starts[now.c[k] + 1]++;
    for (let c = 0; c < levels; c++) starts[c + 1] += starts[c];
    const next = starts.slice();
    for (let k = 0; k < count; k++) byColour[next[now.c[k]]++] = k;
  }

  // The top of the water that stands on the bed: in each bin along the tank climb until a gap. Bins end at the wall.
  const bin = { wide: 1.5 * film.spacing, left: 0, tops: [] };
  // The height of the bed: level, or straight between points.
  function bedAt(x) {
    const line = film.bed || [];
    let low = line[0] ? line[0][1] : 0;
    for (let k = 0; k + 1 < line.length; k++) {
      const [[x0, y0], [x1, y1]] = [line[k], line[k + 1]];
      if (x >= x1) low = y1;
      else if (x > x0) return y0 + (y1 - y0) * (x - x0) / (x1 - x0);
    }
    return low;
  }
  const lean = Math.tan((film.angle - 90) * Math.PI / 180);
  // How far apart rows may be at the particles of a bin, which rise: src/film/tops.rs tells why.
  function part(all) {
    const reach = 1.5 * film.spacing;
    let from = 0, to = 0;
    for (const k of all) {
      while (now.y[all[from]] < now.y[k] - reach) from++;
      while (to < all.length && now.y[all[to]] < now.y[k] + reach) to++;
      const high = now.y[all[to - 1]] - now.y[all[from]];
      now.apart[k] = Math.max(2.5 * film.spacing, 0.8 * film.spacing * (to - from) - high);
    }
  }

  function climb() {
    const bins = [], wall = film.length + now.right;
    bin.left = wall - Math.ceil((wall - film.whole.x0) / bin.wide) * bin.wide;
    for (let k = 0; k < count; k++) {
      const at = Math.floor((now.x[k] - bin.left) / bin.wide);
      if (at >= 0) (bins[at] = bins[at] || []).push(k);
    }
    bin.tops = Array.from(bins, (all = [], at) => {
      part(all.sort((a, b) => now.y[a] - now.y[b]));
      const middle = bin.left + (at + 0.5) * bin.wide, behind = middle - wall;
      const floor = bedAt(middle);
      // A basin's side cuts a bin: src/film/tops.rs.
      if (all.length && floor - now.y[all[all.length - 1]] > bin.wide) return null;
      let top = lean > 0 ? Math.max(floor, behind / lean) : floor, found = false;
      for (const k of all) {
        if (now.y[k] - top > now.apart[k]) break;
        top = now.y[k];
        found = true;
      }
      return found ? top + 0.5 * film.spacing : null;
    });
    // Without dips of one or two bins: a gap between particles is no trough of the surface.
    const tops = bin.tops, known = (values) => values.filter((value) => (value ?? null) !== null);
    const highest = (at) => Math.max(...known([tops[at - 1], tops[at], tops[at + 1]]));
    const near = (at) => [at - 1, at, at + 1].map(highest).filter(Number.isFinite);
    bin.tops = tops.map((top, at) => (top === null ? null : Math.min(...near(at))));
  }

  // Between the middles of bins in a straight line.
  function topAt(x) {
    const along = Math.max(0, (x - bin.left) / bin.wide - 0.5), at = Math.floor(along);
    const low = bin.tops[at] ?? null, high = bin.tops[at + 1] ?? low;
    return low === null ? null : low + (along - at) * (high - low);
  }

  function surface() {
    const end = film.wall === "crest" ? film.whole.x1 : film.length + now.right + Math.max(0, lean * film.tall);
    const [from, to] = [now.left + bin.wide, end - 0.4 * bin.wide];
    const points = bin.tops.map((top, at) => [bin.left + (at + 0.5) * bin.wide, top]);
    return points.map((point) => (point[1] === null || point[0] < from || point[0] > to ? null : point));
  }

  let ink = {};
  function readInk() {
    const style = getComputedStyle(document.documentElement);
    for (const name of ["ground", "ink", "quiet", "solid", "line"]) ink[name] = style.getPropertyValue("--" + name);
  }

  // A bar of a round length under a picture: at most a fifth of its width.
  function rule(bar, view, scale) {
    const most = 0.2 * (view.x1 - view.x0), power = 10 ** Math.floor(Math.log10(most));
    const length = [5, 2, 1].map((times) => Number((times * power).toPrecision(1))).find((length) => length <= most);
    bar.querySelector("i").style.width = length * scale + "px";
    bar.querySelector("span").textContent = length + " m";
  }

  function draw(canvas, view) {
    // A tall picture is made narrower, so that all of the page is seen at once.
    canvas.style.maxWidth = 0.62 * window.innerHeight * (view.x1 - view.x0) / (view.y1 - view.y0) + "px";
    const ratio = window.devicePixelRatio || 1, width = canvas.clientWidth;
    const scale = width / (view.x1 - view.x0), height = Math.round(scale * (view.y1 - view.y0));
    rule(canvas.nextElementSibling, view, scale);
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
      canvas.style.height = height + "px";
    }
    const pen = canvas.getContext("2d");
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, height);
    const X = (x) => (x - view.x0) * scale, Y = (y) => height - (y - view.y0) * scale;
    const size = Math.max(1.2, 1.4 * film.spacing * scale);
    for (let c = 0; c < levels; c++) {
      pen.fillStyle = colours[c];
      for (let k = starts[c]; k < starts[c + 1]; k++) {
        const one = byColour[k], x = X(now.x[one]), y = now.y[one];
        if (x < -size || x > width + size) continue;
        // Rows part where water is pushed up: under the surface a particle is drawn tall.
        const top = topAt(now.x[one]), within = top !== null && y <= top;
        const half = within ? 0.5 * now.apart[one] : 0.625 * film.spacing;
        const up = within ? Math.min(half, top - y) : half;
        pen.fillRect(x - size / 2, Y(y + up), size, Math.max(1.2, (half + up) * scale));
      }
    }
    if (film.wall !== "none") furniture(pen, X, Y, scale, view);
  }

  function polygon(pen, corners) {
    pen.beginPath();
    for (const [x, y] of corners) pen.lineTo(x, y);
    pen.closePath();
    pen.fill();
  }

  function furniture(pen, X, Y, scale, view) {
    pen.strokeStyle = ink.ink;
    pen.lineWidth = 1.3;
    pen.lineJoin = "round";
    if (!film.lid) {
      pen.beginPath();
      let down = false;
      for (const point of surface()) {
        if (!point) { down = false; continue; }
        if (down) pen.lineTo(X(point[0]), Y(point[1])); else pen.moveTo(X(point[0]), Y(point[1]));
        down = true;
      }
      pen.stroke();
    }
    pen.fillStyle = ink.solid;
    const thick = 0.12 * film.depth, top = film.tall, bed = 0;
    const inside = (film.bed || []).filter(([x]) => x > view.x0 && x < view.x1).map(([x, y]) => [X(x), Y(y)]);
    polygon(pen, [[X(view.x0), Y(bedAt(view.x0))], ...inside, [X(view.x1), Y(bedAt(view.x1))],
      [X(view.x1), Y(view.y0)], [X(view.x0), Y(view.y0)]]);
    const left = now.left, right = film.length + now.right;
    polygon(pen, [[X(left - thick), Y(bed)], [X(left), Y(bed)], [X(left), Y(top)], [X(left - thick), Y(top)]]);
    if (film.lid) pen.fillRect(X(view.x0), 0, X(view.x1) - X(view.x0), Y(film.lid));
    const over = lean * top;
    const breadth = film.wall === "caisson" ? 0.8 * film.depth : thick;
    if (film.wall !== "crest") polygon(pen, [[X(right), Y(bed)], [X(right + over), Y(top)], [X(right + over + breadth), Y(top)], [X(right + breadth), Y(bed)]]);
    if (film.wall === "spring") {
      const from = X(right + thick), to = X(film.post), y = Y(0.5 * film.depth), swing = 0.1 * film.depth * scale;
      pen.beginPath();
      pen.moveTo(from, y);
      for (let k = 0; k <= 12; k++) pen.lineTo(from + (to - from) * (k + 0.5) / 13, y + (k === 0 || k === 12 ? 0 : k % 2 ? swing : -swing));
      pen.lineTo(to, y);
      pen.stroke();
      pen.fillRect(to, Y(film.depth), 0.06 * film.depth * scale, Y(bed) - Y(film.depth));
    }
  }

  // Decimals that tell places between two values apart: two, or more where these are near one another.
  function decimals(low, high) {
    return Math.min(8, Math.max(2, 1 - Math.floor(Math.log10(high - low || 1))));
  }

  const first = film.times[0], end = film.times[frames - 1], often = decimals(first, end);
  // Curves of F*, R* and X* over time, each with a cursor.
  const charts = film.history.curves.map((curve) => {
    const times = film.history.time_s, box = document.createElement("figure");
    const { low, high } = curve, air = 0.1 * (high - low);
    const beyond = curve.values.some((value) => value > high + air || value < low - air);
    const fine = decimals(low, high);
    const x = (t) => 1000 * (t - first) / (end - first || 1), y = (v) => 100 - 100 * (v - low) / (high - low);
    const points = times.map((t, k) => x(t).toFixed(1) + "," + y(curve.values[k]).toFixed(1)).join(" ");
    // Three levels and five instants, as words beside a drawing that is stretched.
    const levels = [0, 0.5, 1].map((share) => (low + share * (high - low)).toFixed(fine));
    const instants = [0, 0.25, 0.5, 0.75, 1].map((share) => (first + share * (end - first)).toFixed(often));
    box.innerHTML = "<figcaption><b>" + curve.symbol + "</b> <output></output><span></span></figcaption>"
      + '<div class="plot"><div class="levels">' + levels.reverse().map((text) => "<span>" + text + "</span>").join("") + "</div>"
      + '<svg viewBox="0 0 1000 100" preserveAspectRatio="none" role="img">'
      + '<line class="zero" x1="0" x2="1000" y1="' + y(0) + '" y2="' + y(0) + '"/>'
      + '<polyline points="' + points + '"/><line class="cursor" y1="0" y2="100"/></svg>'
      + '<div class="instants">' + instants.map((text, k) => "<span>" + text + (k === 4 ? " s" : "") + "</span>").join("") + "</div></div>";
    box.querySelector("span").textContent = curve.name + (beyond ? "; spikes leave the panel" : "");
    const drawing = box.querySelector("svg"), cursor = box.querySelector(".cursor"), told = box.querySelector("output");
    drawing.setAttribute("aria-label", curve.name + " over time, from " + low.toFixed(fine) + " to " + high.toFixed(fine));
    const pick = (event) => {
      const box = drawing.getBoundingClientRect();
      go(first + (end - first) * (event.clientX - box.left) / box.width);
    };
    drawing.addEventListener("pointerdown", (event) => { drawing.setPointerCapture(event.pointerId); pick(event); });
    drawing.addEventListener("pointermove", (event) => { if (event.buttons) pick(event); });
    find("charts").append(box);
    return () => {
      const value = mix(curve.values, place(times));
      told.textContent = value.toFixed(fine + 1);
      cursor.setAttribute("x1", x(time));
      cursor.setAttribute("x2", x(time));
      return curve.symbol + " " + value.toFixed(fine);
    };
  });

  const slider = find("time"), play = find("play"), clock = find("clock");
  slider.min = first;
  slider.max = end;
  slider.step = "any";

  function render() {
    settle();
    sort();
    if (film.wall !== "none" && !film.lid) climb();
    draw(find("tank"), film.whole);
    if (film.near) {
      const at = film.length + now.right - film.near.x;
      draw(find("wall"), { x0: at, x1: at + film.near.width, y0: film.whole.y0, y1: film.whole.y1 });
    }
    const told = charts.map((show) => show());
    clock.textContent = "t = " + time.toFixed(often) + " s";
    slider.value = time;
    slider.setAttribute("aria-valuetext", time.toFixed(often) + " seconds, " + told.join(", "));
  }

  function go(to) {
    touched = true;
    time = Math.min(film.times[frames - 1], Math.max(film.times[0], to));
    if (!playing) render();
  }

  function tick(stamp) {
    if (!playing) return;
    time += Math.min(0.1, (stamp - last) / 1000) * Number(find("speed").value);
    last = stamp;
    if (time >= film.times[frames - 1]) { time = film.times[frames - 1]; toggle(); }
    render();
    if (playing) requestAnimationFrame(tick);
  }

  function toggle() {
    playing = !playing;
    play.textContent = playing ? "Pause" : "Play";
    if (!playing) return;
    if (!touched || time >= film.times[frames - 1]) time = film.times[0];
    touched = true;
    last = performance.now();
    requestAnimationFrame(tick);
  }

  function step(by) {
    if (playing) toggle();
    const [low, , share] = place(film.times);
    const at = share > 0.999 ? low + 1 : low;
    go(film.times[Math.min(frames - 1, Math.max(0, at + (by > 0 ? 1 : share > 0.001 && share <= 0.999 ? 0 : -1)))]);
  }

  play.addEventListener("click", toggle);
  for (const name of ["crest", "highest"]) {
    find(name).addEventListener("click", () => { if (playing) toggle(); go(film.times[film[name]]); });
  }
  slider.addEventListener("input", () => go(Number(slider.value)));
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.tagName === "SELECT") return;
    const keys = {
      " ": () => { if (event.target.tagName === "BUTTON") return false; toggle(); },
      ArrowLeft: () => step(-1),
      ArrowRight: () => step(1),
      Home: () => go(film.times[0]),
      End: () => go(film.times[frames - 1]),
    };
    if (keys[event.key] && keys[event.key]() !== false) event.preventDefault();
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { readInk(); render(); });
  window.addEventListener("resize", render);
  readInk();
  find("player").hidden = false;
  if (!film.near) find("wall").parentNode.remove();
  if (!charts.length) find("crest").remove();
  if (!charts.length || film.highest === film.crest) find("highest").remove();
  render();
})();
