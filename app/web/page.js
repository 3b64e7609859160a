"use strict";
const byId = id => document.getElementById(id);
const shown = number => Number(Number(number).toPrecision(6)).toString();
const scenes = JSON.parse(byId("scenes").textContent);
const speeds = [...byId("speed").options].map(option => option.value);

// ---- The program: unpacked once, in a worker of its own for each scene.
const base64Bytes = text => Uint8Array.from(atob(text), letter => letter.charCodeAt(0));
const through = async (bytes, stream) => new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());
const program = through(base64Bytes(byId("wasm").textContent), new DecompressionStream("gzip")).then(WebAssembly.compile);
const workerAddress = URL.createObjectURL(new Blob([byId("worker").textContent], { type: "text/javascript" }));
let worker = null;
let films = 0;  // shown so far

function tellFault(text) {
  byId("fault").hidden = !text;
  byId("fault").textContent = text;
  const place = /:(\d+):(\d+):/.exec(text);
  if (place) {
    byId("editor").open = true;
    const lines = byId("text").value.split("\n");
    const start = lines.slice(0, place[1] - 1).reduce((sum, line) => sum + line.length + 1, 0);
    byId("text").setSelectionRange(start + Number(place[2]) - 1, start + (lines[place[1] - 1] ?? "").length);
  }
}

function stop() {
  if (worker) worker.terminate();
  worker = null;
  byId("work").hidden = true;
}

async function simulate(name, files, about) {
  stop();
  tellFault("");
  byId("about").textContent = about || "";
  byId("text").value = files[name];
  current = { name, files };
  byId("work").hidden = false;
  byId("phase").textContent = "unpacking the program";
  byId("progress").removeAttribute("value");
  const mine = worker = new Worker(workerAddress);
  const failed = text => {
    if (worker !== mine) return;
    stop();
    tellFault(text);
  };
  worker.onerror = event => failed(event.message || "the browser could not start the program");
  worker.onmessage = ({ data }) => {
    if (worker !== mine) return;
    if (data.fault) return failed(data.fault);
    if (data.done) {
      stop();
      return show(data.done).catch(error => tellFault(`The film cannot be shown: ${error.message}`));
    }
    if (data.phase !== "simulate") {
      byId("progress").removeAttribute("value");
      byId("phase").textContent = data.phase;
    } else {
      byId("progress").value = data.simulated / data.duration;
      byId("phase").textContent = data.seconds === undefined ? "simulating" :
        `${shown(data.simulated.toPrecision(3))} of ${shown(data.duration)} s, ${data.impacts} impacts`;
    }
  };
  try {
    const module = await program;
    if (worker === mine) worker.postMessage({ module, name, files });
  } catch (error) {
    failed(`This browser cannot run the program: ${error.message}`);
  }
}
byId("cancel").addEventListener("click", stop);

// ---- Scenes: the shipped ones, files, text, links.
let current = { name: "scene.json", files: {} };
for (const scene of scenes) byId("gallery").append(new Option(scene.name.replace(/\.json$/, ""), scene.name));
byId("gallery").append(Object.assign(new Option("your own", ""), { hidden: true }));

function openShipped(name) {
  const scene = scenes.find(each => each.name === name) ?? scenes[0];
  byId("gallery").value = scene.name;
  simulate(scene.name, { [scene.name]: scene.text }, scene.about);
}
byId("gallery").addEventListener("change", () => {
  history.replaceState(null, "", "#shipped=" + byId("gallery").value.replace(/\.json$/, ""));
  openShipped(byId("gallery").value);
});

// One scene, and what it names, such as meshes.
async function openFiles(list) {
  const chosen = [...list];
  const main = chosen.find(file => /\.jsonc?$/i.test(file.name)) ?? chosen.find(file => /\.xml$/i.test(file.name)) ?? chosen[0];
  if (!main) return;
  const files = {};
  for (const file of chosen) files[file.name] = await file.text();
  byId("gallery").value = "";
  simulate(main.name, files);
}
byId("file").addEventListener("change", () => openFiles(byId("file").files));
addEventListener("dragover", event => {
  event.preventDefault();
  document.body.classList.add("over");
});
addEventListener("dragleave", () => document.body.classList.remove("over"));
addEventListener("drop", event => {
  event.preventDefault();
  document.body.classList.remove("over");
  openFiles(event.dataTransfer.files);
});
byId("again").addEventListener("click", () => {
  byId("gallery").value = "";
  simulate(current.name, { ...current.files, [current.name]: byId("text").value });
});

