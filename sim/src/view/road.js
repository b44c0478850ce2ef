// The road from above: lanes, marks, the chosen corridor, the path, the ego, obstacles and where they will be.

const METRES_ACROSS = 120; // what the width of the view shows at first
const EGO_FROM_LEFT = 0.16; // where the ego stands in it, as a part of the width
const GHOSTS_EVERY = 1; // seconds between outlines along the plan and the predictions

const camera = { scale: 0, panX: 0, panY: 0, x: 0, y: 0 };
const roadView = canvasView("road", paintRoad);

function roadReset() {
  Object.assign(camera, { scale: 0, panX: 0, panY: 0 });
}

/// The map from metres to pixels in the current tick.
function roadMap(width, height) {
  const tick = ticks[state.k];
  if (!camera.scale) camera.scale = width / METRES_ACROSS;
  if (state.follow || !camera.set) {
    [camera.x, camera.y] = tick.ego;
    camera.set = true;
  }
  const turn = state.turn ? onLine(lineCaches[tick.line], tick.sl[0]).theta : 0;
  const [sin, cos, scale] = [Math.sin(turn), Math.cos(turn), camera.scale];
  const [left, top] = [width * (state.turn ? EGO_FROM_LEFT : 0.5) + camera.panX, height / 2 + camera.panY];
  const map = (x, y) => {
    const [dx, dy] = [x - camera.x, y - camera.y];
    return [left + scale * (cos * dx + sin * dy), top - scale * (cos * dy - sin * dx)];
  };
  map.scale = scale;
  map.turn = turn;
  return map;
}

function paintRoadGround(context, map) {
  const [ox, oy] = map(0, 0);
  const [ax, ay] = map(1, 0);
  const matrix = new DOMMatrix([ax - ox, ay - oy, ay - oy, -(ax - ox), ox, oy]);
  paintGround(context, groundInWorld, matrix, map.scale, Math.max(1.2, 0.14 * map.scale));
}

function paintLine(context, map, line) {
  context.strokeStyle = colour("soft");
  context.globalAlpha = 0.5;
  context.lineWidth = 1;
  context.setLineDash([8, 4, 1, 4]);
  context.beginPath();
  line.x.forEach((x, k) => { const at = map(x, line.y[k]); k ? context.lineTo(...at) : context.moveTo(...at); });
  context.stroke();
  context.setLineDash([]);
  context.globalAlpha = 1;
}

/// An edge of a bound over the ground, at least a point every two metres, so that it bends with the road.
function edgeInWorld(edge, line) {
  const points = [];
  for (let k = 0; k + 1 < edge.at.length; k += 2) {
    const [s, l, s2, l2] = [edge.at[k], edge.at[k + 1], edge.at[k + 2] ?? edge.at[k], edge.at[k + 3] ?? edge.at[k + 1]];
    const steps = Math.max(1, Math.ceil((s2 - s) / 2));
    for (let j = 0; j < steps; j++) points.push(toWorld(line, s + ((s2 - s) * j) / steps, l + ((l2 - l) * j) / steps));
  }
  return points;
}

function paintCorridor(context, map, tick) {
  const candidate = tick.candidates[tick.chosen];
  if (!candidate) return;
  const line = lineCaches[tick.line];
  const [right, left] = [edgeInWorld(candidate.right, line), edgeInWorld(candidate.left, line)];
  const ink = colour(labelColour(run.labels[candidate.label]));
  context.beginPath();
  [...right, ...left.reverse()].forEach((p, k) => (k ? context.lineTo(...map(...p)) : context.moveTo(...map(...p))));
  context.closePath();
  context.fillStyle = ink;
  context.globalAlpha = 0.16;
  context.fill();
  context.globalAlpha = 0.9;
  context.strokeStyle = ink;
  context.lineWidth = 1.5;
  for (const side of [right, left]) {
    context.beginPath();
    side.forEach((p, k) => (k ? context.lineTo(...map(...p)) : context.moveTo(...map(...p))));
    context.stroke();
  }
  context.globalAlpha = 1;
}

/// The lateral curves of the lattice planner over the ground.
function paintSampledWays(context, map, tick) {
  const line = lineCaches[tick.line];
  const onGround = (s, l) => map(...toWorld(line, s, l));
  if (!weigh(tick)) return;
  for (const curve of inOrder(weighed.lateral)) strokeCurve(context, bending(curve.points), onGround, curve, 1.2);
  paintPointedAcross(context, onGround);
}

/// `s, l, …` with a point at least every two metres, so that a straight stretch bends with the road.
function bending(points) {
  const all = points.slice(0, 2);
  for (let k = 2; k < points.length; k += 2) {
    const [s, l, s2, l2] = points.slice(k - 2, k + 2);
    const steps = Math.max(1, Math.ceil((s2 - s) / 2));
    for (let j = 1; j <= steps; j++) all.push(s + ((s2 - s) * j) / steps, l + ((l2 - l) * j) / steps);
  }
  return all;
}

