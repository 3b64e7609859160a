// The pictures of a frame: side by side, wiped or blinked, with a common zoom.

const kBlink = 500; // [ms] one flash a second, far below the harmful rate
const kMostZoom = 64;

function Viewer() {
  const views = [...document.querySelectorAll(".view")];
  const one = views.find((view) => view.dataset.shows === "both");
  const still = matchMedia("(prefers-reduced-motion: reduce)");
  let shown = null;
  let mode = "side";
  let marked = true;
  let zoom = null; // CSS pixels per pixel of the picture; null: fit the whole picture
  let center = { x: 0, y: 0 }; // [px] point of the picture at the centre of a view
  let blinkShows = "expected";
  let timer = 0;
  const wipe = document.querySelector("#wipe input");

  const visible = () => views.filter((view) => view.offsetParent !== null);
  const fit = (view) => Math.min(view.clientWidth / shown.width, view.clientHeight / shown.height) || 1;
  const zoomOf = (view) => zoom ?? fit(view);

  function cross() {
    const mark = svg("svg", { class: "cross", viewBox: "0 0 61 61", "aria-hidden": "true" });
    const lines = "M30.5 0v20M30.5 41v20M0 30.5h20M41 30.5h20M20.5 30.5a10 10 0 1 0 20 0a10 10 0 1 0 -20 0";
    mark.append(svg("path", { d: lines }), svg("path", { d: lines }));
    return mark;
  }

  function image(which) {
    return html("img", { src: shown[which], alt: "", draggable: "false", "data-which": which });
  }

  function fill(view) {
    const which = view.dataset.shows === "both" ? ["actual", "expected"] : [view.dataset.shows];
    const there = which.filter((name) => shown[name]);
    view.replaceChildren(...there.map(image));
    view.style.aspectRatio = `${shown.width} / ${shown.height}`;
    if (there.length < which.length)
      view.append(html("span", { class: "absent" }, which.length > 1 ? "one of the two is missing" : "missing, or not comparable"));
    if (shown.ignored) view.append(html("img", { src: shown.ignored, alt: "", draggable: "false", class: "ignored" }));
    if (view.dataset.shows === "both") view.append(html("span", { class: "edge" }));
    if (shown.pixel) view.append(cross());
    view.setAttribute("aria-label", `${view.dataset.shows === "both" ? "expected and actual" : view.dataset.shows} picture of ${shown.name}`);
  }

  // Offset of the picture's upper left corner from the view's [CSS px].
  function cornerOf(view) {
    const z = zoomOf(view);
    return { x: view.clientWidth / 2 - center.x * z, y: view.clientHeight / 2 - center.y * z };
  }

  function arrange() {
    if (!shown) return;
    if (zoom === null) center = { x: shown.width / 2, y: shown.height / 2 };
    for (const view of visible()) {
      const z = zoomOf(view);
      const corner = cornerOf(view);
      view.classList.toggle("close", zoom !== null);
      for (const picture of view.querySelectorAll("img")) {
        picture.style.transform = `translate(${corner.x}px, ${corner.y}px) scale(${z})`;
        if (picture.className.includes("ignored")) picture.style.display = marked ? "" : "none";
        picture.classList.toggle("crisp", z * devicePixelRatio > 1);
      }
      const mark = view.querySelector(".cross");
      if (mark) {
        mark.style.transform = `translate(${corner.x + (shown.pixel.x + 0.5) * z}px, ${corner.y + (shown.pixel.y + 0.5) * z}px)`;
        mark.style.display = marked ? "" : "none";
      }
    }
    uncover();
    const view = visible()[0];
    if (view) document.getElementById("zoom").textContent = `${Math.round(100 * zoomOf(view))} %`;
  }

  // In the single view: which of the two pictures is visible where.
  function uncover() {
    const expected = one.querySelector("[data-which=expected]");
    const edge = one.querySelector(".edge");
    const share = wipe.value / 1000;
    if (edge) {
      edge.style.display = mode === "wipe" ? "" : "none";
      edge.style.left = `${share * 100}%`;
    }
    if (expected) {
      const corner = cornerOf(one);
      const right = (share * one.clientWidth - corner.x) / zoomOf(one); // [px] of the picture
      const width = expected.naturalWidth || shown.width; // less than shown.width if the actual one is wider
      expected.style.clipPath = mode === "wipe" ? `inset(0 ${Math.max(0, width - right)}px 0 0)` : "";
      expected.style.visibility = mode === "blink" && blinkShows === "actual" ? "hidden" : "";
    }
    document.getElementById("one-caption").textContent =
      mode === "blink" ? `${blinkShows}${timer ? "" : " – Space blinks by hand"}` : "expected left of the edge, actual right of it";
  }

  function blinkOnce() {
    blinkShows = blinkShows === "expected" ? "actual" : "expected";
    uncover();
  }

  function stopTimer() {
    clearInterval(timer);
    timer = 0;
  }

  function setMode(next) {
    mode = next;
    stopTimer();
    blinkShows = "expected";
    if (mode === "blink" && !still.matches) timer = setInterval(blinkOnce, kBlink);
    document.getElementById("side").hidden = mode !== "side";
    document.getElementById("one").hidden = mode === "side";
    document.getElementById("wipe").hidden = mode !== "wipe";
    for (const button of document.querySelectorAll("[data-mode]"))
      button.setAttribute("aria-pressed", String(button.dataset.mode === mode));
    arrange();
  }

  function zoomBy(factor, view = visible()[0], at = null) {
    if (!shown || !view) return;
    const before = zoomOf(view);
    const least = fit(view);
    const after = Math.min(kMostZoom, before * factor);
    if (after <= least * 1.001) {
      zoom = null;
    } else {
      // The point under the pointer stays fixed.
      const off = at ?? { x: 0, y: 0 };
      center = { x: center.x + off.x / before - off.x / after, y: center.y + off.y / before - off.y / after };
      zoom = after;
    }
    keepInside();
    arrange();
  }

  function keepInside() {
    center.x = Math.max(0, Math.min(shown.width, center.x));
    center.y = Math.max(0, Math.min(shown.height, center.y));
  }

  function moveBy(x, y) {
    if (!shown || zoom === null) return;
    center = { x: center.x + x / zoom, y: center.y + y / zoom };
    keepInside();
    arrange();
  }

  function toWorstPixel() {
    if (!shown?.pixel) return;
    center = { x: shown.pixel.x + 0.5, y: shown.pixel.y + 0.5 };
    zoom = Math.max(8, 2 * fit(visible()[0]));
    arrange();
  }

  // Values under the pointer, as the browser decodes them: 8 bits.
  const samples = new Map();
  function sampleAt(which, x, y) {
    if (!samples.has(which)) {
      const picture = document.querySelector(`.view img[data-which=${which}]`);
      if (!picture?.complete || !picture.naturalWidth) return null;
      const canvas = new OffscreenCanvas(picture.naturalWidth, picture.naturalHeight);
      const context = canvas.getContext("2d", { willReadFrequently: true });
      context.drawImage(picture, 0, 0);
      samples.set(which, context);
    }
    return [...samples.get(which).getImageData(x, y, 1, 1).data.slice(0, 3)];
  }

  function readUnder(view, event) {
    const box = view.getBoundingClientRect();
    const corner = cornerOf(view);
    const x = Math.floor((event.clientX - box.left - corner.x) / zoomOf(view));
    const y = Math.floor((event.clientY - box.top - corner.y) / zoomOf(view));
    const inside = shown && x >= 0 && y >= 0 && x < shown.width && y < shown.height;
    const expected = inside && shown.expected ? sampleAt("expected", x, y) : null;
    const actual = inside && shown.actual ? sampleAt("actual", x, y) : null;
    const text = !inside ? "\u00a0" : `Under the pointer (${x}, ${y}): expected ${expected?.join(" ") ?? "–"}, actual ${actual?.join(" ") ?? "–"}`;
    document.getElementById("under").textContent = text;
  }

  for (const view of views) {
    view.addEventListener("wheel", (event) => {
      if (!shown || (zoom === null && event.deltaY > 0)) return; // the page scrolls on
      event.preventDefault();
      const box = view.getBoundingClientRect();
      zoomBy(Math.exp(-event.deltaY * 0.002), view,
        { x: event.clientX - box.left - box.width / 2, y: event.clientY - box.top - box.height / 2 });
    }, { passive: false });
    view.addEventListener("pointerdown", (event) => {
      if (zoom === null) return;
      view.setPointerCapture(event.pointerId);
      view.classList.add("dragging");
    });
    view.addEventListener("pointermove", (event) => {
      if (view.classList.contains("dragging")) moveBy(-event.movementX, -event.movementY);
      readUnder(view, event);
    });
    for (const end of ["pointerup", "pointercancel"]) view.addEventListener(end, () => view.classList.remove("dragging"));
    view.addEventListener("dblclick", () => (zoom === null ? zoomBy(4, view) : api.fit()));
    new ResizeObserver(arrange).observe(view);
  }
  wipe.addEventListener("input", uncover);

  const api = {
    show(picture) {
      const otherSize = !shown || picture.width !== shown.width || picture.height !== shown.height;
      shown = picture;
      samples.clear();
      if (otherSize) zoom = null;
      document.getElementById("difference-caption").textContent = shown.factor ? `difference × ${shown.factor}` : "difference";
      views.forEach(fill);
      arrange();
    },
    mode: () => mode,
    setMode,
    blinkByHand() {
      if (mode !== "blink") return;
      stopTimer();
      blinkOnce();
    },
    wipeBy(share) {
      wipe.value = Number(wipe.value) + share * 1000;
      uncover();
    },
    zoomBy,
    moveBy,
    toWorstPixel,
    fit() {
      zoom = null;
      arrange();
    },
    mark(wanted) {
      marked = wanted ?? !marked;
      document.querySelector("[data-act=cross]").setAttribute("aria-pressed", String(marked));
      arrange();
    },
  };
  return api;
}
