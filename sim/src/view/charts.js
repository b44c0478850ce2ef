// Quantities over time, one under the other over one axis, with their limits; a click jumps.

const CHART = { left: 44, right: 94, top: 24, bottom: 26, gap: 6 };

const series = run.series;
const rows = [
  {
    name: "speed", unit: "m/s", values: series.speed, floor: 0,
    more: [{ values: series.cruise_speed, ink: "soft", dash: [5, 3], name: "cruise" }, { values: series.speed_limit, ink: "surface-edge", dash: [1, 2], name: "limit" }],
    plan: true, note: (v) => `${fixed(v * 3.6, 0)} km/h`,
  },
  { name: "acceleration", unit: "m/s²", values: series.acceleration, limits: series.limits.acceleration },
  { name: "jerk", unit: "m/s³", values: series.jerk, limits: series.limits.jerk },
  {
    name: "clearance", unit: "m", values: series.clearance, floor: 0, ceiling: series.limits.clearance_horizon, limits: [series.limits.clearance],
    below: true, absent: () => (ticks[state.k].obstacles.length ? `> ${series.limits.clearance_horizon} m` : "nothing near"), note: (_, k) => (series.nearest[k] === null ? "" : nameOf(series.nearest[k])),
  },
  { name: "tracking error", unit: "m", values: series.tracking, limits: [-series.limits.tracking, series.limits.tracking] },
];

const span = { from: 0, to: 1 };
const chartView = canvasView("charts", paintCharts);

function chartReset() {
  if (!ticks.length) return;
  span.from = timeOf(0);
  span.to = Math.max(timeOf(ticks.length - 1), span.from + run.tick);
}
chartReset();

