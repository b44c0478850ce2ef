// The path-time diagram of the lattice planner: time to the right, stations upwards; what occupies the lane when, and
// every longitudinal curve. Stations of curves are those of the rear axle, boxes are whole bodies.

const ST = { left: 46, right: 10, top: 10, bottom: 30 };
const ST_HORIZON = 8; // seconds
const ST_LEAST = 20; // metres shown at least
const ST_BEHIND = 0.06; // share of the height below the start

const stView = canvasView("st", paintSt);

/// Stations to show: the curves that are in pairs and what is driven; boxes are cut off.
function stMap(width, height) {
  const [s0] = weighed.bundle.start;
  const curves = [...weighed.longitudinal.filter(({ unfit }) => !unfit), ...(weighed.braking ? [weighed.braking] : [])];
  const reach = Math.max(ST_LEAST, ...curves.map(({ points }) => points[points.length - 1] - s0)) * 1.05;
  const [low, high] = [s0 - reach * ST_BEHIND, s0 + reach];
  const [w, h] = [width - ST.left - ST.right, height - ST.top - ST.bottom];
  const map = (t, s) => [ST.left + (t / ST_HORIZON) * w, ST.top + ((high - s) / (high - low)) * h];
  return Object.assign(map, { low, high, w, h });
}

function paintStAxes(context, map, height) {
  context.strokeStyle = context.fillStyle = colour("soft");
  context.lineWidth = 1;
  context.textBaseline = "middle";
  const line = (from, to) => {
    context.globalAlpha = 0.14;
    context.beginPath(); context.moveTo(...from); context.lineTo(...to); context.stroke();
    context.globalAlpha = 1;
  };
  context.textAlign = "right";
  const stations = roundSteps(map.low, map.high, map.h / 26);
  for (const s of stations.values) {
    line(map(0, s), map(ST_HORIZON, s));
    context.fillText(fixed(s, stations.decimals), ST.left - 5, map(0, s)[1]);
  }
  context.textAlign = "center";
  const times = roundSteps(0, ST_HORIZON, map.w / 44);
  for (const t of times.values) {
    line(map(t, map.low), map(t, map.high));
    context.fillText(fixed(t, times.decimals), map(t, 0)[0], height - ST.bottom + 9);
  }
  context.fillText("time from now [s]", ST.left + map.w / 2, height - 8);
  context.save();
  context.translate(9, ST.top + map.h / 2);
  context.rotate(-Math.PI / 2);
  context.fillText(map.h > 130 ? "station s [m]" : "s [m]", 0, 0);
  context.restore();
}

/// The corners of what an obstacle occupies, `t, s, …`: lower and upper side when it enters, upper and lower when it leaves.
const cornersOf = ([, [t0, low0, high0, t1, low1, high1]]) => [t0, low0, t0, high0, t1, high1, t1, low1];
const boxInk = (tick, id) => obstacleColour(obstaclesOf(tick).find((obstacle) => obstacle.id === id) ?? { fixed: true });

function paintBox(context, map, tick, box) {
  const ink = boxInk(tick, box[0]);
  const corners = cornersOf(box);
  trace(context, corners, map);
  context.closePath();
  context.fillStyle = colour(`${ink}-fill`);
  context.globalAlpha = 0.75;
  context.fill();
  context.globalAlpha = 1;
  context.strokeStyle = context.fillStyle = colour(ink);
  context.lineWidth = 1.3;
  context.stroke();
  for (let k = 0; k < corners.length; k += 2) {
    context.beginPath();
    context.arc(...map(corners[k], corners[k + 1]), 2.6, 0, 7);
    context.fill();
  }
}

