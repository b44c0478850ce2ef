// The words beside the pictures: the decision of the tick, the verdict, the events, the scenario.

function swatch(name) {
  return element("i", { style: `background:${colour(name)}` });
}

function describe(pairs) {
  const list = element("dl");
  for (const [name, value] of pairs) if (value !== null && value !== "") list.append(element("dt", {}, name), element("dd", {}, value));
  return list;
}

function situation(tick) {
  const [, , , steer] = tick.ego;
  const v = series.speed[state.k];
  return describe([
    ["ego", `s ${fixed(tick.sl[0])} m, l ${signed(tick.sl[1])} m`],
    ["speed", `${fixed(v)} m/s (${fixed(v * 3.6, 1)} km/h), ${signed(series.acceleration[state.k])} m/s²`],
    ["wheels", `${signed((steer * 180) / Math.PI, 1)}°`],
    ["command", `${run.texts[tick.command]}, at most ${fixed(series.cruise_speed[state.k], 1)} m/s`],
    ["stop", tick.stop === null ? "none" : run.texts[tick.stop] + (tick.stop_at ? `, ${fixed(tick.stop_at[0], 1)} m ahead` : "")],
    ["place", tick.pull_over ? (([s, l]) => `to pull over: s ${fixed(s)} m, l ${signed(l)} m`)(toLineNear(lineCaches[tick.line], tick.sl[0], ...tick.pull_over)) : null],
    ["outcome", element("span", { class: tick.normal ? null : "fail" }, run.texts[tick.outcome] + (tick.fallback ? `: ${textOr(tick.fallback[0])}` : ""))],
    ["state", element("span", { class: "mono" }, tick.hash)],
  ]);
}

function candidateBox(candidate, chosen) {
  const text = run.labels[candidate.label];
  const length = candidate.span[1] - candidate.span[0];
  const narrow = candidate.narrow;
  const fate = [chosen ? "" : run.texts[candidate.text], candidate.blocked === null ? "" : `blocked by \`${run.texts[candidate.blocked]}\``];
  const detail = [
    ...(fate.some((part) => part) ? [fate.filter((part) => part).join("; ")] : []),
    narrow ? `narrowest ${fixed(narrow[2] - narrow[1])} m at s ${fixed(narrow[0], 1)}: ${causeAt(candidate.left, narrow[0])} on the left, ${causeAt(candidate.right, narrow[0])} on the right` : "no point in it",
  ];
  return element("div", { class: `candidate${chosen ? " chosen" : ""}` },
    swatch(labelColour(text)), element("b", {}, (chosen ? "✓ " : "") + text),
    element("span", {}, `${fixed(length, 1)} m`), ...detail.map((line) => element("small", {}, line)));
}

const causeAt = (edge, s) => (causesOf(edge).findLast(({ from }) => from <= s + 1e-6) ?? { text: "nothing" }).text;

/// The limits of the chosen bound, one side, by cause.
function limitRows(edge, side) {
  return causesOf(edge).map(({ kind, text, from, to }, k) => {
    const l = [];
    for (let j = 0; j < edge.at.length; j += 2) {
      if (edge.at[j] >= from - 1e-6 && edge.at[j] <= to + 1e-6 && edge.at[j + 1] !== null) l.push(edge.at[j + 1]);
    }
    // The point at `to` belongs to the next cause, if there is one.
    if (k + 1 < edge.classes.length && l.length > 1) l.pop();
    const [low, high] = [Math.min(...l), Math.max(...l)];
    const range = high - low < 0.005 ? signed(low) : `${signed(low)}…${signed(high)}`;
    return element("tr", {}, element("td", { class: "n" }, `${fixed(from, 1)}…${fixed(to, 1)}`),
      element("td", {}, swatch(`k-${kind}`), k ? "" : "", text), element("td", { class: "n" }, range), element("td", {}, side));
  });
}

function limitTable(candidate) {
  return element("table", { class: "limits" },
    element("tr", {}, element("th", { class: "n" }, "s [m]"), element("th", {}, "limited by"), element("th", { class: "n" }, "l [m]"), element("th", {}, "")),
    ...limitRows(candidate.left, "left"), ...limitRows(candidate.right, "right"));
}

const textOr = (place) => (place === null ? "none" : run.texts[place].replaceAll("`", ""));

/// What each task was given and what it found, in the order in which they ran, up to the one that failed.
function taskRow([name, input, output, error]) {
  return element("div", { class: `task${error ? " failed" : ""}` }, element("i", {}, error ? "✗" : "✓"), element("b", {}, words(name)),
    element("span", {}, output ? `${input} → ${output}` : input, error ? element("div", { class: "fail" }, error) : null));
}

function paintTasks() {
  if (!ticks.length) return;
  const tick = ticks[state.k];
  const tasks = tick.tasks.map((place) => run.tasks[place]);
  const fallback = tick.fallback ? [element("h3", {}, "Fallback"),
    describe([["cause", textOr(tick.fallback[0])], ["path", tick.fallback[1] === null && tick.path.length ? "of this tick" : textOr(tick.fallback[1])], ["speed", textOr(tick.fallback[2])]])] : [];
  // What failed comes before what was weighed.
  byId("tasks").className = fallback.length ? "failed" : "";
  byId("tasks").replaceChildren(...(tasks.length ? [element("h3", {}, "Tasks"), ...tasks.map(taskRow)] : []), ...fallback);
}
followers.push(paintTasks);

