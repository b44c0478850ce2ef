// What the lattice planner weighed: curves along and across the line, their pairs, what each costs and what is wrong
// with it; the colours of costs, and which pair is pointed at.

const HALF_SECOND = 0.5; // time between two points of a longitudinal curve
const KINDS = { c: "to cruise", p: "beside an obstacle", s: "to the stop point" };
const UNFIT = { s: "passes the stop point", l: "breaks limits of speed, acceleration or jerk" };
const COSTS = ["speed and way", "jerk along", "nearness along", "bends", "offset", "acceleration across"];
const SCALE = 7; // colours of the scale of costs in the style sheet
const PICK = 9; // pixels within which the pointer means a curve

// Places of the curves that the pointer is on or that a click holds: {lateral, longitudinal}, either may be absent.
const pointed = { lateral: null, longitudinal: null };
const held = { lateral: null, longitudinal: null };

let weighed = null;

/// Whole numbers out of letters, as `letters.rs` writes them.
function numbers(text) {
  const all = [];
  let number = 0, scale = 1;
  for (let k = 0; k < text.length; k++) {
    const code = text.charCodeAt(k);
    const digit = code - 35 - (code > 60) - (code > 92);
    number += (digit % 45) * scale;
    scale *= 45;
    if (digit >= 45) continue;
    all.push(number % 2 ? -(number + 1) / 2 : number / 2);
    [number, scale] = [0, 1];
  }
  return all;
}

function sums(differences) {
  let sum = 0;
  return differences.map((difference) => (sum += difference));
}

/// `t, s, t, s, …`
const alongOf = (place, s0) => sums(sums(numbers(run.curves[place]))).flatMap((way, k) => [k * HALF_SECOND, s0 + way / 10]);

/// `s, l, s, l, …`
const acrossOf = (place, s0) => numbers(run.curves[place]).map((number, k) => (k % 2 ? number / 100 : s0 + number));

/// Every pair with its six costs, their sum and its fault; in the order of the curves.
function pairsOf(bundle, longitudinal, lateral) {
  const [alone, together, wrong] = [bundle.alone, bundle.together, bundle.wrong].map(numbers);
  const pairs = [];
  longitudinal.filter(({ unfit }) => !unfit).forEach((along, k) => lateral.forEach((across) => {
    const at = pairs.length;
    const costs = [...alone.slice(4 * k, 4 * k + 4), ...together.slice(2 * at, 2 * at + 2)].map((cost) => cost / 100);
    const fault = wrong[at] ? run.texts[bundle.faults[wrong[at] - 1]] : null;
    const pair = { along, across, costs, cost: costs.reduce((sum, cost) => sum + cost, 0), fault };
    pair.driven = bundle.chosen?.[0] === along.k && bundle.chosen[1] === across.k;
    pairs.push(pair);
    for (const curve of [along, across]) curve.pairs.push(pair);
  }));
  return pairs;
}

/// The cheapest pair that may be driven; the driven one first, for the sums are rounded.
const cheapest = (pairs) => pairs.reduce((best, pair) =>
  (!best || pair.driven || (!best.driven && pair.cost < best.cost) ? pair : best), null);

/// What was weighed in a tick; null where nothing was, or nothing is known.
function weigh(tick) {
  const { bundle } = tick;
  if (!bundle) return null;
  if (weighed?.bundle === bundle) return weighed;
  const [s0] = bundle.start;
  const lateral = sums(numbers(bundle.lateral)).map((place, k) => ({ k, points: acrossOf(place, s0), pairs: [] }));
  const longitudinal = sums(numbers(bundle.longitudinal)).map((place, k) =>
    ({ k, points: alongOf(place, s0), kind: KINDS[bundle.kinds[k]], unfit: UNFIT[bundle.unfit[k]] ?? null, pairs: [] }));
  const pairs = pairsOf(bundle, longitudinal, lateral);
  for (const curve of [...lateral, ...longitudinal]) curve.best = cheapest(curve.pairs.filter(({ fault }) => !fault));
  const free = pairs.filter(({ fault }) => !fault);
  const costs = free.map(({ cost }) => cost);
  const driven = pairs.find((pair) => pair.driven) ?? null;
  const { braking } = bundle;
  weighed = {
    bundle, lateral, longitudinal, pairs, free, driven, span: costs.length ? [Math.min(...costs), Math.max(...costs)] : null,
    braking: braking && { ...braking, points: alongOf(braking.longitudinal, s0) },
    drivenAcross: driven?.across ?? (braking ? lateral[braking.lateral] : null),
  };
  return weighed;
}

/// Share of the scale that a cost has: its cheap end, where it matters, gets more of it.
function shareOf({ span }, cost) {
  const [low, high] = span;
  return high > low ? Math.sqrt(Math.max(0, Math.min(1, (cost - low) / (high - low)))) : 0;
}

function scaleInk(share) {
  const stop = Math.min(share * (SCALE - 1), SCALE - 1 - 1e-9);
  const [low, part] = [Math.floor(stop), stop % 1];
  return `color-mix(in oklab, ${colour(`v${low + 1}`)} ${Math.round(part * 100)}%, ${colour(`v${low}`)})`;
}