/// Names of the boxes, and when they are entered and left where that is inside the diagram.
function paintBoxNames(context, map, tick) {
  const taken = [];
  for (const box of weighed.bundle.boxes) {
    const [id, [t0, low0, high0, t1, low1, high1]] = box;
    const whole = t0 < 0.05 && t1 > ST_HORIZON - 0.15;
    const text = nameOf(id) + (whole ? "" : ` ${fixed(t0, 1)}…${fixed(t1, 1)} s`);
    const half = context.measureText(text).width / 2;
    const [x, y] = map((t0 + t1) / 2, (low0 + high0 + low1 + high1) / 4);
    const at = [Math.max(ST.left + half + 3, Math.min(ST.left + map.w - half - 3, x)), y];
    if (y < ST.top + 6 || y > ST.top + map.h - 4 || taken.some(([tx, ty, th]) => Math.abs(tx - at[0]) < half + th + 4 && Math.abs(ty - y) < 13)) continue;
    taken.push([...at, half]);
    label(context, text, ...at, { align: "center", base: "middle", ink: boxInk(tick, id) });
  }
}

function paintStopStation(context, map) {
  const { stop } = weighed.bundle;
  if (stop === null || stop > map.high || stop < map.low) return;
  context.strokeStyle = colour("bad");
  context.lineWidth = 1;
  context.setLineDash([4, 3]);
  context.beginPath(); context.moveTo(...map(0, stop)); context.lineTo(...map(ST_HORIZON, stop)); context.stroke();
  context.setLineDash([]);
  label(context, "stop point", map(0, stop)[0] + 5, map(0, stop)[1] - 4, { ink: "bad" });
}

function paintAlong(context, map) {
  for (const curve of inOrder(weighed.longitudinal)) strokeCurve(context, curve.points, map, curve, 1.3);
  const driven = weighed.driven?.along ?? weighed.braking;
  if (driven) strokeStrong(context, driven.points, map, drivenInk(weighed), 3.4);
  const pair = pointedPair();
  const along = pair?.along ?? weighed.longitudinal[pointed.longitudinal ?? held.longitudinal];
  if (along) strokeStrong(context, along.points, map, "text", 2.2, pair && !pair.fault ? [] : [6, 3]);
}

function paintSt(context, width, height) {
  if (!ticks.length || !weigh(ticks[state.k])) {
    context.fillStyle = colour("soft");
    context.textAlign = "center";
    context.textBaseline = "middle";
    context.fillText(unweighedText(), width / 2, height / 2, width - 20);
    return;
  }
  const tick = ticks[state.k];
  const map = stMap(width, height);
  context.save();
  context.beginPath();
  context.rect(ST.left, ST.top, map.w, map.h);
  context.clip();
  context.fillStyle = colour("ground");
  context.fillRect(ST.left, ST.top, map.w, map.h);
  for (const box of weighed.bundle.boxes) paintBox(context, map, tick, box);
  paintAlong(context, map);
  paintStopStation(context, map);
  paintBoxNames(context, map, tick);
  context.restore();
  paintStAxes(context, map, height);
}

function boxText([id, [t0, low0, high0, t1, low1, high1]]) {
  return `${nameOf(id)}\nenters at ${fixed(t0, 1)} s: s ${fixed(low0, 1)}…${fixed(high0, 1)} m\nleaves at ${fixed(t1, 1)} s: s ${fixed(low1, 1)}…${fixed(high1, 1)} m`;
}

function along(x, y) {
  if (!ticks.length || !weigh(ticks[state.k])) return null;
  return curveAt(weighed.longitudinal, stMap(stView.width, stView.height), x, y);
}

pointer(stView, {
  hover(x, y) {
    const curve = along(x, y);
    pointed.longitudinal = curve?.k ?? null;
    if (curve) return curveText(curve, "longitudinal");
    const map = weighed && stMap(stView.width, stView.height);
    const box = weighed?.bundle.boxes.find((one) => within(cornersOf(one), map, x, y));
    return box ? boxText(box) : null;
  },
  click(x, y) { hold("longitudinal", along(x, y)); },
});
stView.canvas.addEventListener("pointerleave", () => { pointed.longitudinal = null; });
