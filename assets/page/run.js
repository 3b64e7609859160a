"use strict";
// Everything on the page moves with the film's time; the scene's time follows from it by the film's clock.
const data = JSON.parse(document.getElementById("data").textContent);
const byId = id => document.getElementById(id);
const film = byId("film");
const shown = number => Number(number.toPrecision(6)).toString();

// From one of two ascending columns of pairs to the other; both are piecewise linear.
function along(pairs, from, to, value) {
  let last = pairs[0];
  if (value <= last[from]) return last[to];
  for (const pair of pairs.slice(1)) {
    if (value <= pair[from]) {
      const part = (value - last[from]) / (pair[from] - last[from]);
      return last[to] + part * (pair[to] - last[to]);
    }
    last = pair;
  }
  return last[to];
}
const sceneTime = () => along(data.clock, 0, 1, film.currentTime);
const seek = scene => { film.currentTime = Math.max(0, along(data.clock, 1, 0, scene)); };

// ---- What it is.
document.title = data.name;
byId("name").textContent = data.name;
byId("facts").textContent =
  `${data.boxes} ${data.boxes === 1 ? "box" : "boxes"}, ${shown(data.duration)} s by ${data.method}, ` +
  `${data.impact_count} impacts`;
byId("audit").textContent = `Audit: ${data.audit.words}`;
byId("audit").className = data.audit.breaches.length ? "bad" : "";
for (const text of data.audit.breaches) {
  byId("breaches").hidden = false;
  byId("breaches").append(Object.assign(document.createElement("li"), { textContent: text }));
}
byId("program").textContent = `Made by ${data.program}.`;

// ---- Charts.
const kWidth = 1000;
const kHeight = 240;
const svg = (name, attributes) => {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  return element;
};
const charts = [];
function addChart(id, series) {
  const time = data.energies.time;
  const all = series.flatMap(each => each.values);
  let low = Math.min(0, ...all.reduce(([a, b], v) => [Math.min(a, v), Math.max(b, v)], [0, 0]));
  let high = all.reduce((a, v) => Math.max(a, v), 0);
  if (!(high > low)) high = low + 1;
  const x = t => t / data.duration * kWidth;
  const y = v => kHeight - 12 - (v - low) / (high - low) * (kHeight - 24);
  const picture = svg("svg", { viewBox: `0 0 ${kWidth} ${kHeight}`, preserveAspectRatio: "none", role: "img",
                               "aria-label": series.map(each => each.name).join(", ") + " over time" });
  picture.append(svg("line", { x1: 0, x2: kWidth, y1: y(0), y2: y(0) }));
  for (const each of series) {
    const points = each.values.map((v, k) => `${x(time[k]).toFixed(1)},${y(v).toFixed(1)}`);
    const path = svg("path", { d: "M" + points.join("L") });
    path.style.stroke = each.color;
    picture.append(path);
  }
  const now = svg("line", { class: "now", y1: 0, y2: kHeight });
  picture.append(now);
  const place = byId(id);
  place.append(picture);
  for (const [name, value] of [["high", high], ["low", low]]) {
    place.append(Object.assign(document.createElement("span"), { className: name, textContent: shown(value) }));
  }
  const go = event => seek((event.clientX - place.getBoundingClientRect().left) / place.clientWidth * data.duration);
  place.addEventListener("pointerdown", go);
  place.addEventListener("pointermove", event => { if (event.buttons) go(event); });
  const labels = series.map(each => {
    const label = document.createElement("span");
    label.style.setProperty("--own", each.color);
    byId(id + "-legend").append(label);
    return label;
  });
  charts.push(scene => {
    now.setAttribute("x1", x(scene));
    now.setAttribute("x2", x(scene));
    let at = time.findIndex(t => t > scene);
    at = at < 0 ? time.length - 1 : Math.max(0, at - 1);
    series.forEach((each, k) => { labels[k].textContent = `${each.name} ${shown(each.values[at])}`; });
  });
}
const energies = data.energies;
const sum = names => energies.time.map((_, k) => names.reduce((total, name) => total + energies[name][k], 0));
const moves = values => values.some(v => Math.abs(v) > 0);
addChart("energy", [
  { name: "translation", values: energies.translation, color: "var(--c0)" },
  { name: "rotation", values: energies.rotation, color: "var(--c1)" },
  { name: "gravity", values: energies.gravity, color: "var(--c2)" },
  { name: "springs", values: sum(["springs", "joint_springs"]), color: "var(--c3)" },
  { name: "total", values: energies.total, color: "var(--c4)" },
  { name: "lost", values: sum(["impacts", "joint_friction", "damping", "drag", "remaining"]), color: "var(--c5)" },
].filter(each => each.name === "total" || moves(each.values)));
addChart("momentum", [
  { name: "px [kg m/s]", values: energies.px, color: "var(--c0)" },
  { name: "py", values: energies.py, color: "var(--c1)" },
  { name: "pz", values: energies.pz, color: "var(--c2)" },
]);

