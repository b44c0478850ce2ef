// The Frenet picture: stations to the right, offsets upwards (left is up), every candidate bound or lateral curve,
// obstacles as the line sees them, the path. Hovering names the cause of the edges.

const GUTTER = { left: 44, right: 10, top: 8, bottom: 30 };
const BEHIND = 14; // metres shown behind the ego
const AHEAD = run.lattice ? 92 : 112; // and ahead of it: lateral curves end after 80

const range = { ahead: AHEAD, behind: BEHIND, low: null, high: null };
const frenetView = canvasView("frenet", paintFrenet);

function frenetReset() {
  Object.assign(range, { ahead: AHEAD, behind: BEHIND, low: null, high: null });
}

/// Offsets worth showing by default: the road, with a little room, and the bounds.
function offsets(tick) {
  const line = lineCaches[tick.line];
  // Lateral curves end within half a metre of the line: the lane is enough for them.
  const [lefts, rights] = run.lattice ? line.lane : line.road;
  let [low, high] = run.lattice ? [-1, 1] : [-3, 3];
  line.s.forEach((s, k) => {
    if (s < tick.sl[0] - BEHIND || s > tick.sl[0] + AHEAD) return;
    low = Math.min(low, -rights[k]);
    high = Math.max(high, lefts[k]);
  });
  if (run.lattice) [low, high] = [Math.min(low, tick.sl[1] - 1), Math.max(high, tick.sl[1] + 1)];
  return [Math.max(low, -14) - 1.2, Math.min(high, 14) + 1.2];
}

function frenetMap(width, height) {
  const tick = ticks[state.k];
  if (range.low === null || state.follow) {
    const wanted = offsets(tick);
    if (!range.manual || range.low === null) {
      [range.low, range.high] = wanted;
      range.manual = false;
    }
  }
  const [s0, s1] = [tick.sl[0] - range.behind, tick.sl[0] + range.ahead];
  const [w, h] = [width - GUTTER.left - GUTTER.right, height - GUTTER.top - GUTTER.bottom];
  const map = (s, l) => [
    GUTTER.left + ((s - s0) / (s1 - s0)) * w,
    GUTTER.top + ((range.high - l) / (range.high - range.low)) * h,
  ];
  map.inverse = (x, y) => [
    s0 + ((x - GUTTER.left) / w) * (s1 - s0),
    range.high - ((y - GUTTER.top) / h) * (range.high - range.low),
  ];
  return Object.assign(map, { s0, s1, w, h });
}

const shown = (tick) => tick.candidates
  .map((candidate, k) => ({ candidate, k, text: run.labels[candidate.label] }))
  .filter(({ text }) => !state.hidden.has(text));

function paintSurface(context, map, line) {
  const [ox, oy] = map(0, 0);
  const [ax, ay] = map(1, 1);
  const matrix = new DOMMatrix([ax - ox, 0, 0, ay - oy, ox, oy]);
  for (const part of line.last > 1 ? groundOnLine(line, map.s0, map.s1) : []) {
    const [left, right] = [Math.max(part.from, map.s0), Math.min(part.to, map.s1)].map((s) => map(s, 0)[0]);
    context.save();
    context.beginPath();
    context.rect(Math.floor(left), 0, Math.ceil(right) - Math.floor(left), GUTTER.top + map.h);
    context.clip();
    paintGround(context, part, matrix, ax - ox, 2);
    context.restore();
  }
  // What the line itself says of its lane and of the road's edge: this is what bounds are made from.
  for (const [side, sign] of [[0, 1], [1, -1]]) {
    for (const [widths, ink, width] of [[line.lane, "lane-edge", 1], [line.road, "surface-edge", 1.6]]) {
      context.beginPath();
      line.s.forEach((s, k) => context.lineTo(...map(s, sign * widths[side][k])));
      context.strokeStyle = colour(ink);
      context.lineWidth = width;
      context.stroke();
    }
  }
}

