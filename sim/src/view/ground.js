// The ground of both pictures: lanes in the colours of what they are for, and the lines painted on them; from above
// as they lie, beside a reference line as that line sees them.

const LANE_COLOURS = {
  driving: "driving", ramp: "ramp", stop: "stopping", shoulder: "stopping", parking: "stopping",
  sidewalk: "sidewalk", biking: "biking", median: "median", restricted: "restricted",
};

const MARKS = {
  DOTTED_YELLOW: ["yellow-mark", [3, 3]], DOTTED_WHITE: ["white-mark", [3, 3]], SOLID_YELLOW: ["yellow-mark", []],
  SOLID_WHITE: ["white-mark", []], DOUBLE_YELLOW: ["yellow-mark", []], CURB: ["curb", []],
};

// Roads that carry wheels lie on top of what does not.
const laneRank = (lane) => (["driving", "ramp"].includes(lane.kind) ? 2 : LANE_COLOURS[lane.kind] ? 1 : 0);
const lanesBelowFirst = [...run.lanes].sort((a, b) => laneRank(a) - laneRank(b));

/// Draws a path of `x, y, …` into a Path2D.
function pathOf(numbers) {
  const path = new Path2D();
  for (let k = 0; k + 1 < numbers.length; k += 2) k ? path.lineTo(numbers[k], numbers[k + 1]) : path.moveTo(numbers[k], numbers[k + 1]);
  return path;
}

function pairs(numbers) {
  const all = [];
  for (let k = 0; k + 1 < numbers.length; k += 2) all.push([numbers[k], numbers[k + 1]]);
  return all;
}

/// The outline between two edges.
function between(left, right) {
  const path = new Path2D();
  [...left, ...[...right].reverse()].forEach(([x, y], k) => (k ? path.lineTo(x, y) : path.moveTo(x, y)));
  path.closePath();
  return path;
}

/// {lanes: [{kind, body, edges}], marks: [{kind, path}]} from above.
const groundInWorld = {
  lanes: lanesBelowFirst.map((lane) => {
    const edges = pathOf(lane.left);
    edges.addPath(pathOf(lane.right));
    return { lane, body: between(pairs(lane.left), pairs(lane.right)), edges };
  }),
  marks: run.marks.map((mark) => ({ kind: mark.kind, path: pathOf(mark.at) })),
};

/// Station and offset of a point beside the part of a line between two of its samples; beyond its ends the line goes on
/// straight.
function toLine(line, x, y, first = 0, last = line.last) {
  const square = (k) => (line.x[k] - x) ** 2 + (line.y[k] - y) ** 2;
  let near = first;
  for (let k = first + 1, best = square(first); k <= last; k++) {
    const here = square(k);
    if (here < best) [near, best] = [k, here];
  }
  const on = (k) => {
    const [dx, dy] = [line.x[k + 1] - line.x[k], line.y[k + 1] - line.y[k]];
    const length = Math.hypot(dx, dy) || 1;
    const [px, py] = [x - line.x[k], y - line.y[k]];
    return { t: (px * dx + py * dy) / (length * length), l: (dx * py - dy * px) / length, k };
  };
  let foot = on(Math.max(first, Math.min(near, last - 1)));
  if (foot.t < 0 && near > first) foot = on(near - 1);
  const inside = Math.max(foot.k === first ? -Infinity : 0, Math.min(foot.k === last - 1 ? Infinity : 1, foot.t));
  return [line.s[foot.k] + inside * (line.s[foot.k + 1] - line.s[foot.k]), foot.l];
}

/// Place of the last sample at or before a station.
function sampleAt(line, s) {
  let low = 0, high = line.last;
  while (high > low) {
    const middle = (low + high + 1) >> 1;
    if (line.s[middle] <= s) low = middle; else high = middle - 1;
  }
  return low;
}

/// As `toLine`, near a station only: a route may cross itself.
const toLineNear = (line, s, x, y) => toLine(line, x, y, sampleAt(line, s - 60), Math.max(1, Math.min(line.last, sampleAt(line, s + 200) + 1)));

const SECTION = 2; // metres between projected points, so that a straight lane bends where the line does
const BESIDE = 25; // metres beside the line that are drawn
const BEYOND = 40; // metres beyond the ends of a part of the line
const PART = 60; // metres of a line that the ground is projected onto at once: too short to come back to itself

/// Whether two projected points, at most SECTION apart on the ground, are neighbours as the line sees them too: not
/// across the centre of a bend or on another arm of a junction.
const isTorn = ([s0, l0], [s1, l1]) => Math.abs(s1 - s0) > 4 * SECTION || Math.abs(l1 - l0) > 4 * SECTION;
const isOff = (part, [s, l]) => Math.abs(l) > BESIDE || s < part.from - BEYOND || s > part.to + BEYOND;

/// Points along `points` at most SECTION apart, with as many per stretch as `counts` says.
function dense(points, counts) {
  const all = [points[0]];
  for (let k = 1; k < points.length; k++) {
    const [a, b] = [points[k - 1], points[k]];
    for (let j = 1; j <= counts[k - 1]; j++) all.push([a[0] + ((b[0] - a[0]) * j) / counts[k - 1], a[1] + ((b[1] - a[1]) * j) / counts[k - 1]]);
  }
  return all;
}

