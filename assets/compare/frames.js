// The strip chart of all frames, one strip per measure.

const kInset = 8;
const kMarks = 24;
const kUnderMarks = 12;
const kStrip = 42;
const kLabel = 18;

function measuresOf(report) {
  const tolerance = report.tolerance;
  const all = [
    { name: "largest difference of a channel [1/255]", of: (frame) => 255 * numeric(frame.largest), limit: 255 * numeric(tolerance.fail) },
    {
      name: tolerance.excuse_edges ? "pixels beyond the tolerance, including those at edges [%]" : "pixels beyond the tolerance [%]",
      of: (frame) => numeric(frame.failing_percent),
      limit: tolerance.excuse_edges ? NaN : numeric(tolerance.fail_percent),
    },
    { name: "pixels with a visibly different colour [%]", of: (frame) => numeric(frame.changed_percent), limit: numeric(tolerance.changed_percent) },
    { name: "1 − SSIM", of: (frame) => 1 - numeric(frame.ssim), limit: 1 - numeric(tolerance.least_ssim) },
    { name: "ꟻLIP", of: (frame) => numeric(frame.flip), limit: NaN },
  ];
  const telling = all.filter((measure) => report.frames.some((frame) => measure.of(frame) > 0));
  return telling.length > 0 ? telling : all.slice(0, 1);
}

// The maximum of each pixel column, so that no outlier is lost if there are more frames than pixels.
function columnsOf(values, width) {
  const columns = Math.min(values.length, Math.max(1, Math.floor(width)));
  const largest = new Array(columns).fill(0);
  values.forEach((value, i) => {
    const column = Math.floor((i * columns) / values.length);
    if (value > largest[column]) largest[column] = value;
  });
  return largest;
}

function barsPath(values, scale, width, base) {
  const columns = columnsOf(values, width);
  const step = width / columns.length;
  const gap = step > 4 ? 1 : 0;
  let path = "";
  columns.forEach((value, i) => {
    const height = scale.share(value) * (kStrip - 4);
    if (height > 0) path += `M${(kInset + i * step).toFixed(2)} ${base}v${-height.toFixed(2)}h${(step - gap).toFixed(2)}V${base}z`;
  });
  return path;
}