function paintAxes(context, map, width, height) {
  context.strokeStyle = colour("soft");
  context.fillStyle = colour("soft");
  context.lineWidth = 1;
  context.textBaseline = "middle";
  context.textAlign = "right";
  const lateral = roundSteps(range.low, range.high, map.h / 26);
  for (const l of lateral.values) {
    const y = map(0, l)[1];
    context.globalAlpha = Math.abs(l) < 1e-9 ? 0.5 : 0.14;
    context.beginPath(); context.moveTo(GUTTER.left, y); context.lineTo(GUTTER.left + map.w, y); context.stroke();
    context.globalAlpha = 1;
    context.fillText(fixed(l, lateral.decimals), GUTTER.left - 5, y);
  }
  context.textAlign = "center";
  const along = roundSteps(map.s0, map.s1, map.w / 90);
  for (const s of along.values) {
    const x = map(s, 0)[0];
    context.globalAlpha = 0.14;
    context.beginPath(); context.moveTo(x, GUTTER.top); context.lineTo(x, GUTTER.top + map.h); context.stroke();
    context.globalAlpha = 1;
    context.fillText(fixed(s, along.decimals), x, height - GUTTER.bottom + 9);
  }
  context.fillText("station s [m]", GUTTER.left + map.w / 2, height - 8);
  context.save();
  context.translate(9, GUTTER.top + map.h / 2);
  context.rotate(-Math.PI / 2);
  context.fillText(map.h > 150 ? "offset l [m], left is up" : "l [m], left is up", 0, 0);
  context.restore();
}

/// The part of an edge between two stations.
function stretch(edge, from, to) {
  const at = (s) => {
    for (let k = 0; k + 3 < edge.at.length; k += 2) {
      const [s0, l0, s1, l1] = edge.at.slice(k, k + 4);
      if (s >= s0 && s <= s1) return l0 + ((l1 - l0) * (s - s0)) / (s1 - s0 || 1);
    }
    return null;
  };
  const inner = [];
  for (let k = 0; k < edge.at.length; k += 2) if (edge.at[k] > from && edge.at[k] < to) inner.push(edge.at[k], edge.at[k + 1]);
  const [l0, l1] = [at(from), at(to)];
  return [...(l0 === null ? [] : [from, l0]), ...inner, ...(l1 === null ? [] : [to, l1])];
}

/// Runs of one cause: {from, to, text, kind}.
function causesOf(edge) {
  const end = edge.at[edge.at.length - 2];
  return edge.classes.map((kind, k) => ({
    kind, text: run.texts[edge.causes[2 * k]], from: edge.causes[2 * k + 1], to: edge.causes[2 * k + 3] ?? end,
  }));
}

function paintBound(context, map, { candidate, k, text }, tick) {
  const chosen = tick.chosen === k;
  const ink = colour(labelColour(text));
  const forward = candidate.right.at, backward = candidate.left.at;
  if (chosen) {
    trace(context, forward, map);
    for (let j = backward.length - 2; j >= 0; j -= 2) context.lineTo(...map(backward[j], backward[j + 1]));
    context.closePath();
    context.fillStyle = ink;
    context.globalAlpha = 0.14;
    context.fill();
  }
  context.globalAlpha = chosen ? 1 : 0.75;
  context.lineWidth = chosen ? 2.8 : 1.5;
  for (const edge of [candidate.right, candidate.left]) {
    context.setLineDash(labelDash(text));
    context.strokeStyle = ink;
    if (!state.byCause) {
      trace(context, edge.at, map);
      context.stroke();
      continue;
    }
    for (const { kind, from, to } of causesOf(edge)) {
      context.strokeStyle = colour(`k-${kind}`);
      trace(context, stretch(edge, from, to), map);
      context.stroke();
    }
  }
  context.setLineDash([]);
  context.globalAlpha = 1;
  paintEnd(context, map, candidate, ink);
}

/// A bar where a bound is closed, with the name of what closes it.
function paintEnd(context, map, candidate, ink) {
  const [right, left] = [candidate.right.at, candidate.left.at];
  if (candidate.blocked === null || right.length < 2) return;
  const s = right[right.length - 2];
  const low = map(s, right[right.length - 1]), high = map(s, left[left.length - 1]);
  context.strokeStyle = ink;
  context.lineWidth = 3;
  context.beginPath(); context.moveTo(...low); context.lineTo(...high); context.stroke();
}