/// A body with its reference point at `x, y`.
function outline(context, map, x, y, theta, front, back, half) {
  const [sin, cos] = [Math.sin(theta), Math.cos(theta)];
  const corner = (f, l) => map(x + f * cos - l * sin, y + f * sin + l * cos);
  context.beginPath();
  [corner(-back, -half), corner(front, -half), corner(front, half), corner(-back, half)]
    .forEach((p, k) => (k ? context.lineTo(...p) : context.moveTo(...p)));
  context.closePath();
}

const egoOutline = (context, map, x, y, theta) =>
  outline(context, map, x, y, theta, run.vehicle.front, run.vehicle.back, run.vehicle.half_width);

function paintPlan(context, map, tick) {
  context.strokeStyle = colour(drivenInk(tick));
  context.lineWidth = 1;
  context.globalAlpha = 0.45;
  let next = GHOSTS_EVERY, lastX = Infinity, lastY = Infinity;
  for (let k = 0; k + 4 < tick.plan.length; k += 5) {
    const [t, x, y, theta] = tick.plan.slice(k, k + 4);
    if (t < next - 1e-6 || Math.hypot(x - lastX, y - lastY) < 0.3) continue;
    next = t + GHOSTS_EVERY;
    [lastX, lastY] = [x, y];
    egoOutline(context, map, x, y, theta);
    context.stroke();
  }
  context.globalAlpha = 1;
  context.lineWidth = 2.2;
  trace(context, tick.path, map, 4, 2);
  context.stroke();
}

/// Where the front bumper comes to rest.
function paintStopBar(context, map, tick) {
  if (!tick.stop_at) return;
  const [, , , x, y, theta] = tick.stop_at;
  const { front, half_width: half } = run.vehicle;
  const [sin, cos] = [Math.sin(theta), Math.cos(theta)];
  context.strokeStyle = colour("bad");
  context.lineWidth = 3;
  context.beginPath();
  for (const l of [half + 0.3, -half - 0.3]) context.lineTo(...map(x + front * cos - l * sin, y + front * sin + l * cos));
  context.stroke();
}

/// The ego at the end of the last tick: there it met what it hit.
function paintFinish(context, map) {
  if (!run.end) return;
  context.strokeStyle = colour("ego");
  context.lineWidth = 1.2;
  context.setLineDash([3, 2]);
  egoOutline(context, map, ...run.end);
  context.stroke();
  context.setLineDash([]);
}

function paintEgo(context, map, tick) {
  const [x, y, theta, steer] = tick.ego;
  egoOutline(context, map, x, y, theta);
  context.fillStyle = colour("ego-fill");
  context.fill();
  context.strokeStyle = colour("ego");
  context.lineWidth = 2;
  context.stroke();
  const [sin, cos] = [Math.sin(theta), Math.cos(theta)];
  const at = (f, l) => map(x + f * cos - l * sin, y + f * sin + l * cos);
  const half = run.vehicle.half_width;
  context.beginPath();
  context.moveTo(...at(run.vehicle.front - 1.9, half * 0.7));
  context.lineTo(...at(run.vehicle.front - 1.2, 0));
  context.lineTo(...at(run.vehicle.front - 1.9, -half * 0.7));
  context.stroke();
  if (map.scale > 14) paintWheels(context, at, steer);
  context.beginPath();
  context.arc(...map(x, y), 2.5, 0, 7);
  context.fillStyle = colour("ego");
  context.fill();
}

function paintWheels(context, at, steer) {
  const track = run.vehicle.half_width - 0.2;
  context.lineWidth = 3;
  for (const [f, l, angle] of [[0, track, 0], [0, -track, 0], [run.vehicle.wheel_base, track, steer], [run.vehicle.wheel_base, -track, steer]]) {
    const [dx, dy] = [0.33 * Math.cos(angle), 0.33 * Math.sin(angle)];
    context.beginPath();
    context.moveTo(...at(f - dx, l - dy));
    context.lineTo(...at(f + dx, l + dy));
    context.stroke();
  }
}

