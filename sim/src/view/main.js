// One slider for all: play and pause, keys, legends that switch things, and the time in the address.

let played = 0; // fraction of a tick that has been played
let lastFrame = 0;

function play() {
  if (!ticks.length) return;
  if (state.k === ticks.length - 1) seek(0);
  state.playing = true;
  lastFrame = performance.now();
  played = 0;
  byId("play").textContent = "❚❚";
  requestAnimationFrame(step);
}

function pause() {
  state.playing = false;
  byId("play").textContent = "▶";
}

function step(now) {
  if (!state.playing) return;
  played += ((now - lastFrame) / 1000) * Number(byId("pace").value) / run.tick;
  lastFrame = now;
  if (played >= 1) {
    const whole = Math.floor(played);
    played -= whole;
    seek(state.k + whole);
  }
  if (state.k >= ticks.length - 1) pause(); else requestAnimationFrame(step);
}

function moveBy(count) {
  pause();
  if (ticks.length) seek(state.k + count);
}

/// The switch of one candidate: shown or not; marked while it is the chosen one.
function buildChips() {
  const chips = run.labels.map((text) => {
    const chip = element("button", {
      class: "chip", "aria-pressed": "true", title: "show or hide",
      on: { click: () => {
        state.hidden.has(text) ? state.hidden.delete(text) : state.hidden.add(text);
        chip.setAttribute("aria-pressed", String(!state.hidden.has(text)));
        redraw();
      } },
    }, element("i"), text);
    return { chip, text };
  });
  const edges = ticks.flatMap((tick) => tick.candidates.flatMap(({ left, right }) => [...left.classes, ...right.classes]));
  const causes = [...new Set(edges)].sort();
  followers.push(() => {
    const tick = ticks[state.k];
    const now = tick.candidates.map((candidate) => run.labels[candidate.label]);
    const keys = state.byCause ? causes.map((kind) => element("span", { class: "key" },
      element("i", { style: `background:${colour(`k-${kind}`)};color:${colour(`k-${kind}`)}` }), words(kind))) : [];
    byId("candidates").replaceChildren(...chips.map(({ chip }) => chip), ...keys);
    for (const { chip, text } of chips) {
      chip.classList.toggle("absent", !now.includes(text));
      chip.classList.toggle("chosen", now[tick.chosen] === text);
      chip.firstChild.style.borderTopColor = colour(labelColour(text));
      chip.firstChild.style.borderTopStyle = labelDash(text).length ? "dashed" : "solid";
    }
  });
}

function buildRoadKeys() {
  const keys = [["ego", "ego-fill", "ego"], ["standing", "obstacle-fill", "obstacle"], ["moving", "moving-fill", "moving"], ["on foot, bicycle", "vulnerable-fill", "vulnerable"]];
  const build = () => byId("road-keys").replaceChildren(...keys.map(([text, fill, rim]) =>
    element("span", { class: "key" }, element("i", { style: `background:${colour(fill)};border-color:${colour(rim)}` }), text)));
  followers.push(build);
}

function buildTransport() {
  const slider = byId("slider");
  slider.max = Math.max(0, ticks.length - 1);
  slider.addEventListener("input", () => { pause(); if (ticks.length) seek(Number(slider.value)); });
  for (const event of run.events) {
    const share = ticks.length > 1 ? tickAt(event.t) / (ticks.length - 1) : 0;
    byId("ticks").append(element("i", { class: isBad(event) ? "bad" : null, style: `left:${share * 100}%` }));
  }
  followers.push(() => {
    slider.value = state.k;
    const last = ticks[ticks.length - 1].t;
    byId("clock").replaceChildren(`${fixed(ticks[state.k].t)} s of ${fixed(last)} s`, element("span", { class: "n" }, `  ·  tick ${ticks[state.k].n}`));
  });
  byId("play").addEventListener("click", () => (state.playing ? pause() : play()));
  byId("first").addEventListener("click", () => moveBy(-Infinity));
  byId("back").addEventListener("click", () => moveBy(-1));
  byId("ahead").addEventListener("click", () => moveBy(1));
}

function bindSwitch(id, key) {
  const box = byId(id);
  const apply = () => {
    state[key] = box.checked;
    if (key === "turn" || key === "follow") roadReset();
    if (ticks.length) seek(state.k);
  };
  box.addEventListener("change", apply);
  return () => { box.checked = !box.checked; apply(); };
}

function bindKeys() {
  const toggle = {
    r: bindSwitch("turn", "turn"), f: bindSwitch("follow", "follow"), c: bindSwitch("causes", "byCause"), p: bindSwitch("predictions", "predictions"), x: bindSwitch("rejected", "rejected"),
    d: () => setTheme(document.documentElement.dataset.theme === "dark" ? "light" : "dark"),
    " ": () => (state.playing ? pause() : play()),
    ArrowLeft: (event) => moveBy(event.shiftKey ? -10 : -1),
    ArrowRight: (event) => moveBy(event.shiftKey ? 10 : 1),
    Home: () => moveBy(-Infinity),
    End: () => moveBy(Infinity),
  };
  window.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.target.tagName === "SELECT") return;
    const action = toggle[event.key];
    if (!action) return;
    event.preventDefault();
    document.activeElement?.blur?.();
    action(event);
  });
  byId("theme").addEventListener("click", toggle.d);
  byId("road-reset").addEventListener("click", () => { roadReset(); redraw(); });
  byId("frenet-reset").addEventListener("click", () => { frenetReset(); redraw(); });
}

/// `#t=12.3&theme=dark&cause&zoom=20`: what a link or a screenshot may ask for.
function readAddress() {
  const wishes = new URLSearchParams(location.hash.slice(1));
  if (wishes.has("theme")) setTheme(wishes.get("theme") === "dark" ? "dark" : "light");
  if (wishes.has("cause")) state.byCause = byId("causes").checked = true;
  if (Number(wishes.get("zoom")) > 0) camera.scale = Number(wishes.get("zoom"));
  if (ticks.length) seek(wishes.has("t") ? tickAt(Number(wishes.get("t"))) : state.k);
}

function writeAddress() {
  if (!ticks.length || state.playing) return;
  history.replaceState(null, "", `#t=${ticks[state.k].t}`);
}

setTheme(matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
buildChips();
openLattice();
buildRoadKeys();
buildTransport();
bindKeys();
readAddress();
followers.push(writeAddress);
window.addEventListener("hashchange", readAddress);
redraw();