// #scene=…: base64url of the text, deflated.
async function packed(text) {
  const bytes = await through(new TextEncoder().encode(text), new CompressionStream("deflate"));
  return btoa(Array.from(bytes, byte => String.fromCharCode(byte)).join("")).replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
}
async function unpacked(word) {
  const bytes = base64Bytes(word.replace(/-/g, "+").replace(/_/g, "/"));
  const isText = bytes[0] === 0x7b || bytes[0] === 0x2f;  // { or /: not deflated
  return new TextDecoder().decode(isText ? bytes : await through(bytes, new DecompressionStream("deflate")));
}
byId("link").addEventListener("click", async () => {
  history.replaceState(null, "", "#scene=" + await packed(byId("text").value));
  try {
    await navigator.clipboard.writeText(location.href);
    byId("link").textContent = "Copied";
  } catch (error) {
    byId("link").textContent = "It is the page's address now";
  }
  setTimeout(() => { byId("link").textContent = "Copy a link"; }, 2000);
});
async function openLink() {
  const [, key, value] = /^#(scene|shipped)=(.*)$/.exec(location.hash) ?? [];
  if (key !== "scene") return openShipped((value ?? "careen") + ".json");
  byId("gallery").value = "";
  try {
    simulate("scene.json", { "scene.json": await unpacked(value) });
  } catch (error) {
    tellFault("The link does not carry a scene: its text is damaged.");
  }
}
addEventListener("hashchange", openLink);

// ---- The film: the program's own, whose keys lie as close to the run as asked.
let film = null;
let time = 0;
let playing = false;
const view = (() => {
  try {
    const renderer = new THREE.WebGLRenderer({ canvas: byId("canvas"), antialias: true });
    renderer.gammaOutput = true;
    renderer.gammaFactor = 2.2;
    renderer.shadowMap.enabled = true;
    renderer.shadowMap.type = THREE.PCFSoftShadowMap;
    const camera = new THREE.PerspectiveCamera();
    return { renderer, camera, orbit: new THREE.OrbitControls(camera, byId("canvas")) };
  } catch (error) {
    byId("view").textContent = "This browser draws no WebGL; all figures are below.";
    return null;
  }
})();
if (view) view.orbit.addEventListener("change", draw);

// A darker frame and the pips of a die on each face of a box, so that its rotation is seen. The box is a cube from −1 to
// 1, scaled by its half extents.
function addMarks(material) {
  material.onBeforeCompile = shader => {
    shader.vertexShader = "varying vec3 place; varying vec3 halfSize; varying vec3 side;\n" + shader.vertexShader.replace(
      "#include <begin_vertex>", `#include <begin_vertex>
      halfSize = vec3(length(modelMatrix[0].xyz), length(modelMatrix[1].xyz), length(modelMatrix[2].xyz));
      place = position * halfSize;
      side = normal;`);
    shader.fragmentShader = "varying vec3 place; varying vec3 halfSize; varying vec3 side;\n" + shader.fragmentShader.replace(
      "#include <color_fragment>", `#include <color_fragment>
      {
        vec3 which = step(0.5, abs(side));
        vec2 at = which.x > 0.5 ? place.yz : which.y > 0.5 ? place.zx : place.xy;
        vec2 reach = which.x > 0.5 ? halfSize.yz : which.y > 0.5 ? halfSize.zx : halfSize.xy;
        float first = which.x > 0.5 ? 1.0 : which.y > 0.5 ? 2.0 : 3.0;
        float pips = dot(side, which) > 0.0 ? first : 7.0 - first;
        float unit = min(reach.x, reach.y);
        vec2 beyond = abs(at) - (reach - 0.29 * unit);
        float panel = length(max(beyond, 0.0)) + min(max(beyond.x, beyond.y), 0.0) - 0.16 * unit;
        float gap = 0.44 * unit;
        float nearest = 1e9;
        if (mod(pips, 2.0) > 0.5) nearest = length(at);
        if (pips > 3.5) nearest = min(nearest, length(abs(at) - gap));
        else if (pips > 1.5) nearest = min(nearest, length((at.x + at.y < 0.0 ? -at : at) - gap));
        if (pips > 5.5) nearest = min(nearest, length(vec2(abs(at.x) - gap, at.y)));
        float pixel = max(length(fwidth(at)), 1e-6);
        vec3 ink = dot(diffuseColor.rgb, vec3(0.2126, 0.7152, 0.0722)) > 0.4 ? vec3(0.05) : vec3(0.86, 0.82, 0.72);
        diffuseColor.rgb *= mix(0.42, 1.0, clamp(0.5 - panel / pixel, 0.0, 1.0));
        diffuseColor.rgb = mix(diffuseColor.rgb, ink, clamp(0.5 - (nearest - 0.165 * unit) / pixel, 0.0, 1.0));
      }`);
  };
  material.extensions = { derivatives: true };
}

