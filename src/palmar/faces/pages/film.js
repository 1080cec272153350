"use strict";
// The poses are given at the times in film.times; between two of them everything is linear.
const film = JSON.parse(document.getElementById("film").textContent);
const get = (id) => document.getElementById(id);
const [svg, play, time, pace] = [document.querySelector("svg"), get("play"), get("time"), get("pace")];
const entries = [...document.querySelectorAll(".events button")];
const duration = film.times[film.times.length - 1];
const FRAME = 1 / 30;
let now = 0;
let last = null; // clock of the previous picture, null while paused

function placeAt(t) {
  let low = 0;
  let high = film.times.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (film.times[middle] <= t) low = middle; else high = middle;
  }
  const span = film.times[high] - film.times[low];
  const share = span > 0 ? Math.min((t - film.times[low]) / span, 1) : 0;
  const mix = (rows) => rows[low].map((value, i) => value + share * (rows[high][i] - value));
  return { index: share < 1 ? low : high, pose: mix(film.poses), fingers: mix(film.fingers), palm: mix(film.palm)[0] };
}

const number = (value, digits) => {
  const text = value.toFixed(digits);
  return Number(text) === 0 ? text.replace("-", "") : text.replace("-", "\u2212");
};

function draw() {
  const { index, pose: [x, y, turn], fingers, palm } = placeAt(now);
  const half = fingers.length / 2;
  const sides = { right: fingers.slice(0, half), left: fingers.slice(half) };
  get("hand").setAttribute("transform", `translate(0 ${-palm})`);
  get("object").setAttribute("transform", `translate(${x} ${-y}) rotate(${-turn})`);
  for (const [side, joints] of Object.entries(sides))
    joints.forEach((angle, k) => get(`${side}-${k}`).setAttribute("transform", `rotate(${-angle})`));
  const gone = film.poses.slice(0, index + 1).map(([px, py]) => `${px},${-py}`);
  get("gone").setAttribute("points", [...gone, `${x},${-y}`].join(" "));
  document.querySelectorAll(".contact").forEach((dot, i) => {
    const point = film.contacts[index][i];
    dot.style.display = point ? "" : "none";
    if (point) { dot.setAttribute("cx", point[0]); dot.setAttribute("cy", -point[1]); }
  });
  get("now-time").textContent = `${number(now, 3)} s of ${number(duration, 3)} s`;
  get("now-place").textContent = `${number(x, 2)}, ${number(y, 2)} mm`;
  get("now-turn").textContent = `${number(turn, 2)}\u00b0`;
  get("now-fingers").textContent = [sides.left, sides.right]
    .map((joints) => joints.map((angle) => `${number(angle, 1)}\u00b0`).join(" + ")).join(", ");
  time.value = now;
  time.setAttribute("aria-valuetext", `${number(now, 2)} seconds`);
  const past = entries.filter((each) => Number(each.dataset.time) <= now + 1e-9).pop();
  const same = past && Number(past.dataset.time);
  entries.forEach((each) => {
    if (past && Math.abs(Number(each.dataset.time) - same) < 1e-3) each.setAttribute("aria-current", "true");
    else each.removeAttribute("aria-current");
  });
}

function go(t) {
  now = Math.min(Math.max(t, 0), duration);
  draw();
}

function setPlaying(on) {
  if (on && now >= duration) now = 0;
  last = on ? performance.now() : null;
  play.textContent = on ? "Pause" : "Play";
  if (on) requestAnimationFrame(tick);
}

function tick(clock) {
  if (last === null) return;
  const passed = Math.max(clock - last, 0) / 1000;
  last = clock;
  go(now + passed * Number(pace.value));
  if (now >= duration) setPlaying(false);
  else requestAnimationFrame(tick);
}

// Letters and dots keep their size on the screen, whatever the drawing's scale.
function fit() {
  const box = svg.viewBox.baseVal;
  const unit = Math.max(box.width / svg.clientWidth, box.height / svg.clientHeight);
  if (!Number.isFinite(unit)) return;
  svg.style.setProperty("--unit", unit);
  svg.querySelectorAll("[data-r]").forEach((dot) => dot.setAttribute("r", Number(dot.dataset.r) * unit));
}

const STEPS = { ArrowLeft: -1, ArrowRight: 1, Home: -Infinity, End: Infinity };
document.addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.altKey || event.metaKey || event.target === pace || duration === 0) return;
  const onButton = event.target instanceof HTMLButtonElement;
  if (event.key === " " && !onButton) {
    setPlaying(last === null);
  } else if (event.key in STEPS) {
    setPlaying(false);
    go(now + STEPS[event.key] * FRAME * Number(pace.value));
  } else {
    return;
  }
  event.preventDefault();
});
play.addEventListener("click", () => setPlaying(last === null));
time.addEventListener("input", () => { setPlaying(false); go(Number(time.value)); });
entries.forEach((each) => each.addEventListener("click", () => { setPlaying(false); go(Number(each.dataset.time)); }));
new ResizeObserver(fit).observe(svg);
fit();
draw();
if (duration === 0) {
  [play, time, pace].forEach((each) => { each.disabled = true; });
} else if (!matchMedia("(prefers-reduced-motion: reduce)").matches) {
  setPlaying(true);
}