function paintPrediction(context, map, obstacle) {
  const path = obstacle.prediction;
  if (!path.length) return;
  const ink = colour(obstacleColour(obstacle));
  context.strokeStyle = ink;
  context.fillStyle = ink;
  context.globalAlpha = 0.6;
  context.lineWidth = 1.3;
  context.setLineDash([2, 3]);
  context.beginPath();
  for (let k = 0; k < path.length; k += 6) {
    const at = map(path[k + 1], path[k + 2]);
    k ? context.lineTo(...at) : context.moveTo(...at);
  }
  context.stroke();
  context.setLineDash([]);
  for (let k = 0, next = GHOSTS_EVERY; k < path.length; k += 6) {
    if (path[k] < next - 1e-6) continue;
    next = path[k] + GHOSTS_EVERY;
    const [x, y] = map(path[k + 1], path[k + 2]);
    context.beginPath();
    context.arc(x, y, 2, 0, 7);
    context.fill();
  }
  context.globalAlpha = 1;
}

/// The footprint; with a red rim once the ego has hit it.
function paintBody(context, map, obstacle, numbers) {
  const ink = obstacleColour(obstacle);
  trace(context, numbers, map);
  context.closePath();
  context.fillStyle = colour(`${ink}-fill`);
  context.fill();
  const hit = isHit(obstacle);
  context.strokeStyle = colour(hit ? "bad" : ink);
  context.lineWidth = hit ? 3 : 1.3;
  context.stroke();
}

function paintObstacle(context, map, obstacle) {
  paintBody(context, map, obstacle, obstacle.xy);
  context.strokeStyle = colour(obstacleColour(obstacle));
  context.lineWidth = 1.3;
  const [vx, vy] = obstacle.speed;
  if (Math.hypot(vx, vy) > 0.1) {
    // One second of driving.
    arrow(context, map(obstacle.at[0], obstacle.at[1]), map(obstacle.at[0] + vx, obstacle.at[1] + vy));
  }
}

function arrow(context, from, to) {
  const angle = Math.atan2(to[1] - from[1], to[0] - from[0]);
  const head = (turn) => [to[0] - 6 * Math.cos(angle + turn), to[1] - 6 * Math.sin(angle + turn)];
  context.beginPath();
  context.moveTo(...from);
  context.lineTo(...to);
  context.moveTo(...head(0.45));
  context.lineTo(...to);
  context.lineTo(...head(-0.45));
  context.stroke();
}

/// Names, nearest first, as many as fit without covering each other.
function paintNames(context, map, tick, width, height) {
  const taken = [];
  const distance = (o) => Math.hypot(o.at[0] - tick.ego[0], o.at[1] - tick.ego[1]) - (o.fixed ? 0 : 1000);
  for (const obstacle of obstaclesOf(tick).sort((a, b) => distance(a) - distance(b))) {
    const corners = [];
    for (let k = 0; k < obstacle.xy.length; k += 2) corners.push(map(obstacle.xy[k], obstacle.xy[k + 1]));
    const x = corners.reduce((sum, c) => sum + c[0], 0) / corners.length;
    const y = Math.min(...corners.map((c) => c[1])) - 4;
    if (x < 0 || x > width || y < 8 || y > height + 20) continue;
    const name = nameOf(obstacle.id);
    const half = context.measureText(name).width / 2 + 4;
    const box = [x - half, y - 13, x + half, y + 4];
    if (taken.some((t) => box[0] < t[2] && box[2] > t[0] && box[1] < t[3] && box[3] > t[1])) continue;
    taken.push(box);
    label(context, name, x, y, { align: "center", ink: obstacleColour(obstacle) });
  }
}

/// The place to pull over, as a body that stands there, and the destination of the command; `map` from above.
function paintTarget(context, map, tick) {
  if (tick.destination) paintPin(context, map(...tick.destination));
  if (!tick.pull_over) return;
  targetStroke(context);
  egoOutline(context, map, ...tick.pull_over);
  context.stroke();
  paintCross(context, map(tick.pull_over[0], tick.pull_over[1]));
}

function targetStroke(context) {
  context.strokeStyle = colour("c-pullover");
  context.lineWidth = 1.8;
  context.setLineDash([5, 3]);
}

function paintCross(context, [x, y]) {
  context.setLineDash([]);
  context.beginPath();
  context.moveTo(x - 6, y); context.lineTo(x + 6, y); context.moveTo(x, y - 6); context.lineTo(x, y + 6);
  context.stroke();
}

function paintPin(context, [x, y]) {
  context.fillStyle = colour("c-pullover");
  context.beginPath();
  context.moveTo(x, y); context.lineTo(x - 5, y - 12); context.arc(x, y - 13, 5, Math.PI * 0.9, Math.PI * 2.1); context.lineTo(x, y);
  context.fill();
  label(context, "destination", x + 8, y - 10, { ink: "c-pullover" });
}

/// Where the ego has been and will be in this run.
function paintTrail(context, map) {
  context.strokeStyle = colour("ego");
  context.lineWidth = 1.2;
  context.globalAlpha = 0.35;
  context.beginPath();
  ticks.slice(0, state.k + 1).forEach((tick, k) => {
    const at = map(tick.ego[0], tick.ego[1]);
    k ? context.lineTo(...at) : context.moveTo(...at);
  });
  context.stroke();
  context.globalAlpha = 1;
}