function FramesChart(report, pictures, onChoose) {
  const element = document.getElementById("frames-chart");
  const frames = report.frames;
  const measures = measuresOf(report).map((measure) => {
    const values = frames.map(measure.of);
    return { ...measure, values, scale: scaleOf(values) };
  });
  let chosen = 0;
  let line = null;
  let heads = [];
  let inner = 0;
  const middle = (index) => kInset + ((index + 0.5) * inner) / frames.length;

  function drawMarks(drawing) {
    const place = (index) => Math.max(kInset, Math.min(kInset + inner - 2, middle(index) - Math.max(1, inner / frames.length / 2)));
    const wide = Math.max(2, inner / frames.length - (inner / frames.length > 4 ? 1 : 0));
    frames.forEach((frame, i) => {
      if (frame.verdict !== "same")
        drawing.append(svg("rect", { class: frame.verdict, x: place(i), y: kMarks - 8, width: wide, height: 5 }));
      if (!frame.measured)
        drawing.append(svg("rect", { class: "unmeasured", x: place(i), y: kMarks + kUnderMarks, width: wide, height: measures.length * (kStrip + kLabel) }));
      if (frame.name in pictures) drawing.append(svg("circle", { class: "has-picture", cx: middle(i), cy: kMarks + 4, r: 2.6 }));
    });
    const indexOf = (name) => frames.findIndex((frame) => frame.name === name);
    const named = [["first", indexOf(report.first_different)], ["worst", indexOf(report.worst)]].filter(([, index]) => index >= 0);
    const sameOne = named.length === 2 && named[0][1] === named[1][1];
    if (sameOne) named.splice(0, 2, ["first and worst", named[0][1]]);
    const near = named.length === 2 && Math.abs(middle(named[0][1]) - middle(named[1][1])) < 60;
    named.forEach(([label, index], i) => {
      const atEnd = middle(index) > inner - 60;
      const left = near ? (middle(index) <= middle(named[1 - i][1])) && middle(index) > 60 : atEnd;
      drawing.append(svg("text", { class: "mark-label", x: middle(index) + (left ? -1 : 1), y: 12, "text-anchor": left ? "end" : "start" },
        left ? `${label} ▾` : `▾ ${label}`));
    });
  }

  function drawStrip(drawing, measure, top) {
    const base = top + kLabel + kStrip;
    heads.push(drawing.appendChild(svg("text", { x: kInset, y: top + 13 })));
    drawing.append(svg("line", { class: "rule", x1: kInset, x2: kInset + inner, y1: base, y2: base }));
    drawing.append(svg("path", { class: "bars", d: barsPath(measure.values, measure.scale, inner, base) }));
    const allowed = measure.limit > 0 && measure.limit < 100 && measure.limit !== 2 ? `allowed ${brief(measure.limit)}, ` : "";
    const largest = `${allowed}up to ${brief(measure.scale.most)}${measure.scale.logarithmic ? ", logarithmic" : ""}`;
    drawing.append(svg("text", { class: "soft", x: kInset + inner, y: top + 13, "text-anchor": "end" }, largest));
    if (measure.limit > 0 && measure.limit < measure.scale.most) {
      const y = base - measure.scale.share(measure.limit) * (kStrip - 4);
      drawing.append(svg("line", { class: "limit", x1: kInset, x2: kInset + inner, y1: y, y2: y }));
    }
  }

  function draw(width) {
    inner = width - 2 * kInset;
    const height = kMarks + kUnderMarks + measures.length * (kStrip + kLabel) + 22;
    const drawing = svg("svg", { viewBox: `0 0 ${width} ${height}`, height, "aria-hidden": "true" });
    heads = [];
    drawMarks(drawing);
    measures.forEach((measure, i) => drawStrip(drawing, measure, kMarks + kUnderMarks + i * (kStrip + kLabel)));
    drawing.append(svg("text", { class: "soft", x: kInset, y: height - 4 }, frames[0].name));
    drawing.append(svg("text", { class: "soft", x: kInset + inner, y: height - 4, "text-anchor": "end" }, frames[frames.length - 1].name));
    line = drawing.appendChild(svg("line", { class: "chosen", y1: 16, y2: height - 18 }));
    element.replaceChildren(drawing);
    show(chosen);
  }

  function show(index) {
    chosen = index;
    const frame = frames[index];
    element.setAttribute("aria-valuenow", String(index));
    element.setAttribute("aria-valuetext", `${frame.name}, ${frame.verdict}`);
    if (!line) return;
    line.setAttribute("x1", middle(index));
    line.setAttribute("x2", middle(index));
    heads.forEach((head, i) => { head.textContent = `${measures[i].name}: ${brief(measures[i].values[index])}`; });
  }

  makeSlider(element, frames.length, { left: kInset, right: kInset }, onChoose, () => chosen);
  drawAtItsWidth(element, draw);
  return { show };
}

// A table of all frames that differ, for readers who prefer text.
function listFrames(report, onChoose) {
  const kMost = 500;
  const found = report.frames.map((frame, index) => ({ frame, index })).filter(({ frame }) => frame.verdict !== "same");
  const rows = found.slice(0, kMost).map(({ frame, index }) => {
    const button = html("button", { type: "button", class: "link" }, frame.name);
    button.addEventListener("click", () => {
      onChoose(index);
      document.getElementById("frame").scrollIntoView();
    });
    const numbers = ["largest", "mean", "psnr", "ssim", "failing_percent", "changed_percent", "flip"];
    return html("tr", {}, html("th", { scope: "row" }, button), html("td", { class: frame.verdict }, frame.verdict),
      ...numbers.map((key) => html("td", { class: "number" }, brief(numeric(frame[key])))), html("td", {}, frame.reasons.join("; ")));
  });
  if (rows.length === 0) return;
  const heads = ["frame", "verdict", "largest", "mean", "PSNR [dB]", "SSIM", "beyond [%]", "other colour [%]", "ꟻLIP", "why"];
  document.getElementById("list-table").append(
    html("thead", {}, html("tr", {}, ...heads.map((head) => html("th", { scope: "col" }, head)))), html("tbody", {}, ...rows));
  document.getElementById("list-summary").textContent =
    `Frames that differ: ${found.length}` + (found.length > kMost ? `; the first ${kMost} are listed` : "");
  document.getElementById("list").hidden = false;
}