function countsOf(...edges) {
  return edges[0].slice(1).map((_, k) => Math.max(1, ...edges.map((edge) =>
    Math.ceil(Math.hypot(edge[k + 1][0] - edge[k][0], edge[k + 1][1] - edge[k][1]) / SECTION))));
}

/// A lane as a part of a line sees it.
function laneOnLine(part, lane) {
  const world = [pairs(lane.left), pairs(lane.right)];
  if (world[0].length < 2 || world[0].length !== world[1].length || !world.some((edge) => part.isNear(edge))) return null;
  const counts = countsOf(...world);
  const [left, right] = world.map((edge) => dense(edge, counts).map(part.project));
  const [body, edges] = [new Path2D(), new Path2D()];
  let from = 0;
  const close = (to) => {
    if (to - from >= 2) {
      const strip = [left.slice(from, to), right.slice(from, to)];
      body.addPath(between(...strip));
      for (const edge of strip) edges.addPath(pathOf(edge.flat()));
    }
    from = to;
  };
  left.forEach((point, k) => {
    if (k && (isTorn(left[k - 1], point) || isTorn(right[k - 1], right[k]))) close(k);
    if (isOff(part, point) && isOff(part, right[k])) { close(k); from = k + 1; }
  });
  close(left.length);
  return { lane, body, edges };
}

function markOnLine(part, mark) {
  const world = pairs(mark.at);
  if (world.length < 2 || !part.isNear(world)) return null;
  const points = dense(world, countsOf(world)).map(part.project);
  const path = new Path2D();
  let down = false;
  points.forEach((point, k) => {
    if (isOff(part, point)) { down = false; return; }
    if (down && !isTorn(points[k - 1], point)) path.lineTo(...point); else path.moveTo(...point);
    down = true;
  });
  return { kind: mark.kind, path };
}

/// The stretch of a line from sample `first` to `last`.
function partOf(line, first, last) {
  const [xs, ys] = [line.x.slice(first, last + 1), line.y.slice(first, last + 1)];
  const reach = BESIDE + BEYOND;
  const box = [Math.min(...xs) - reach, Math.min(...ys) - reach, Math.max(...xs) + reach, Math.max(...ys) + reach];
  return {
    from: line.s[first], to: line.s[last],
    project: ([x, y]) => toLine(line, x, y, first, last),
    isNear(points) {
      const [px, py] = [points.map((p) => p[0]), points.map((p) => p[1])];
      return Math.min(...px) < box[2] && Math.max(...px) > box[0] && Math.min(...py) < box[3] && Math.max(...py) > box[1];
    },
  };
}

/// The ground as a line sees it between two stations, in parts that are made when they are first needed:
/// [{from, to, lanes, marks}].
function groundOnLine(line, from, to) {
  line.parts ??= new Map();
  const parts = [];
  for (let first = Math.floor(Math.max(from, 0) / PART); first * PART < Math.min(to, line.s[line.last]); first++) {
    if (!line.parts.has(first)) {
      const low = sampleAt(line, first * PART);
      const part = partOf(line, low, Math.max(low + 1, Math.min(line.last, sampleAt(line, (first + 1) * PART) + 1)));
      line.parts.set(first, {
        // The ends of the line go on.
        from: first ? first * PART : -Infinity, to: (first + 1) * PART < line.s[line.last] ? (first + 1) * PART : Infinity,
        lanes: lanesBelowFirst.map((lane) => laneOnLine(part, lane)).filter((lane) => lane),
        marks: run.marks.map((mark) => markOnLine(part, mark)).filter((mark) => mark),
      });
    }
    parts.push(line.parts.get(first));
  }
  return parts;
}

/// Paints a ground through a matrix; `metre` is the length of a metre along the road in pixels, `width` of a line's.
function paintGround(context, ground, matrix, metre, width) {
  const placed = (path) => {
    const moved = new Path2D();
    moved.addPath(path, matrix);
    return moved;
  };
  for (const { lane, body } of ground.lanes) {
    context.fillStyle = colour(LANE_COLOURS[lane.kind] ?? "otherlane");
    context.fill(placed(body));
  }
  context.lineWidth = 1;
  context.strokeStyle = colour("lane-edge");
  // In a junction the ways cross: their edges are no lines on the ground.
  for (const { lane, edges } of ground.lanes) if (!lane.in_junction) context.stroke(placed(edges));
  for (const { kind, path } of ground.marks) {
    const [ink, dash] = MARKS[kind] ?? [null];
    if (!ink) continue;
    context.strokeStyle = colour(ink);
    context.setLineDash(dash.map((length) => length * metre));
    context.lineWidth = kind === "DOUBLE_YELLOW" ? width * 3 : width;
    context.stroke(placed(path));
    if (kind !== "DOUBLE_YELLOW") continue;
    context.strokeStyle = colour("driving");
    context.lineWidth = width;
    context.stroke(placed(path));
  }
  context.setLineDash([]);
}