/// Curves as they are painted, what matters most last: those in no free pair, then from the dearest to the cheapest.
function inOrder(curves) {
  const rank = (curve) => (curve.best ? curve.best.cost : curve.pairs.length ? 1e9 : 2e9);
  return [...curves].sort((a, b) => rank(b) - rank(a));
}

/// Strokes a curve in the colour of its best pair; grey and dashed where none of them may be driven.
function strokeCurve(context, points, map, curve, width = 1.5) {
  if (!curve.best && !state.rejected) return;
  trace(context, points, map);
  context.lineWidth = curve.best ? width : 1;
  context.globalAlpha = curve.unfit ? 0.55 : 1;
  context.strokeStyle = curve.best ? scaleInk(shareOf(weighed, curve.best.cost)) : colour("rejected");
  context.setLineDash(curve.best ? [] : [4, 3]);
  context.stroke();
  context.setLineDash([]);
  context.globalAlpha = 1;
}

/// The colour of what is driven: braking is not what was sampled.
const drivenInk = ({ bundle }) => (bundle?.braking ? (bundle.braking.against === null ? "warn" : "bad") : "path");

/// What is driven, and what the pointer is on.
function strokeStrong(context, points, map, ink, width, dash = []) {
  trace(context, points, map);
  context.lineWidth = width;
  context.strokeStyle = colour(ink);
  context.setLineDash(dash);
  context.stroke();
  context.setLineDash([]);
}

/// The curve that is nearest to the pointer, if one is near; among equals the cheapest, and rather one that may be driven.
function curveAt(curves, map, x, y) {
  let found = null, least = PICK;
  for (const curve of inOrder(curves).filter((one) => one.best || state.rejected)) {
    const handicap = curve.best ? 0 : PICK / 3;
    for (let k = 0; k + 3 < curve.points.length; k += 2) {
      const [s, l, s2, l2] = curve.points.slice(k, k + 4);
      const distance = fromSegment(map(s, l), map(s2, l2), x, y) + handicap;
      // Half a pixel apart they are equal, and the later one in this order is cheaper.
      if (distance < least + 0.5 && distance < PICK) [found, least] = [curve, Math.min(distance, least)];
    }
  }
  return found;
}

function fromSegment([ax, ay], [bx, by], x, y) {
  const [dx, dy] = [bx - ax, by - ay];
  const t = Math.max(0, Math.min(1, ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy || 1)));
  return Math.hypot(x - ax - t * dx, y - ay - t * dy);
}

/// The pair that is pointed at: of both curves, or the best one of the only one.
function pointedPair() {
  if (!weighed) return null;
  const across = weighed.lateral[pointed.lateral ?? held.lateral] ?? null;
  const along = weighed.longitudinal[pointed.longitudinal ?? held.longitudinal] ?? null;
  if (across && along) return along.pairs.find((pair) => pair.across === across) ?? null;
  const curve = across ?? along;
  return curve && (curve.best ?? cheapest(curve.pairs));
}

/// How often each fault keeps a pair of a list from being driven: [[words, count]], most frequent first.
function faultCounts(pairs) {
  const counts = new Map();
  for (const { fault } of pairs) if (fault) counts.set(fault, (counts.get(fault) ?? 0) + 1);
  return [...counts].sort((a, b) => b[1] - a[1]);
}

/// A curve in words, for a tooltip.
function curveText(curve, name) {
  const lines = [`${name} curve ${curve.k}${curve.kind ? ` (${curve.kind})` : ""}`];
  if (curve.unfit) return [...lines, `in no pair: ${curve.unfit}`].join("\n");
  const free = curve.pairs.filter(({ fault }) => !fault).length;
  if (curve.best) lines.push(`best pair costs ${fixed(curve.best.cost)}${curve.best.driven ? ": it is driven" : ""}`);
  lines.push(`${free} of ${curve.pairs.length} pairs may be driven`);
  for (const [fault, count] of faultCounts(curve.pairs)) lines.push(`${count} ${count === 1 ? "pair" : "pairs"}: ${fault}`);
  return lines.join("\n");
}

/// What of the lateral curves belongs under everything else; `map` from station and offset.
function paintAcross(context, map) {
  if (!weigh(ticks[state.k])) return;
  for (const curve of inOrder(weighed.lateral)) strokeCurve(context, curve.points, map, curve);
}

function paintPointedAcross(context, map) {
  const pair = weigh(ticks[state.k]) && pointedPair();
  const across = pair?.across ?? weighed?.lateral[pointed.lateral ?? held.lateral];
  if (across) strokeStrong(context, across.points, map, "text", 2.6, pair?.fault ? [6, 3] : []);
}

/// A click on a curve holds it, so that the pointer can choose its partner in the other picture.
function hold(which, curve) {
  if (curve?.pairs.length) held[which] = held[which] === curve.k ? null : curve.k;
  else Object.assign(held, { lateral: null, longitudinal: null });
}

followers.push(() => {
  if (weighed?.bundle === ticks[state.k].bundle) return;
  Object.assign(held, { lateral: null, longitudinal: null });
  Object.assign(pointed, { lateral: null, longitudinal: null });
  weighed = null;
  weigh(ticks[state.k]);
});
