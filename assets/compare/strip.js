// Draws charts and makes them sliders for pointer and keys.

const kSvg = "http://www.w3.org/2000/svg";

function svg(name, attributes, text) {
  const element = document.createElementNS(kSvg, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  if (text !== undefined) element.textContent = text;
  return element;
}

function html(name, attributes, ...children) {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.append(...children);
  return element;
}

// In report.json numbers that are not finite are strings, and what was not measured is null.
const numeric = (value) => (value === null ? NaN : Number(value));

function brief(value) {
  if (Number.isNaN(value)) return "–";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  if (value === 0) return "0";
  const size = Math.abs(value);
  const text = size >= 1e-3 && size < 1e5 ? String(Number(value.toPrecision(4))) : value.toExponential(2);
  return text.replace("-", "−").replace("e−", "e-").replace("e+", "e");
}

// Maps values to fractions of a strip's height, logarithmically if they span a wide range; 0 stays at the bottom.
function scaleOf(values) {
  const positive = values.filter((value) => value > 0 && Number.isFinite(value));
  const most = positive.reduce((a, b) => Math.max(a, b), 0);
  const least = positive.reduce((a, b) => Math.min(a, b), most);
  if (most === 0) return { most, logarithmic: false, share: () => 0 };
  if (most / least < 30) return { most, logarithmic: false, share: (value) => Math.min(1, value / most) };
  const floor = Math.max(least, most * 1e-6);
  const share = (value) =>
    value <= 0 ? 0 : Math.min(1, 0.08 + 0.92 * Math.max(0, Math.log(value / floor) / Math.log(most / floor)));
  return { most, logarithmic: true, share };
}

// Makes an element with role=slider choose one of `count` items, by the pointer's fraction of its width without the
// inset, or by keys.
function makeSlider(element, count, inset, choose, chosen) {
  element.setAttribute("aria-valuemin", "0");
  element.setAttribute("aria-valuemax", String(count - 1));
  const clamp = (index) => Math.max(0, Math.min(count - 1, index));
  const pick = (event) => {
    const box = element.querySelector("svg").getBoundingClientRect();
    const share = (event.clientX - box.left - inset.left) / (box.width - inset.left - inset.right);
    choose(clamp(Math.floor(share * count)));
  };
  element.addEventListener("pointerdown", (event) => {
    element.setPointerCapture(event.pointerId);
    pick(event);
  });
  element.addEventListener("pointermove", (event) => {
    if (event.buttons & 1) pick(event);
  });
  const far = Math.max(1, Math.round(count / 20));
  const steps = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1, PageDown: -far, PageUp: far, Home: -count, End: count };
  element.addEventListener("keydown", (event) => {
    if (!(event.key in steps) || event.ctrlKey || event.altKey || event.metaKey || event.shiftKey) return;
    choose(clamp(chosen() + steps[event.key]));
    event.preventDefault();
    event.stopPropagation();
  });
}

// Draws now, and whenever the width of the element changes.
function drawAtItsWidth(element, draw) {
  let width = 0;
  new ResizeObserver(() => {
    const now = Math.floor(element.clientWidth - 2 * parseFloat(getComputedStyle(element).paddingLeft));
    if (now > 0 && now !== width) {
      width = now;
      requestAnimationFrame(() => draw(width)); // the drawing gives the element its height
    }
  }).observe(element);
}
