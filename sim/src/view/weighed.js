// What was weighed, in words and numbers: the driven pair beside the one that is pointed at, and why the others are not
// driven. The legend of the colours.

function unweighedText() {
  if (!ticks.length) return "";
  const { differs_from: from } = run.lattice;
  if (from !== null && state.k >= from) {
    return `decided again, the run comes out differently from ${fixed(timeOf(from), 1)} s on: what was weighed is not known`;
  }
  return "no curves were sampled";
}

const pairName = ({ along, across }) => `longitudinal ${along.k}, lateral ${across.k}`;

/// The six costs of the driven pair, and of the one that is pointed at.
function costTable(driven, other) {
  const row = (name, value, kind) => element("tr", { class: kind }, element("td", {}, name),
    ...[driven, other].map((pair) => element("td", { class: "n" }, pair ? fixed(value(pair)) : "")));
  return element("table", { class: "costs" },
    element("tr", {}, element("th", {}, "cost of"), element("th", { class: "n" }, "driven"), element("th", { class: "n" }, "pointed at")),
    ...COSTS.map((name, k) => row(name, (pair) => pair.costs[k])), row("sum", (pair) => pair.cost, "sum"));
}

function drivenText() {
  const { driven, braking, pairs } = weighed;
  if (driven) return element("p", {}, `Driven: ${pairName(driven)} (${driven.along.kind}).`);
  const how = `brakes with ${fixed(-braking.deceleration, 1)} m/s² along lateral ${braking.lateral}`;
  const none = pairs.length ? `none of ${pairs.length} pairs may be driven` : "every longitudinal curve passes the stop point or breaks a limit";
  return braking.against === null
    ? element("p", { class: "warn" }, `Backup: ${how}, for ${none}.`)
    : element("p", { class: "fail" }, `Last resort: ${how} and even so ${run.texts[braking.against].replaceAll("`", "")}, for ${none}.`);
}

function pointedText(other) {
  const along = weighed.longitudinal[pointed.longitudinal ?? held.longitudinal];
  if (!other && along?.unfit) return `Pointed at: longitudinal ${along.k} (${along.kind}), in no pair: ${along.unfit}.`;
  if (!other) return "Point at a curve for its best pair. A click holds it: then point at its partner in the other picture.";
  const fate = other.fault ?? (other.driven ? "driven" : weighed.driven ? `dearer by ${fixed(other.cost - weighed.driven.cost)}` : "free");
  return `Pointed at: ${pairName(other)} (${other.along.kind}): ${fate}.`;
}

/// Pairs by why they are not driven, curves by why they are in no pair.
function fateTable() {
  const { pairs, free, driven, longitudinal, lateral } = weighed;
  const row = (count, words, ink) => element("tr", {}, element("td", { class: "n" }, String(count)), element("td", { class: ink }, words));
  const rows = faultCounts(pairs).map(([fault, count]) => row(count, fault.replaceAll("`", "")));
  if (free.length) rows.unshift(row(free.length - (driven ? 1 : 0), "dearer than the driven one"));
  const unfit = Object.values(UNFIT).map((why) => [why, longitudinal.filter((curve) => curve.unfit === why).length]).filter(([, count]) => count);
  return element("table", { class: "fates" },
    element("tr", {}, element("th", { class: "n" }, String(pairs.length)), element("th", {}, `pairs of ${longitudinal.filter((c) => !c.unfit).length} longitudinal and ${lateral.length} lateral curves`)), ...rows,
    element("tr", {}, element("th", { class: "n" }, String(longitudinal.filter((c) => c.unfit).length)), element("th", {}, `of ${longitudinal.length} longitudinal curves in no pair`)),
    ...unfit.map(([why, count]) => row(count, why)));
}

/// What the lines cost, where there is more than one.
function lineRows({ lines, line }) {
  if (lines.length < 2) return [];
  const text = ([place, cost, surcharge]) => `line ${place + 1}: ${fixed(cost)}${surcharge ? ` + ${fixed(surcharge)} for not being the wanted one` : ""}${place === line ? ", driven" : ""}`;
  return [element("p", { class: "soft" }, lines.map(text).join("; "))];
}

let told = "";

/// Beside the pictures; again whenever the pointer means another pair.
function paintWeighed() {
  const box = byId("weighed");
  if (!run.lattice || !ticks.length) return;
  const known = weigh(ticks[state.k]);
  const other = known && pointedPair();
  const key = [state.k, other ? pairName(other) : "", pointed.longitudinal, held.longitudinal].join();
  if (key === told) return;
  told = key;
  box.replaceChildren(element("h3", {}, "Pairs"), ...(known
    ? [drivenText(), ...(known.driven || other ? [costTable(known.driven, other)] : []), element("p", { class: "soft pointed" }, pointedText(other)), ...lineRows(known.bundle), fateTable()]
    : [element("p", { class: "soft" }, unweighedText())]));
}

/// The scale of costs with its ends, and what the other lines mean.
function buildScale() {
  followers.push(() => {
    const known = weigh(ticks[state.k]);
    const stops = Array.from({ length: SCALE }, (_, k) => `${colour(`v${k}`)} ${Math.round((k / (SCALE - 1)) ** 2 * 100)}%`).join(",");
    const key = (text, style) => element("span", { class: "key" }, element("i", { class: "stroke", style }), text);
    const scale = known?.span ? [element("span", { class: "key" }, `cost ${fixed(known.span[0], 1)}`,
      element("i", { class: "scale", style: `background:linear-gradient(90deg in oklab,${stops})` }), fixed(known.span[1], 1))] : [];
    const braking = known?.braking && (known.braking.against === null ? "backup" : "last resort");
    byId("scale").replaceChildren(...scale, key(braking ?? "driven", `border-top:3px solid ${colour(drivenInk(ticks[state.k]))}`),
      key("rejected", `border-top:1px dashed ${colour("rejected")}`));
  });
}

/// Shows what belongs to this planner, and hides what belongs to the other.
function openLattice() {
  if (!run.lattice) return;
  document.querySelector("main").classList.add("lattice");
  for (const id of ["st", "weighed", "scale"]) byId(id).hidden = false;
  for (const id of ["candidates", "causes-switch"]) byId(id).hidden = true;
  byId("frenet-title").textContent = "Across the line";
  buildScale();
  views.push({ draw: paintWeighed });
}
