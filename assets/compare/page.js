// Assembles the page from its two data blocks and handles the keys.

function showFrames(report, pictures) {
  const frames = report.frames;
  const viewer = Viewer();
  const withPictures = frames.map((frame, index) => (frame.name in pictures ? index : -1)).filter((index) => index >= 0);
  const indexOf = (name) => frames.findIndex((frame) => frame.name === name);
  let chosen = 0;
  const chart = frames.length > 1 ? FramesChart(report, pictures, choose) : null;

  function swatch(samples, full) {
    const span = html("span", { class: "swatch" });
    span.style.background = `rgb(${samples.slice(0, 3).map((sample) => Math.round((sample * 255) / full)).join(" ")})`;
    return span;
  }

  function tellPixel(pixel) {
    const place = document.getElementById("pixel");
    place.replaceChildren();
    if (!pixel) return;
    const off = pixel.actual.map((sample, i) => sample - (pixel.expected[i] ?? pixel.full));
    place.append(`Worst pixel (${pixel.x}, ${pixel.y}): expected `, swatch(pixel.expected, pixel.full), pixel.expected.join(" "), ", actual ",
      swatch(pixel.actual, pixel.full), pixel.actual.join(" "), `, off by ${off.map((value) => (value > 0 ? `+${value}` : String(value).replace("-", "−"))).join(" ")} of ${pixel.full}`);
  }

  function tellNumbers(frame) {
    const rows = [["largest", "largest difference of a channel [of 1]"], ["mean", "mean difference"], ["psnr", "PSNR [dB]"], ["ssim", "SSIM"],
      ["worst_ssim", "SSIM of the worst window"], ["failing_percent", "pixels beyond the tolerance [%]"],
      ["changed_percent", "pixels with a visibly different colour [%]"], ["edge_percent", "likewise, but explained by edges [%]"], ["flip", "ꟻLIP"]];
    const list = document.getElementById("frame-numbers");
    list.replaceChildren(...rows.filter(([key]) => frame[key] !== null).map(([key, name]) =>
      html("div", {}, html("dt", {}, name), html("dd", {}, brief(numeric(frame[key]))))));
  }

  function tellNoPictures(frame, nearest) {
    const notice = document.getElementById("no-pictures");
    const button = html("button", { type: "button", class: "link" }, frames[nearest]?.name ?? "");
    button.addEventListener("click", () => choose(nearest));
    notice.replaceChildren(frame.identical ? "Both files are the same, byte for byte." : "This page has the pictures of a few frames only, and this frame is not one of them.",
      " Nearest frame with pictures: ", button, ".");
  }

  function choose(index) {
    chosen = index;
    const frame = frames[index];
    const picture = Object.hasOwn(pictures, frame.name) ? pictures[frame.name] : null;
    document.getElementById("frame-name").textContent = frames.length > 1 ? `${frame.name}, ${index + 1} of ${frames.length}` : frame.name;
    const verdict = document.getElementById("frame-verdict");
    verdict.className = frame.verdict;
    verdict.textContent = frame.identical ? "same file" : [frame.verdict, frame.reasons.join("; ")].filter(Boolean).join(": ");
    document.getElementById("panes").hidden = !picture;
    document.getElementById("no-pictures").hidden = Boolean(picture);
    if (picture) {
      viewer.show({ name: frame.name, ...picture });
    } else {
      const nearest = withPictures.reduce((best, other) => (Math.abs(other - index) < Math.abs(best - index) ? other : best), withPictures[0]);
      tellNoPictures(frame, nearest);
    }
    tellPixel(picture?.pixel);
    tellNumbers(frame);
    chart?.show(index);
    remember();
  }

  // The address contains what is shown, so that it can be shared.
  function remember() {
    const parts = new URLSearchParams({ frame: frames[chosen].name });
    if (viewer.mode() !== "side") parts.set("mode", viewer.mode());
    history.replaceState(null, "", `#${parts}`);
  }

  function recall() {
    const parts = new URLSearchParams(location.hash.slice(1));
    const mode = parts.get("mode");
    if (["side", "wipe", "blink"].includes(mode)) viewer.setMode(mode);
    const index = indexOf(parts.get("frame"));
    choose(index >= 0 ? index : Math.max(0, indexOf(report.first_different), withPictures.length && !report.first_different ? withPictures[0] : 0));
  }

  function setMode(mode) {
    viewer.setMode(mode);
    remember();
  }

  const step = (by) => choose(Math.max(0, Math.min(frames.length - 1, chosen + by)));
  const goTo = (name) => name !== null && choose(indexOf(name));
  const nextWith = (direction) => {
    const found = direction > 0 ? withPictures.find((index) => index > chosen) : withPictures.findLast((index) => index < chosen);
    if (found !== undefined) choose(found);
  };
  const blink = () => (viewer.mode() === "blink" ? setMode("side") : setMode("blink"));
  const acts = {
    in: () => viewer.zoomBy(1.5), out: () => viewer.zoomBy(1 / 1.5), fit: () => viewer.fit(), "worst-pixel": () => viewer.toWorstPixel(),
    cross: () => viewer.mark(), first: () => goTo(report.first_different), worst: () => goTo(report.worst),
    previous: () => nextWith(-1), next: () => nextWith(1), help: () => document.getElementById("help").showModal(),
  };
  const keys = {
    ArrowLeft: () => step(-1), ArrowRight: () => step(1), p: acts.previous, n: acts.next, f: acts.first, w: acts.worst,
    1: () => setMode("side"), 2: () => setMode("wipe"), b: blink, " ": () => viewer.blinkByHand(), ",": () => viewer.wipeBy(-0.02), ".": () => viewer.wipeBy(0.02),
    "+": acts.in, "=": acts.in, "-": acts.out, 0: acts.fit, x: acts["worst-pixel"], c: acts.cross, "?": acts.help,
  };
  const moves = { ArrowLeft: [-40, 0], ArrowRight: [40, 0], ArrowUp: [0, -40], ArrowDown: [0, 40] };

  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || document.getElementById("help").open) return;
    const onControl = event.target.closest("input, button, summary, a");
    if (onControl && (event.key === " " || (event.key.startsWith("Arrow") && onControl.matches("input")))) return;
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    if (event.shiftKey && key in moves) viewer.moveBy(...moves[key]);
    else if (Object.hasOwn(keys, key) && !(key === " " && viewer.mode() !== "blink")) keys[key]();
    else return;
    event.preventDefault();
  });
  document.querySelectorAll("[data-act]").forEach((button) => button.addEventListener("click", acts[button.dataset.act]));
  document.querySelectorAll("[data-mode]").forEach((button) =>
    button.addEventListener("click", () => setMode(button.dataset.mode === viewer.mode() ? "side" : button.dataset.mode)));
  addEventListener("hashchange", recall);

  document.getElementById("strip").hidden = frames.length < 2;
  document.getElementById("frame").hidden = false;
  listFrames(report, choose);
  recall();
}

{
  const read = (id) => JSON.parse(document.getElementById(id).textContent);
  const report = read("report");
  if (document.body.dataset.equal !== "true") {
    if (report.run === null) {
      showFrames(report, read("pictures"));
    } else if (report.run.growth.length > 0) {
      document.getElementById("run").hidden = false;
      GrowthChart(report.run);
    }
  }
}