function light(scene, extent) {
  const middle = extent.getCenter(new THREE.Vector3());
  const radius = Math.max(extent.getSize(new THREE.Vector3()).length() / 2, 1e-6);
  scene.add(new THREE.HemisphereLight(0xdfe8f2, 0x8a8378, 0.6));
  const sun = new THREE.DirectionalLight(0xfff4e4, 0.65);
  sun.position.copy(middle).add(new THREE.Vector3(0.5, 1, 0.35).normalize().multiplyScalar(3 * radius));
  sun.target.position.copy(middle);
  sun.castShadow = true;
  sun.shadow.mapSize.set(2048, 2048);
  Object.assign(sun.shadow.camera, { left: -radius, right: radius, top: radius, bottom: -radius, near: radius, far: 5 * radius });
  sun.shadow.radius = 2;
  sun.shadow.bias = -1e-3;
  scene.add(sun, sun.target);
}

function sceneOf(gltf) {
  const marks = gltf.asset.extras?.marks !== false;
  const marked = new Set();
  const extent = new THREE.Box3();
  gltf.scene.updateMatrixWorld(true);
  gltf.scene.traverse(node => {
    if (node.isLine) node.material.color.set(0xd8d2c4);  // springs, rods, ropes: on a dark background
    if (!node.isMesh) return;
    const isBox = node.userData.mass !== undefined;
    node.castShadow = isBox;
    node.receiveShadow = true;
    node.frustumCulled = isBox;
    if (isBox) extent.expandByObject(node);
    // Those of several boxes have meshes in metres.
    if (marks && isBox && node.geometry.attributes.position.count === 24 && !marked.has(node.material)) {
      marked.add(node.material);
      addMarks(node.material);
    }
  });
  const all = extent.clone();
  gltf.scene.traverse(node => {
    if (node.isMesh && node.userData.mass === undefined && node.geometry.boundingBox === null) node.geometry.computeBoundingBox();
    if (node.isMesh && node.userData.mass === undefined) all.union(new THREE.Box3().setFromObject(node));
  });
  // Floors may be very wide.
  const near = extent.clone().expandByScalar(2 * extent.getSize(new THREE.Vector3()).length());
  const scene = new THREE.Scene();
  scene.background = new THREE.Color(0x20242a);
  scene.add(gltf.scene);
  light(scene, all.intersect(near));
  return { scene, middle: extent.getCenter(new THREE.Vector3()) };
}

async function loadFilm(bytes) {
  const gltf = await new Promise((done, fail) => new THREE.GLTFLoader().parse(bytes, "", done, fail));
  const { scene, middle } = sceneOf(gltf);
  const mixer = new THREE.AnimationMixer(gltf.scene);
  let action = null;
  if (gltf.animations.length > 0) {
    action = mixer.clipAction(gltf.animations[0]);
    action.setLoop(THREE.LoopOnce);
    action.clampWhenFinished = true;
    action.play();
  }
  const filming = gltf.cameras[0];
  const length = action ? action.getClip().duration : 0;
  return { scene, middle, filming, move: at => {
    if (!action) return;
    action.reset();
    action.time = Math.min(at, length * (1 - 1e-6));
    mixer.update(0);
  } };
}

// The film's own camera, which may move by itself.
function followCamera() {
  const { camera, orbit } = view;
  film.scene.updateMatrixWorld(true);
  film.filming.getWorldPosition(camera.position);
  const towards = film.filming.getWorldDirection(new THREE.Vector3());
  const distance = Math.max(film.middle.clone().sub(camera.position).dot(towards), film.filming.near);
  orbit.target.copy(camera.position).addScaledVector(towards, distance);
  camera.up.set(0, 1, 0);
  camera.fov = film.filming.fov;
  camera.near = film.filming.near / 10;
  camera.far = film.filming.far * 10;
  camera.updateProjectionMatrix();
  orbit.update();
}

function draw() {
  if (!view || !film) return;
  const { renderer, camera } = view;
  const { clientWidth: width, clientHeight: height } = byId("view");
  if (renderer.getSize(new THREE.Vector2()).x !== width || camera.aspect !== width / height) {
    renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    renderer.setSize(width, height, false);
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
  }
  renderer.render(film.scene, camera);
}
addEventListener("resize", draw);
byId("filmed").addEventListener("change", () => seek(time));
if (view) view.orbit.addEventListener("start", () => { byId("filmed").checked = false; });

