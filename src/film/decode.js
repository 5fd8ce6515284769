"use strict";
// The coder of src/film/coder.rs and the predictions of src/film/codec.rs, taken apart: for each frame x, y
// and colour of all particles, one particle after the other, in quanta.
function decode(film) {
  const count = film.particles, frames = film.times.length, column = film.column;
  const bytes = Uint8Array.from(atob(film.data), (letter) => letter.charCodeAt(0));
  let at = 0, code = 0, range = 0xffffffff;
  const take = () => { code = ((code << 8) | (at < bytes.length ? bytes[at] : 0)) >>> 0; at++; };
  for (let k = 0; k < 5; k++) take();
  const UNARY = 14, CHANCES = UNARY + 4, SURROUNDINGS = 8;
  const chances = new Uint16Array(6 * SURROUNDINGS * CHANCES).fill(1024);
  function bit(place) {
    const chance = chances[place], bound = (range >>> 11) * chance;
    let set = 0;
    if (code < bound) {
      range = bound;
      chances[place] = chance + ((2048 - chance) >> 5);
    } else {
      set = 1;
      code = (code - bound) >>> 0;
      range = (range - bound) >>> 0;
      chances[place] = chance - (chance >> 5);
    }
    while (range < 16777216) { range = (range << 8) >>> 0; take(); }
    return set;
  }
  function number(place) {
    if (!bit(place)) return 0;
    const negative = bit(place + 1);
    let size = 1;
    while (size < UNARY && bit(place + 1 + size)) size++;
    if (size === UNARY) {
      let digits = 0, read = 1;
      while (bit(place + 2 + UNARY)) digits++;
      for (; digits > 0; digits--) read = (read << 1) | bit(place + 3 + UNARY);
      size += read - 1;
    }
    return negative ? -size : size;
  }
  const SURROUNDING = [0, 1, 2, 3, 4, 4, 5, 5, 5];
  const points = new Int32Array(3 * count), moves = new Int32Array(3 * count);
  const off = new Int32Array(3 * count), all = [];
  for (let t = 0; t < frames; t++) {
    const first = t === 0, known = first ? points : moves;
    for (let k = 0; k < count; k++) {
      for (let channel = 0; channel < 3; channel++) {
        const own = 3 * k + channel;
        const a = k >= 1 ? own - 3 : -1, b = k >= column ? own - 3 * column : -1;
        const c = k >= column + 1 ? own - 3 * column - 3 : -1;
        const value = (place) => (place < 0 ? 0 : known[place]);
        const size = (place) => (place < 0 ? 0 : Math.abs(off[place]));
        const before = points[own];
        const predicted = first
          ? value(a) + value(b) - value(c)
          : before + ((value(a) + value(b)) >> 1);
        const unrest = size(a) + size(b) + (first ? 0 : Math.abs(off[own]));
        const surrounding = unrest < 9 ? SURROUNDING[unrest] : unrest < 16 ? 6 : 7;
        const found = number(((first ? 3 : 0) + channel) * SURROUNDINGS * CHANCES + surrounding * CHANCES);
        points[own] = predicted + found;
        moves[own] = first ? 0 : points[own] - before;
        off[own] = found;
      }
    }
    all.push(Int16Array.from(points));
  }
  return all;
}
