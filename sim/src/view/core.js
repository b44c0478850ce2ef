// The run, the state of the page, and the few helpers that everything shares.

const byId = (id) => document.getElementById(id);

window.onerror = (message, source, line, column) => {
  const box = byId("error");
  box.hidden = false;
  box.textContent += `This page has a fault: ${message} (line ${line}, column ${column})\n`;
};

const run = JSON.parse(byId("data").textContent);
const ticks = run.ticks;

// What is looked at. Change it through `seek` and `redraw` only.
const state = {
  k: 0, // place of the tick
  playing: false,
  hidden: new Set(), // labels that are switched off
  byCause: false,
  turn: true,
  follow: true,
  predictions: true,
  rejected: true, // whether curves that may not be driven are shown
};

const views = []; // {draw()} of each canvas
const followers = []; // called after the tick has changed

let scheduled = false;

function redraw() {
  if (scheduled) return;
  scheduled = true;
  requestAnimationFrame(() => {
    scheduled = false;
    for (const view of views) view.draw();
  });
}

function seek(k) {
  state.k = Math.max(0, Math.min(ticks.length - 1, Math.round(k)));
  for (const follower of followers) follower();
  redraw();
}

const timeOf = (k) => ticks[k].t;

/// Place of the last tick at or before a time.
function tickAt(t) {
  let low = 0, high = ticks.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (ticks[middle].t <= t + 1e-6) low = middle; else high = middle - 1;
  }
  return low;
}

const obstaclesOf = (tick) => tick.obstacles.map((place) => run.obstacles[place]);
/// Whether the ego has hit it by the end of the current tick.
const isHit = (obstacle) => (run.verdict?.collisions ?? []).some((hit) =>
  hit.obstacle === nameOf(obstacle.id) && hit.time <= ticks[state.k].t + run.tick + 1e-6);
const nameOf = (id) => run.names[id] ?? `#${id}`;
const words = (text) => text.replaceAll("_", " ");

// Numbers with a real minus sign and a fixed number of decimals.
function fixed(value, decimals = 2) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const text = value.toFixed(decimals);
  return (Number(text) === 0 ? text.replace("-", "") : text).replace("-", "−");
}
const signed = (value, decimals = 2) => (value > 0 && Number(value.toFixed(decimals)) > 0 ? "+" : "") + fixed(value, decimals);

/// An element with attributes and children; text is never read as HTML.
function element(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name === "on") for (const [event, action] of Object.entries(value)) node.addEventListener(event, action);
    else if (name === "style") node.style.cssText = value;
    else if (value !== null && value !== undefined && value !== false) node.setAttribute(name, value);
  }
  node.append(...children.filter((child) => child !== null && child !== undefined));
  return node;
}

// Colours come from the style sheet, so that both themes are in one place.
let palette = {};

function colour(name) {
  palette[name] ??= getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim() || "#888";
  return palette[name];
}

function setTheme(theme) {
  document.documentElement.dataset.theme = theme;
  palette = {};
  for (const follower of followers) if (ticks.length) follower();
  redraw();
}

/// The colour of a candidate: by what it may use, the same in every tick.
function labelColour(label) {
  if (label === "fallback") return "c-fallback";
  if (label === "regular/pullover") return "c-pullover";
  if (label === "regular/lanechange") return "c-lanechange";
  if (label.startsWith("regular/left")) return "c-left";
  if (label.startsWith("regular/right")) return "c-right";
  return "c-self";
}

/// Borrowing a lane with oncoming traffic is dashed, so that it differs from borrowing one without.
const labelDash = (label) => (label.endsWith("/reverse") ? [9, 4] : []);

const obstacleColour = (obstacle) =>
  obstacle.kind === "pedestrian" || obstacle.kind === "bicycle" ? "vulnerable" : obstacle.fixed ? "obstacle" : "moving";

// Stations of the shared lines are sorted: everything between them is linear.
const lineCaches = run.lines.map((line) => ({ ...line, last: line.s.length - 1 }));

function onLine(line, s) {
  let low = 0, high = line.last;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (line.s[middle] <= s) low = middle; else high = middle;
  }
  const t = (s - line.s[low]) / (line.s[high] - line.s[low]);
  const turn = Math.atan2(Math.sin(line.theta[high] - line.theta[low]), Math.cos(line.theta[high] - line.theta[low]));
  const inside = Math.max(0, Math.min(1, t));
  return {
    x: line.x[low] + (line.x[high] - line.x[low]) * t,
    y: line.y[low] + (line.y[high] - line.y[low]) * t,
    theta: line.theta[low] + turn * inside,
  };
}

/// World position of a place beside a line.
function toWorld(line, s, l) {
  const at = onLine(line, s);
  return [at.x - l * Math.sin(at.theta), at.y + l * Math.cos(at.theta)];
}
