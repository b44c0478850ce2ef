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
    ["stop", tick.stop === null ? "none" : run.texts[tick.stop]],
    ["outcome", element("span", { class: tick.normal ? null : "fail" }, run.texts[tick.outcome])],
    ["state", element("span", { class: "mono" }, tick.hash)],
  ]);
}

function candidateBox(candidate, chosen) {
  const text = run.labels[candidate.label];
  const length = candidate.span[1] - candidate.span[0];
  const narrow = candidate.narrow;
  const detail = [
    run.texts[candidate.text] + (candidate.blocked === null ? "" : `; blocked by \`${run.texts[candidate.blocked]}\``),
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

function paintDecision() {
  if (!ticks.length) return;
  const tick = ticks[state.k];
  const chosen = tick.candidates[tick.chosen];
  byId("decision").replaceChildren(
    situation(tick),
    element("h3", {}, "Candidates"),
    ...tick.candidates.map((candidate, k) => candidateBox(candidate, k === tick.chosen)),
    ...(chosen ? [element("h3", {}, `Limits of ${run.labels[chosen.label]}`), limitTable(chosen)] : [element("h3", {}, "No bound chosen")]),
  );
}
followers.push(paintDecision);

function jump(t) {
  return { click: () => { pause(); seek(tickAt(t)); } };
}

function metricRow(metric) {
  const judged = metric.value !== null && (metric.threshold !== null || metric.gate);
  const mark = !judged ? "" : metric.pass ? "✓" : "✗";
  const kind = !judged ? null : metric.pass ? "pass" : metric.gate ? "fail" : "warn";
  const worst = metric.worst_t === null ? "" : `${fixed(metric.worst_t, 1)} s`;
  const row = element("tr", {
    class: `metric${metric.worst_t === null ? "" : " jump"}`, on: metric.worst_t === null ? {} : jump(metric.worst_t),
    title: metric.worst_t === null ? null : "jump to its worst moment",
  },
  element("td", { class: kind }, mark),
  element("td", {}, element(metric.gate ? "b" : "span", {}, metric.name)),
  element("td", { class: "n" }, metric.value === null ? "–" : fixed(metric.value, Math.abs(metric.value) < 10 ? 3 : 1).replace(/\.?0+$/, "")),
  element("td", { class: "n" }, metric.threshold === null ? "" : String(metric.threshold)),
  element("td", { class: "n" }, worst),
  element("td", {}, metric.worst_obstacle ?? ""));
  return row;
}

function buildVerdict() {
  const { verdict } = run;
  if (!verdict) {
    byId("verdict").replaceChildren(element("p", { class: "warn" }, "The run has no verdict: its trace ends before its end."));
    return;
  }
  const heads = [["", ""], ["metric", ""], ["value", "n"], ["limit", "n"], ["worst", "n"], ["", ""]];
  byId("verdict").replaceChildren(
    element("p", { class: verdict.pass ? "pass" : "fail", style: "margin:0 0 6px" }, verdict.summary),
    element("table", {}, element("tr", {}, ...heads.map(([text, kind]) => element("th", { class: kind }, text))), ...verdict.metrics.map(metricRow)),
    ...verdict.collisions.map((c) => element("div", { class: "event jump", on: jump(c.time) },
      element("span", {}, `${fixed(c.time, 1)} s`), element("span", { class: "fail" }, "collision"),
      element("span", {}, `with ${c.obstacle}: ${words(c.class)}, Δv ${fixed(c.delta_v, 1)} m/s, ${c.at_fault ? "the ego's fault" : "not the ego's fault"}`))),
    element("p", { style: "margin:6px 0 0", class: "mono" }, `${verdict.outcomes.map(([name, count]) => `${words(name)} ${count}`).join(", ")} · ${verdict.digest}`),
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