// ---- Time.
let duration = 1;
let charts = () => {};
function seek(to) {
  time = Math.min(Math.max(to, 0), duration);
  byId("time").value = time;
  byId("clock").textContent = `${time.toFixed(speeds.indexOf(byId("speed").value) > 1 ? 5 : 3)} of ${shown(duration)} s`;
  byId("time").setAttribute("aria-valuetext", byId("clock").textContent);
  charts(time);
  if (!film) return;
  film.move(time);
  if (view && byId("filmed").checked) followCamera();
  draw();
}
function play(on) {
  playing = on;
  byId("play").textContent = on ? "Pause" : "Play";
  if (on && time >= duration) time = 0;
  let last = null;
  const step = now => {
    if (!playing) return;
    if (last !== null) seek(time + (now - last) / 1000 * Number(byId("speed").value));
    last = now;
    if (time >= duration) play(false);
    else requestAnimationFrame(step);
  };
  if (on) requestAnimationFrame(step);
}
byId("play").addEventListener("click", () => play(!playing));
byId("time").addEventListener("input", () => {
  play(false);
  seek(Number(byId("time").value));
});

// ---- Figures.
const rowsOf = text => text.trim().split("\n").map(line => line.split(","));
// Names may have commas and quotes in them.
function fieldsOf(line) {
  return [...line.matchAll(/(?:^|,)(?:"((?:[^"]|"")*)"|([^,]*))/g)].map(match => match[1]?.replace(/""/g, '"') ?? match[2]);
}