function paintScaleBar(context, map, width, height) {
  const length = [1, 2, 5, 10, 20, 50, 100, 200, 500].find((metres) => metres * map.scale > 60) ?? 1000;
  const [right, y] = [width - 14, height - 12];
  context.strokeStyle = colour("text");
  context.lineWidth = 1.5;
  context.beginPath();
  context.moveTo(right - length * map.scale, y - 4);
  context.lineTo(right - length * map.scale, y);
  context.lineTo(right, y);
  context.lineTo(right, y - 4);
  context.stroke();
  label(context, `${length} m`, right - (length * map.scale) / 2, y - 4, { align: "center", rim: "ground" });
  if (!state.turn) return;
  const [cx, cy] = [width - 26, 30];
  context.lineWidth = 1.3;
  context.strokeStyle = colour("text");
  arrow(context, [cx + 10 * Math.sin(-map.turn), cy + 10 * Math.cos(-map.turn)], [cx - 10 * Math.sin(-map.turn), cy - 10 * Math.cos(-map.turn)]);
  label(context, "N", cx - 18 * Math.sin(-map.turn), cy - 18 * Math.cos(-map.turn), { align: "center", base: "middle", rim: "ground" });
}

function paintRoad(context, width, height) {
  context.fillStyle = colour("ground");
  context.fillRect(0, 0, width, height);
  if (!ticks.length) return;
  const tick = ticks[state.k];
  const map = roadMap(width, height);
  paintRoadGround(context, map);
  paintLine(context, map, lineCaches[tick.line]);
  paintCorridor(context, map, tick);
  paintSampledWays(context, map, tick);
  paintTrail(context, map);
  paintTarget(context, map, tick);
  const obstacles = obstaclesOf(tick);
  if (state.predictions) for (const obstacle of obstacles) paintPrediction(context, map, obstacle);
  for (const obstacle of obstacles) paintObstacle(context, map, obstacle);
  paintPlan(context, map, tick);
  paintStopBar(context, map, tick);
  paintEgo(context, map, tick);
  if (state.k === ticks.length - 1) paintFinish(context, map);
  paintNames(context, map, tick, width, height);
  paintScaleBar(context, map, width, height);
}

/// Whether a point lies in the polygon `x, y, …` after `map`.
function within(numbers, map, x, y) {
  let inside = false;
  for (let k = 0, j = numbers.length - 2; k < numbers.length; j = k, k += 2) {
    const [ax, ay] = map(numbers[k], numbers[k + 1]);
    const [bx, by] = map(numbers[j], numbers[j + 1]);
    if (ay > y !== by > y && x < ((bx - ax) * (y - ay)) / (by - ay) + ax) inside = !inside;
  }
  return inside;
}

function obstacleText(obstacle, tick) {
  const speed = Math.hypot(...obstacle.speed);
  const s = obstacle.sl.filter((_, k) => k % 2 === 0);
  const l = obstacle.sl.filter((_, k) => k % 2 === 1);
  return [
    `${nameOf(obstacle.id)} (${obstacle.kind}${obstacle.fixed ? ", standing" : ""})`,
    `s ${fixed(Math.min(...s), 1)}…${fixed(Math.max(...s), 1)} m, l ${signed(Math.min(...l))} to ${signed(Math.max(...l))} m`,
    `${fixed(Math.min(...s) - tick.sl[0] - run.vehicle.front, 1)} m ahead of the bumper along the line`,
    obstacle.fixed ? "" : `${fixed(speed, 1)} m/s (${fixed(speed * 3.6, 0)} km/h)`,
  ].filter(Boolean).join("\n");
}

pointer(roadView, {
  drag(dx, dy) { camera.panX += dx; camera.panY += dy; },
  wheel(factor, x, y) {
    if (!ticks.length) return;
    const { width, height } = roadView;
    roadMap(width, height); // after a reset the scale is not known yet
    const scale = Math.max(0.3, Math.min(400, camera.scale * factor));
    const [left, top] = [width * (state.turn ? EGO_FROM_LEFT : 0.5) + camera.panX, height / 2 + camera.panY];
    const grown = scale / camera.scale - 1;
    camera.panX -= (x - left) * grown;
    camera.panY -= (y - top) * grown;
    camera.scale = scale;
  },
  hover(x, y) {
    if (!ticks.length) return null;
    const tick = ticks[state.k];
    const map = roadMap(roadView.width, roadView.height);
    const found = obstaclesOf(tick).find((obstacle) => within(obstacle.xy, map, x, y));
    return found ? obstacleText(found, tick) : null;
  },
  reset: roadReset,
});
