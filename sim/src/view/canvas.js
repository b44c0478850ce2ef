// Canvases: sharp on every screen, dragged, wheeled, hovered; axes and tooltips.

const FONT = '11px system-ui, "Segoe UI", "Helvetica Neue", Arial, "DejaVu Sans", sans-serif';

/// A canvas that draws itself with `paint(context, width, height)` when something has changed.
function canvasView(section, paint) {
  const canvas = byId(section).querySelector("canvas");
  const context = canvas.getContext("2d");
  const view = { canvas, width: 0, height: 0, hover: null };
  view.draw = () => {
    const scale = window.devicePixelRatio || 1;
    const { width, height } = canvas.parentElement.getBoundingClientRect();
    if (width < 2 || height < 2) return;
    view.width = width;
    view.height = height;
    const [w, h] = [Math.round(width * scale), Math.round(height * scale)];
    if (canvas.width !== w || canvas.height !== h) {
      canvas.width = w;
      canvas.height = h;
    }
    context.setTransform(scale, 0, 0, scale, 0, 0);
    context.clearRect(0, 0, width, height);
    context.font = FONT;
    context.lineJoin = "round";
    context.setLineDash([]);
    context.globalAlpha = 1;
    paint(context, width, height);
  };
  views.push(view);
  new ResizeObserver(redraw).observe(canvas.parentElement);
  return view;
}

/// Calls back while the pointer drags, wheels, rests or leaves. Positions are in CSS pixels of the canvas.
function pointer(view, { drag, wheel, hover, click, reset }) {
  const { canvas } = view;
  let held = null;
  const place = (event) => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    held = place(event);
    click?.(...held);
  });
  canvas.addEventListener("pointermove", (event) => {
    const at = place(event);
    if (held && drag) {
      drag(at[0] - held[0], at[1] - held[1], at);
      held = at;
      hideTip();
    } else {
      view.hover = at;
      const text = hover?.(...at);
      if (text) showTip(text, event); else hideTip();
    }
    redraw();
  });
  const release = () => { held = null; };
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", release);
  canvas.addEventListener("pointerleave", () => { view.hover = null; hideTip(); redraw(); });
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    wheel?.(Math.exp(-event.deltaY * (event.deltaMode === 1 ? 0.05 : 0.0015)), ...place(event), event);
    redraw();
  }, { passive: false });
  canvas.addEventListener("dblclick", () => { reset?.(); redraw(); });
}

function showTip(text, event) {
  const tip = byId("tip");
  tip.hidden = false;
  tip.textContent = text;
  const { width, height } = tip.getBoundingClientRect();
  // Inside its view, so that the words beside the pictures stay readable.
  const edge = event.target.getBoundingClientRect();
  const left = event.clientX + 14 + width > Math.min(innerWidth, edge.right) && event.clientX - 14 - width > edge.left ? event.clientX - 14 - width : event.clientX + 14;
  const top = event.clientY + 14 + height > innerHeight ? event.clientY - 14 - height : event.clientY + 14;
  tip.style.left = `${Math.max(2, Math.min(left, innerWidth - width - 2))}px`;
  tip.style.top = `${Math.max(2, top)}px`;
}

function hideTip() {
  byId("tip").hidden = true;
}

/// Round numbers between two limits, about `count` of them.
function roundSteps(low, high, count) {
  const raw = (high - low) / Math.max(1, count);
  if (!(raw > 0) || !Number.isFinite(raw)) return { values: [], decimals: 0 };
  const power = 10 ** Math.floor(Math.log10(raw));
  // The factor nearest to the wish, as ratios go: the borders are the geometric means.
  const step = power * (raw < 1.41 * power ? 1 : raw < 3.16 * power ? 2 : raw < 7.07 * power ? 5 : 10);
  const values = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + step * 1e-9; k++) values.push(k * step);
  return { values, decimals: Math.max(0, -Math.floor(Math.log10(step) + 1e-9)) };
}

/// Draws a line through `x, y, x, y, …` as `map` places them; a gap where there is no number.
function trace(context, numbers, map, stride = 2, first = 0) {
  context.beginPath();
  let down = false;
  for (let k = first; k + 1 < numbers.length; k += stride) {
    if (numbers[k] === null || numbers[k + 1] === null) { down = false; continue; }
    const [x, y] = map(numbers[k], numbers[k + 1]);
    if (down) context.lineTo(x, y); else context.moveTo(x, y);
    down = true;
  }
}

/// Text with a rim in the colour of the ground, readable on everything.
function label(context, text, x, y, { ink = "text", rim = "panel", align = "left", base = "alphabetic" } = {}) {
  context.textAlign = align;
  context.textBaseline = base;
  context.lineWidth = 3;
  context.strokeStyle = colour(rim);
  context.setLineDash([]);
  context.strokeText(text, x, y);
  context.fillStyle = colour(ink);
  context.fillText(text, x, y);
}