function paintShapes(context, map, tick) {
  for (const obstacle of obstaclesOf(tick)) {
    const ink = obstacleColour(obstacle);
    if (state.predictions && obstacle.prediction.length) {
      context.strokeStyle = colour(ink);
      context.lineWidth = 1.2;
      context.setLineDash([2, 3]);
      trace(context, obstacle.prediction, map, 6, 4);
      context.stroke();
      context.setLineDash([]);
    }
    paintBody(context, map, obstacle, obstacle.sl);
  }
}

/// The place to pull over and the destination, as the line sees them.
function paintTargetOnLine(context, map, tick) {
  const line = lineCaches[tick.line];
  const place = (x, y) => map(...toLineNear(line, tick.sl[0], x, y));
  if (tick.destination) paintPin(context, place(...tick.destination));
  if (!tick.pull_over) return;
  const [x, y, theta] = tick.pull_over;
  targetStroke(context);
  egoOutline(context, place, x, y, theta);
  context.stroke();
  paintCross(context, place(x, y));
}

function paintShapeNames(context, map, tick) {
  const taken = [];
  for (const obstacle of obstaclesOf(tick)) {
    const s = obstacle.sl.filter((_, k) => k % 2 === 0), l = obstacle.sl.filter((_, k) => k % 2 === 1);
    const [x, y] = map((Math.min(...s) + Math.max(...s)) / 2, (Math.min(...l) + Math.max(...l)) / 2);
    const half = context.measureText(nameOf(obstacle.id)).width / 2;
    if (x - half < GUTTER.left || x + half > GUTTER.left + map.w || y < GUTTER.top || y > GUTTER.top + map.h) continue;
    if (taken.some(([tx, ty, th]) => Math.abs(tx - x) < half + th + 6 && Math.abs(ty - y) < 14)) continue;
    taken.push([x, y, half]);
    label(context, nameOf(obstacle.id), x, y, { align: "center", base: "middle" });
  }
}

function paintEgoAndPath(context, map, tick) {
  const heading = tick.ego[2] - onLine(lineCaches[tick.line], tick.sl[0]).theta;
  const [s, l] = tick.sl;
  const { front, back, half_width: half } = run.vehicle;
  context.beginPath();
  for (const [f, side] of [[-back, -half], [front, -half], [front, half], [-back, half]]) {
    context.lineTo(...map(s + f * Math.cos(heading) - side * Math.sin(heading), l + f * Math.sin(heading) + side * Math.cos(heading)));
  }
  context.closePath();
  context.fillStyle = colour("ego-fill");
  context.fill();
  context.strokeStyle = colour("ego");
  context.lineWidth = 1.8;
  context.stroke();
  context.lineWidth = run.lattice ? 3.4 : 2.2;
  context.strokeStyle = colour(drivenInk(tick));
  trace(context, tick.path, map, 4, 0);
  context.stroke();
  context.beginPath();
  context.arc(...map(s, l), 3, 0, 7);
  context.fillStyle = colour("ego");
  context.fill();
}

/// Where the front bumper comes to rest, and for what.
function paintStop(context, map, tick) {
  if (!tick.stop_at || tick.stop === null) return;
  const [, s, l] = tick.stop_at;
  const { front, half_width: half } = run.vehicle;
  const [x] = map(s + front, l);
  if (x < GUTTER.left || x > GUTTER.left + map.w) return;
  context.strokeStyle = colour("bad");
  context.lineWidth = 1;
  context.setLineDash([4, 3]);
  context.beginPath(); context.moveTo(x, GUTTER.top); context.lineTo(x, GUTTER.top + map.h); context.stroke();
  context.setLineDash([]);
  context.lineWidth = 3;
  context.beginPath(); context.moveTo(...map(s + front, l + half + 0.3)); context.lineTo(...map(s + front, l - half - 0.3)); context.stroke();
  const text = run.texts[tick.stop].replaceAll("`", "");
  const right = x + context.measureText(text).width + 10 > GUTTER.left + map.w;
  label(context, text, x + (right ? -5 : 5), GUTTER.top + 10, { ink: "bad", align: right ? "right" : "left" });
}