const kWidth = 1000;
const kHeight = 240;
const svg = (name, attributes) => {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  return element;
};
function chartEnergies(text) {
  const [names, ...rows] = rowsOf(text);
  const column = name => rows.map(row => Number(row[names.indexOf(name)]));
  const sum = list => list.map(column).reduce((all, values) => all.map((value, k) => value + values[k]));
  const times = column("time");
  const series = [
    { name: "translation", values: column("translation") }, { name: "rotation", values: column("rotation") },
    { name: "gravity", values: column("gravity") }, { name: "springs", values: sum(["springs", "joint_springs"]) },
    { name: "total", values: column("total") },
    { name: "lost", values: sum(["impacts", "joint_friction", "damping", "drag", "remaining"]) },
  ].map((each, k) => ({ ...each, color: `var(--c${k})` }))
    .filter(each => each.name === "total" || each.values.some(value => Math.abs(value) > 0));
  let low = 0;
  let high = 0;
  for (const each of series) {
    for (const value of each.values) {
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
  }
  if (!(high > low)) high = low + 1;
  const x = at => at / duration * kWidth;
  const y = value => kHeight - 12 - (value - low) / (high - low) * (kHeight - 24);
  const picture = svg("svg", { viewBox: `0 0 ${kWidth} ${kHeight}`, preserveAspectRatio: "none", role: "img",
                               "aria-label": series.map(each => each.name).join(", ") + " over time" });
  picture.append(svg("line", { x1: 0, x2: kWidth, y1: y(0), y2: y(0) }));
  for (const each of series) {
    const path = svg("path", { d: "M" + each.values.map((value, k) => `${x(times[k]).toFixed(1)},${y(value).toFixed(1)}`).join("L") });
    path.style.stroke = each.color;
    picture.append(path);
  }
  const now = svg("line", { class: "now", y1: 0, y2: kHeight });
  picture.append(now);
  const place = byId("energy");
  place.replaceChildren(picture);
  for (const [name, value] of [["high", high], ["low", low]]) {
    place.append(Object.assign(document.createElement("span"), { className: name, textContent: shown(Math.abs(value) > 1e-9 * (high - low) ? value.toPrecision(3) : 0) }));
  }
  byId("legend").replaceChildren();
  const labels = series.map(each => {
    const label = document.createElement("span");
    label.style.setProperty("--own", each.color);
    byId("legend").append(label);
    return label;
  });
  charts = at => {
    now.setAttribute("x1", x(at));
    now.setAttribute("x2", x(at));
    const next = times.findIndex(each => each > at);
    const row = next < 0 ? times.length - 1 : Math.max(0, next - 1);
    series.forEach((each, k) => { labels[k].textContent = `${each.name} ${shown(each.values[row])}`; });
  };
}
const goTo = event => {
  const box = byId("energy").getBoundingClientRect();
  play(false);
  seek((event.clientX - box.left) / box.width * duration);
};
byId("energy").addEventListener("pointerdown", goTo);
byId("energy").addEventListener("pointermove", event => { if (event.buttons) goTo(event); });

const kRows = 200;
let impacts = [];
let listed = [];
let rows = kRows;
function list() {
  const of = byId("of").value;
  listed = impacts.filter(impact => !of || impact[1] === of || impact[2] === of);
  byId("impacts").replaceChildren();
  for (const impact of listed.slice(0, rows)) {
    const row = byId("impacts").insertRow();
    const button = Object.assign(document.createElement("button"), { type: "button", textContent: shown(impact[0]) });
    button.addEventListener("click", () => {
      play(false);
      seek(impact[0]);
    });
    row.insertCell().append(button);
    for (const text of [impact[1], impact[2], ...impact.slice(3).map(shown)]) row.insertCell().textContent = text;
  }
  byId("more").hidden = listed.length <= rows;
  byId("impacts-note").textContent = impacts.length === 0 ? "There are none." :
    `${listed.length} of ${impacts.length}. A time leads to its moment.`;
}
byId("of").addEventListener("change", () => {
  rows = kRows;
  list();
});
byId("more").addEventListener("click", () => {
  rows += kRows;
  list();
});
function tabulateImpacts(text) {
  const [names, ...all] = text.trim().split("\n").map(fieldsOf);
  const wanted = ["time", "a", "b", "approach", "impulse", "tangential"].map(name => names.indexOf(name));
  impacts = all.map(row => wanted.map((at, k) => k === 1 || k === 2 ? row[at] : Number(row[at])));
  const bodies = [...new Set(impacts.flatMap(impact => [impact[1], impact[2]]))].sort();
  byId("of").replaceChildren(new Option("all", ""), ...bodies.map(name => new Option(name, name)));
  rows = kRows;
  list();
}
function toImpact(by) {
  const least = 1e-9;
  const wanted = by > 0 ? listed.find(impact => impact[0] > time + least) : listed.findLast(impact => impact[0] < time - least);
  if (wanted) {
    play(false);
    seek(wanted[0]);
  }
}
byId("back").addEventListener("click", () => toImpact(-1));
byId("next").addEventListener("click", () => toImpact(1));

function offer(id, name, content) {
  const link = byId(id);
  if (link.href) URL.revokeObjectURL(link.href);
  link.href = URL.createObjectURL(new Blob([content]));
  link.download = name;
}

async function show(run) {
  play(false);
  const { report } = run;
  const stem = run.name.replace(/\.[^.]*$/, "");
  document.title = `${report.scene} – careen`;
  duration = report.simulated_seconds;
  byId("show").hidden = byId("figures").hidden = false;
  byId("time").max = duration;
  byId("facts").textContent = `${report.scene}: ${report.life.length === 1 ? "1 box" : report.life.length + " boxes"}, ` +
    `${shown(duration)} s by ${report.method}, ${report.impacts} impacts; simulated in ${run.seconds.toPrecision(2)} s; ` +
    `state hash ${report.state_hash}; shown within ${shown(run.within * 1000)} mm of the run`;
  byId("info").textContent = run.info.join("\n");
  byId("audit").textContent = [...run.notes, ...run.audit].join("\n");
  tabulateImpacts(run.impacts);
  chartEnergies(run.energy);
  offer("run-file", stem + ".careen", run.run);
  offer("glb-file", stem + ".glb", run.film);
  offer("impacts-file", stem + "-impacts.csv", run.impacts);
  offer("energy-file", stem + "-energy.csv", run.energy);
  film = null;
  if (view) {
    film = await loadFilm(run.film.buffer);
    film.move(0);
    followCamera();
    byId("filmed").checked = true;
  }
  ++films;
  seek(0);
}

document.addEventListener("keydown", event => {
  const { tagName, type } = event.target;
  if (event.ctrlKey || event.altKey || event.metaKey || !film || tagName === "TEXTAREA" || tagName === "SELECT") return;
  if (event.key === " " && (tagName === "BUTTON" || tagName === "SUMMARY" || type === "checkbox")) return;
  const step = Number(byId("speed").value) / 60;
  const act = {
    " ": () => play(!playing), ArrowLeft: () => toImpact(-1), ArrowRight: () => toImpact(1), Home: () => seek(0),
    End: () => seek(duration), ",": () => seek(time - step), ".": () => seek(time + step),
  }[event.key] ?? (speeds[event.key - 1] && (() => { byId("speed").value = speeds[event.key - 1]; }));
  if (act && !(type === "range" && event.key.startsWith("Arrow") && event.target !== byId("time"))) {
    act();
    event.preventDefault();
  }
});

openLink();