function paintDecision() {
  if (!ticks.length) return;
  const tick = ticks[state.k];
  const chosen = tick.candidates[tick.chosen];
  byId("situation").replaceChildren(situation(tick));
  if (run.lattice) return;
  byId("bounds").replaceChildren(
    ...(tick.candidates.length ? [element("h3", {}, "Candidates")] : []),
    ...tick.candidates.map((candidate, k) => candidateBox(candidate, k === tick.chosen)),
    ...(chosen ? [element("h3", {}, `Limits of ${run.labels[chosen.label]}`), limitTable(chosen)] : [element("h3", {}, "No bound chosen")]),
  );
}
followers.push(paintDecision);

function jump(t) {
  return { click: () => { pause(); seek(tickAt(t)); } };
}

const isJudged = (metric) => metric.value !== null && (metric.threshold !== null || metric.gate);

function metricRow(metric) {
  const judged = isJudged(metric);
  const kind = !judged ? null : metric.pass ? "pass" : metric.gate ? "fail" : "warn";
  const at = metric.worst_t;
  return element("tr", { class: `metric${at === null ? "" : " jump"}`, on: at === null ? {} : jump(at), title: at === null ? null : "jump to its worst moment" },
    element("td", { class: kind }, !judged ? "" : metric.pass ? "✓" : "✗"),
    element("td", { class: metric.gate ? "gate" : null }, words(metric.name), metric.worst_obstacle === null ? null : element("small", {}, metric.worst_obstacle)),
    element("td", { class: `n ${judged && !metric.pass ? kind : ""}` }, plain(metric.value)),
    element("td", { class: "n" }, metric.threshold === null ? "" : plain(metric.threshold)),
    element("td", { class: "n" }, at === null ? "" : `${fixed(at, 1)} s`));
}

/// A number as short as it can be said to three decimals, or to one where it is large.
const plain = (value) => {
  const text = fixed(value, Math.abs(value) < 10 ? 3 : 1);
  return text.includes(".") ? text.replace(/\.?0+$/, "") : text;
};

/// What failed first, then the gates, then the rest; each in its own order.
function metricTable(metrics) {
  const heads = [["", ""], ["metric", ""], ["value", "n"], ["limit", "n"], ["worst at", "n"]];
  const rank = (metric) => (isJudged(metric) && !metric.pass ? 0 : metric.gate ? 1 : 2);
  const titles = ["not met", "gates", "measured"];
  const table = element("table", {}, element("tr", {}, ...heads.map(([text, kind]) => element("th", { class: kind }, text))));
  for (const [k, title] of titles.entries()) {
    const group = metrics.filter((metric) => rank(metric) === k && metric.value !== null);
    if (group.length) table.append(element("tr", {}, element("th", { colspan: 5, class: "group" }, title)), ...group.map(metricRow));
  }
  return table;
}

function collisionRow(hit) {
  return element("div", { class: "event jump", on: jump(hit.time) },
    element("span", {}, `${fixed(hit.time, 1)} s`), element("span", { class: "fail" }, "collision"),
    element("span", {}, `with ${hit.obstacle}: ${words(hit.class)}, Δv ${fixed(hit.delta_v, 1)} m/s, ` +
      `${hit.at_fault ? "the ego's fault" : "not the ego's fault"}, ${hit.avoidable ? "braking would have avoided it" : "braking could not have avoided it"}`));
}

function buildVerdict() {
  const { verdict } = run;
  if (!verdict) {
    byId("verdict").replaceChildren(element("p", { class: "warn" }, "The run has no verdict: its trace ends before its end."));
    return;
  }
  const idle = verdict.metrics.filter((metric) => metric.value === null).map((metric) => words(metric.name));
  byId("verdict").replaceChildren(
    element("p", { class: verdict.pass ? "pass" : "fail" }, verdict.summary),
    ...verdict.collisions.map(collisionRow),
    metricTable(verdict.metrics),
    ...(idle.length ? [element("p", { class: "soft" }, `no occasion to measure: ${idle.join(", ")}`)] : []),
    element("p", { class: "soft" }, `ticks: ${verdict.outcomes.map(([name, count]) => `${words(name)} ${count}`).join(", ")}`),
    element("p", { class: "mono" }, verdict.digest),
  );
}

function buildEvents() {
  const rows = run.events.map((event) => element("div", { class: "event jump", on: jump(event.t), "data-t": event.t },
    element("span", {}, `${fixed(event.t, 1)} s`), element("span", { class: isBad(event) ? "fail" : null }, event.kind), element("span", {}, event.text)));
  byId("events").replaceChildren(...(rows.length ? rows : ["Nothing happened."]));
  followers.push(() => {
    const { t } = ticks[state.k];
    for (const row of rows) row.classList.toggle("now", Math.abs(Number(row.dataset.t) - t) < run.tick * 0.75);
  });
}

function buildScenario() {
  byId("scenario").replaceChildren(
    describe([["name", run.scenario], ["seed", run.seed], ["build", run.build], ["settings", run.overrides.join(", ")],
      ["origin", `(${fixed(run.origin[0], 0)}, ${fixed(run.origin[1], 0)}) m`], ["obstacles", String(run.names.length)]]),
    element("details", { style: "margin-top:6px" }, element("summary", {}, "its file"), element("pre", {}, run.source)),
  );
}

function buildHeader() {
  const { verdict } = run;
  byId("title").textContent = run.scenario;
  byId("title").title = run.scenario;
  byId("run").textContent = `seed ${run.seed} · build ${run.build}`;
  const badge = byId("badge");
  badge.className = verdict ? (verdict.pass ? "pass" : "fail") : "open";
  badge.textContent = verdict ? `${verdict.pass ? "✓ passed" : "✗ failed"} · ${words(verdict.ending)}` : "cut off";
  byId("summary").textContent = verdict ? verdict.summary : ticks.length ? "the trace ends before its end" : "the trace holds no tick";
  byId("summary").title = byId("summary").textContent;
}

buildHeader();
buildVerdict();
buildEvents();
buildScenario();