function paintFrenet(context, width, height) {
  if (!ticks.length) return;
  const tick = ticks[state.k];
  const map = frenetMap(width, height);
  context.save();
  context.beginPath();
  context.rect(GUTTER.left, GUTTER.top, map.w, map.h);
  context.clip();
  context.fillStyle = colour("ground");
  context.fillRect(GUTTER.left, GUTTER.top, map.w, map.h);
  paintSurface(context, map, lineCaches[tick.line]);
  paintShapes(context, map, tick);
  const order = shown(tick).sort((a, b) => (a.k === tick.chosen) - (b.k === tick.chosen));
  for (const item of order) paintBound(context, map, item, tick);
  paintAcross(context, map);
  paintEgoAndPath(context, map, tick);
  paintPointedAcross(context, map);
  paintTargetOnLine(context, map, tick);
  paintStop(context, map, tick);
  paintShapeNames(context, map, tick);
  paintHover(context, map, tick);
  context.restore();
  paintAxes(context, map, width, height);
}

/// The edge nearest to the pointer: its candidate, side, station, limit and cause.
function edgeAt(map, tick, x, y) {
  const [s] = map.inverse(x, y);
  let best = null;
  for (const item of shown(tick)) {
    for (const [side, edge] of [["left", item.candidate.left], ["right", item.candidate.right]]) {
      const found = causesOf(edge).find(({ from, to }) => s >= from && s <= to);
      const part = found && stretch(edge, s, s);
      if (!part || part.length < 2) continue;
      const distance = Math.abs(map(s, part[1])[1] - y) - (item.k === tick.chosen ? 3 : 0);
      if (!best || distance < best.distance) best = { ...item, side, edge, run: found, s, l: part[1], distance };
    }
  }
  return best && best.distance < 14 ? best : null;
}

/// The whole stretch with the same cause as the edge under the pointer.
function paintHover(context, map, tick) {
  if (!frenetView.hover) return;
  const found = edgeAt(map, tick, ...frenetView.hover);
  if (!found) return;
  context.lineWidth = 7;
  context.globalAlpha = 0.45;
  context.strokeStyle = colour(`k-${found.run.kind}`);
  trace(context, stretch(found.edge, found.run.from, found.run.to), map);
  context.stroke();
  context.globalAlpha = 1;
}

function frenetText(x, y) {
  if (!ticks.length) return null;
  const tick = ticks[state.k];
  const map = frenetMap(frenetView.width, frenetView.height);
  const found = edgeAt(map, tick, x, y);
  if (found) {
    return `${found.text}${found.k === tick.chosen ? " (chosen)" : ""}\n${found.side} limit ${signed(found.l)} m at s ${fixed(found.s, 1)} m\n` +
      `from: ${found.run.text}\nso from s ${fixed(found.run.from, 1)} to ${fixed(found.run.to, 1)} m`;
  }
  const curve = across(x, y);
  pointed.lateral = curve?.k ?? null;
  if (curve) return curveText(curve, "lateral");
  const obstacle = obstaclesOf(tick).find((o) => within(o.sl, map, x, y));
  return obstacle ? obstacleText(obstacle, tick) : null;
}

/// The lateral curve under the pointer.
function across(x, y) {
  if (!ticks.length || !weigh(ticks[state.k])) return null;
  return curveAt(weighed.lateral, frenetMap(frenetView.width, frenetView.height), x, y);
}

pointer(frenetView, {
  click(x, y) { if (run.lattice) hold("lateral", across(x, y)); },
  drag(dx, dy) {
    if (!ticks.length) return;
    const { w, h } = frenetMap(frenetView.width, frenetView.height);
    const along = (dx / w) * (range.ahead + range.behind);
    range.ahead -= along;
    range.behind += along;
    const across = (dy / h) * (range.high - range.low);
    range.low += across;
    range.high += across;
    range.manual = true;
  },
  wheel(factor, x, y, event) {
    if (!ticks.length) return;
    const [s, l] = frenetMap(frenetView.width, frenetView.height).inverse(x, y);
    const from = s - ticks[state.k].sl[0];
    if (event.shiftKey || event.altKey) {
      range.low = l + (range.low - l) / factor;
      range.high = l + (range.high - l) / factor;
      range.manual = true;
      return;
    }
    const length = (range.ahead + range.behind) / factor;
    if (length < 2 || length > 5000) return;
    range.ahead = from + (range.ahead - from) / factor;
    range.behind = -from + (range.behind + from) / factor;
  },
  hover: frenetText,
  reset: frenetReset,
});
frenetView.canvas.addEventListener("pointerleave", () => { pointed.lateral = null; });