// ---- Impacts.
const kRows = 200;
const names = [...new Set(data.impacts.flatMap(impact => [impact[1], impact[2]]))].sort();
for (const name of names) byId("of").append(new Option(name, name));
let listed = [];
let rows = kRows;
function list() {
  const of = byId("of").value;
  listed = data.impacts.filter(impact => !of || impact[1] === of || impact[2] === of);
  const body = byId("impacts");
  body.replaceChildren();
  for (const impact of listed.slice(0, rows)) {
    const row = body.insertRow();
    const button = Object.assign(document.createElement("button"), { type: "button", textContent: shown(impact[0]) });
    button.addEventListener("click", () => { film.pause(); seek(impact[0]); });
    row.insertCell().append(button);
    for (const text of [impact[1], impact[2], ...impact.slice(3).map(shown)]) row.insertCell().textContent = text;
  }
  byId("more").hidden = listed.length <= rows;
  byId("impacts-note").textContent = data.impact_count === 0 ? "There are none." :
    `${listed.length} of ${data.impact_count}` +
    (data.impact_count > data.impacts.length ? ", the hardest ones" : "") + ". A time leads to its moment of the film.";
}
byId("of").addEventListener("change", () => { rows = kRows; list(); });
byId("more").addEventListener("click", () => { rows += kRows; list(); });
list();

// ---- Going through the film.
const frame = 1e-4;
function toImpact(by) {
  const scene = sceneTime();
  const times = listed.map(impact => impact[0]);
  const wanted = by > 0 ? times.find(t => t > scene + frame) : times.findLast(t => t < scene - frame);
  if (wanted !== undefined) { film.pause(); seek(wanted); }
}
byId("back").addEventListener("click", () => toImpact(-1));
byId("next").addEventListener("click", () => toImpact(1));
byId("speed").addEventListener("change", () => { film.playbackRate = Number(byId("speed").value); });
document.addEventListener("keydown", event => {
  if (["SELECT", "BUTTON", "VIDEO"].includes(event.target.tagName) && event.key === " ") return;
  if (event.target.tagName === "SELECT" || event.ctrlKey || event.altKey || event.metaKey) return;
  const act = { " ": () => film.paused ? film.play() : film.pause(), ArrowLeft: () => toImpact(-1),
                ArrowRight: () => toImpact(1), ",": () => { film.currentTime -= 0.1; },
                ".": () => { film.currentTime += 0.1; } }[event.key];
  if (act) { act(); event.preventDefault(); }
});
let before = -1;
function follow() {
  const scene = sceneTime();
  if (scene !== before) {
    before = scene;
    byId("now").textContent = `${scene.toFixed(3)} s`;
    for (const chart of charts) chart(scene);
    [...byId("impacts").rows].forEach((row, k) => {
      row.className = Math.abs(listed[k][0] - scene) < 0.02 ? "now" : "";
    });
  }
  requestAnimationFrame(follow);
}
follow();