/// Smallest and largest value to show: the data and the limits, with some room.
function extent(row) {
  const all = [row.values, ...(row.more ?? []).map((m) => m.values)].flat().filter((v) => v !== null && Number.isFinite(v));
  let [low, high] = [row.floor ?? Infinity, -Infinity];
  for (const value of [...all, ...(row.limits ?? [])]) {
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  if (!(high > low)) [low, high] = [Math.min(low, 0), Math.max(low, 0) + 1];
  if (row.ceiling) high = all.length ? Math.min(high, row.ceiling) : row.ceiling;
  const room = (high - low) * 0.08;
  return [row.floor === undefined ? low - room : low, high + room];
}
for (const row of rows) row.extent = extent(row);

const chartX = (width) => (t) => CHART.left + ((t - span.from) / (span.to - span.from)) * (width - CHART.left - CHART.right);

/// Stretches of ticks with the same colour; ticks without one are left out.
function runsOf(inkOf) {
  const runs = [];
  for (const tick of ticks) {
    const ink = inkOf(tick);
    const last = runs[runs.length - 1];
    if (last && last.ink === ink && tick.t - last.to < run.tick / 2) last.to = tick.t + run.tick;
    else if (ink) runs.push({ from: tick.t, to: tick.t + run.tick, ink });
  }
  return runs;
}

const chosenRuns = runsOf((tick) => {
  const chosen = tick.candidates[tick.chosen];
  return chosen ? labelColour(run.labels[chosen.label]) : "line";
});
const abnormalRuns = runsOf((tick) => (tick.normal ? null : "bad"));

/// Which bound was driven when, as a band of its colours; underlined where the decider fell back.
function paintLabelBand(context, x, width) {
  const [top, height] = [6, 8];
  const bar = (from, to, ink, y, tall) => {
    const [left, right] = [Math.max(x(from), CHART.left), Math.min(x(to), width - CHART.right)];
    if (right <= left) return;
    context.fillStyle = colour(ink);
    context.fillRect(left, y, right - left, tall);
  };
  for (const { from, to, ink } of chosenRuns) bar(from, to, ink, top, height);
  for (const { from, to, ink } of abnormalRuns) bar(from, to, ink, top + height + 1, 4);
  context.fillStyle = colour("soft");
  context.textAlign = "left";
  context.textBaseline = "middle";
  context.fillText(run.lattice ? "fallback" : "chosen bound", width - CHART.right + 8, top + height / 2);
}

function paintLimits(context, row, y, left, right) {
  context.strokeStyle = colour("bad");
  context.lineWidth = 1;
  context.globalAlpha = 0.7;
  context.setLineDash([6, 4]);
  for (const limit of row.limits ?? []) {
    context.beginPath(); context.moveTo(left, y(limit)); context.lineTo(right, y(limit)); context.stroke();
  }
  context.setLineDash([]);
  context.globalAlpha = 1;
}

function paintCurve(context, x, y, values, ink, width, dash = []) {
  context.beginPath();
  let down = false;
  values.forEach((value, k) => {
    if (value === null || !Number.isFinite(value)) { down = false; return; }
    const at = [x(timeOf(k)), y(value)];
    down ? context.lineTo(...at) : context.moveTo(...at);
    down = true;
  });
  context.strokeStyle = colour(ink);
  context.lineWidth = width;
  context.setLineDash(dash);
  context.stroke();
  context.setLineDash([]);
}

/// What the current tick plans to drive.
function paintPlannedSpeed(context, x, y) {
  const { plan, t } = ticks[state.k];
  context.beginPath();
  for (let k = 0; k + 4 < plan.length; k += 5) context.lineTo(x(t + plan[k]), y(plan[k + 4]));
  context.strokeStyle = colour("path");
  context.lineWidth = 1.6;
  context.setLineDash([3, 2]);
  context.stroke();
  context.setLineDash([]);
}

const violates = (row, value) => value !== null && row.limits &&
  (row.below ? value < row.limits[0] : value < row.limits[0] || value > row.limits[1]);

/// The numbers of a scale from zero outwards, as many as have room; half a line is left to the next row.
function paintNumbers(context, { values, decimals }, y, right, top, bottom) {
  context.textAlign = "right";
  context.textBaseline = "middle";
  const taken = [];
  for (const value of [...values].sort((a, b) => Math.abs(a) - Math.abs(b))) {
    const at = y(value);
    if (at < top + 4 || at > bottom + 1 || taken.some((other) => Math.abs(other - at) < 11)) continue;
    taken.push(at);
    context.fillText(fixed(value, decimals), right, at);
  }
}

function paintRow(context, row, x, top, height, width) {
  const [left, right] = [CHART.left, width - CHART.right];
  const [low, high] = row.extent;
  const y = (value) => top + ((high - value) / (high - low)) * height;
  const steps = roundSteps(low, high, Math.max(3, height / 13));
  context.fillStyle = colour("ground");
  context.fillRect(left, top, right - left, height);
  context.fillStyle = colour("soft");
  context.strokeStyle = colour("soft");
  context.lineWidth = 1;
  for (const value of steps.values) {
    context.globalAlpha = Math.abs(value) < 1e-9 ? 0.5 : 0.14;
    context.beginPath(); context.moveTo(left, y(value)); context.lineTo(right, y(value)); context.stroke();
  }
  context.globalAlpha = 1;
  paintNumbers(context, steps, y, left - 5, top, top + height);
  context.save();
  context.beginPath();
  context.rect(left, top, right - left, height);
  context.clip();
  paintLimits(context, row, y, left, right);
  for (const other of row.more ?? []) paintCurve(context, x, y, other.values, other.ink, 1.2, other.dash);
  if (row.plan) paintPlannedSpeed(context, x, y);
  paintCurve(context, x, y, row.values, "accent", 1.7);
  context.restore();
  paintReadout(context, row, x, y, top, height, right);
}

/// Name, value and what belongs to it, beside the row; a dot on the curve.
function paintReadout(context, row, x, y, top, height, right) {
  const value = row.values[state.k];
  const bad = violates(row, value);
  context.textAlign = "left";
  context.textBaseline = "top";
  context.fillStyle = colour("soft");
  context.fillText(row.name, right + 8, top);
  context.fillStyle = colour(bad ? "bad" : "text");
  context.font = `600 ${FONT}`;
  context.fillText(value === null ? row.absent?.() ?? "none" : `${fixed(value)} ${row.unit}`, right + 8, top + 13);
  context.font = FONT;
  const note = row.note?.(value, state.k);
  if (note && value !== null && height >= 38) {
    context.fillStyle = colour("soft");
    context.fillText(note, right + 8, top + 26, CHART.right - 10);
  }
  const at = x(timeOf(state.k));
  if (value === null || at < CHART.left || at > right) return;
  context.beginPath();
  context.arc(at, Math.max(top + 1, y(value)), 3, 0, 7);
  context.fillStyle = colour(bad ? "bad" : "accent");
  context.fill();
}

function paintTimeAxis(context, x, width, height) {
  const steps = roundSteps(span.from, span.to, (width - CHART.left - CHART.right) / 80);
  context.textAlign = "center";
  context.textBaseline = "middle";
  for (const t of steps.values) {
    context.strokeStyle = colour("soft");
    context.globalAlpha = 0.14;
    context.lineWidth = 1;
    context.beginPath(); context.moveTo(x(t), CHART.top); context.lineTo(x(t), height - CHART.bottom); context.stroke();
    context.globalAlpha = 1;
    context.fillStyle = colour("soft");
    context.fillText(fixed(t, steps.decimals), x(t), height - CHART.bottom + 9);
  }
  context.textAlign = "left";
  context.fillText("time [s]", width - CHART.right + 16, height - CHART.bottom + 9);
}

function paintCursor(context, at, height, ink, width) {
  context.strokeStyle = colour(ink);
  context.lineWidth = width;
  context.beginPath(); context.moveTo(at, 4); context.lineTo(at, height - CHART.bottom); context.stroke();
}

function paintCharts(context, width, height) {
  if (!ticks.length) return;
  const x = chartX(width);
  const tall = (height - CHART.top - CHART.bottom - CHART.gap * (rows.length - 1)) / rows.length;
  paintLabelBand(context, x, width);
  rows.forEach((row, k) => paintRow(context, row, x, CHART.top + k * (tall + CHART.gap), tall, width));
  paintTimeAxis(context, x, width, height);
  for (const event of run.events) {
    const at = x(event.t);
    if (at < CHART.left || at > width - CHART.right) continue;
    context.fillStyle = colour(isBad(event) ? "bad" : "warn");
    context.beginPath();
    context.moveTo(at, height - CHART.bottom - 5); context.lineTo(at - 4, height - CHART.bottom + 2); context.lineTo(at + 4, height - CHART.bottom + 2);
    context.fill();
  }
  const now = x(timeOf(state.k));
  if (now >= CHART.left && now <= width - CHART.right) paintCursor(context, now, height, "text", 1.2);
}

const isBad = (event) => ["collision", "off road", "fallback"].includes(event.kind);

function seekChart(px) {
  const { width } = chartView;
  const t = span.from + ((px - CHART.left) / (width - CHART.left - CHART.right)) * (span.to - span.from);
  if (ticks.length) seek(tickAt(t + run.tick / 2));
}

pointer(chartView, {
  click: seekChart,
  drag(_dx, _dy, at) { seekChart(at[0]); },
  hover(px) {
    const near = run.events.filter((event) => Math.abs(chartX(chartView.width)(event.t) - px) < 4);
    return near.map((event) => `${fixed(event.t, 1)} s  ${event.kind}: ${event.text}`).join("\n") || null;
  },
  wheel(factor, px) {
    if (!ticks.length) return;
    const { width } = chartView;
    const t = span.from + ((px - CHART.left) / (width - CHART.left - CHART.right)) * (span.to - span.from);
    const [first, last] = [timeOf(0), timeOf(ticks.length - 1)];
    span.from = Math.max(first, t + (span.from - t) / factor);
    span.to = Math.max(span.from + 2 * run.tick, Math.min(Math.max(last, first + run.tick), t + (span.to - t) / factor));
  },
  reset: chartReset,
});
