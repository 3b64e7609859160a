// The difference of two runs over time on a logarithmic scale, up to the horizon and beyond.

function GrowthChart(run) {
  const element = document.getElementById("growth-chart");
  const samples = run.growth.map((sample) => ({ ...sample, relative: numeric(sample.relative) }));
  const end = samples[samples.length - 1].time;
  const kHeight = 300;
  const kLeft = 58;
  const kTop = 24;
  const kBottom = 26;
  const kHorizon = 0.01;
  const positive = samples.map((sample) => sample.relative).filter((value) => value > 0 && Number.isFinite(value));
  const low = Math.floor(Math.log10(Math.min(...positive, 1e-3)));
  const high = Math.max(0, Math.ceil(Math.log10(Math.max(...positive, kHorizon))));
  let chosen = 0;
  let inner = 0;
  let line = null;
  let dot = null;
  const xOf = (time) => kLeft + (inner * time) / (end || 1);
  const yOf = (value) => kTop + ((high - Math.log10(value)) / (high - low)) * (kHeight - kTop - kBottom);

  function drawAxes(drawing) {
    const every = Math.ceil((high - low) / 8);
    for (let exponent = Math.floor(high / every) * every; exponent >= low; exponent -= every) {
      const y = yOf(10 ** exponent);
      drawing.append(svg("line", { class: "rule", x1: kLeft, x2: kLeft + inner, y1: y, y2: y }));
      drawing.append(svg("text", { class: "soft", x: kLeft - 8, y: y + 4, "text-anchor": "end" }, exponent === 0 ? "1" : `1e${exponent}`));
    }
    const step = niceStep(end / Math.max(2, inner / 110));
    for (let k = 0; k * step <= end * 1.0001; ++k) {
      const time = k * step;
      const last = (k + 1) * step > end * 1.0001;
      drawing.append(svg("text", { class: "soft", x: xOf(time), y: kHeight - 6, "text-anchor": last ? "end" : "middle" }, `${Number(time.toPrecision(6))} s`));
    }
  }

  function niceStep(least) {
    const power = 10 ** Math.floor(Math.log10(least || 1));
    return [1, 2, 5, 10].map((factor) => factor * power).find((step) => step >= least) ?? power * 10;
  }

  // A logarithmic axis has no zero: the curve is interrupted where nothing differs.
  function curve() {
    let path = "";
    let pen = false;
    for (const sample of samples) {
      if (sample.relative > 0 && Number.isFinite(sample.relative)) {
        path += `${pen ? "L" : "M"}${xOf(sample.time).toFixed(2)} ${yOf(sample.relative).toFixed(2)}`;
        pen = true;
      } else {
        pen = false;
      }
    }
    return path;
  }

  function mark(drawing, time, label, y) {
    const x = xOf(time);
    const atEnd = x > kLeft + inner * 0.7;
    drawing.append(svg("line", { class: "mark", x1: x, x2: x, y1: Math.min(y - 10, kTop), y2: kHeight - kBottom }));
    drawing.append(svg("text", { class: "mark-label", x: x + (atEnd ? -5 : 5), y, "text-anchor": atEnd ? "end" : "start" }, label));
  }

  function draw(width) {
    inner = width - kLeft - kInset;
    const drawing = svg("svg", { viewBox: `0 0 ${width} ${kHeight}`, height: kHeight, "aria-hidden": "true" });
    if (run.horizon !== null)
      drawing.append(svg("rect", { class: "beyond", x: xOf(run.horizon), y: kTop, width: Math.max(0, kLeft + inner - xOf(run.horizon)), height: kHeight - kTop - kBottom }));
    drawAxes(drawing);
    const y = yOf(kHorizon);
    drawing.append(svg("line", { class: "limit", x1: kLeft, x2: kLeft + inner, y1: y, y2: y }));
    drawing.append(svg("path", { class: "curve", d: curve() }));
    if (run.horizon !== null) mark(drawing, run.horizon, run.growth_per_impact === null ? "horizon" : "horizon: beyond it, chaos", 14);
    const impact = run.first_impact?.expected ?? run.first_impact?.actual;
    if (impact) mark(drawing, impact.time, "first impact that differs", kHeight - kBottom - 8);
    line = drawing.appendChild(svg("line", { class: "chosen", y1: kTop, y2: kHeight - kBottom }));
    dot = drawing.appendChild(svg("circle", { r: 4 }));
    element.replaceChildren(drawing);
    show(chosen);
  }

  function show(index) {
    chosen = index;
    const sample = samples[index];
    const words = sample.relative > 0
      ? `${brief(sample.time)} s: ${brief(numeric(sample.position))} m and ${brief(numeric(sample.angle))} rad apart, ${brief(sample.relative)} of ${sample.box}`
      : `${brief(sample.time)} s: no difference`;
    element.setAttribute("aria-valuenow", String(index));
    element.setAttribute("aria-valuetext", words);
    document.getElementById("growth-readout").textContent =
      words + (run.horizon !== null && sample.time > run.horizon ? " – beyond the horizon this means nothing" : "");
    if (!line) return;
    line.setAttribute("x1", xOf(sample.time));
    line.setAttribute("x2", xOf(sample.time));
    dot.setAttribute("cx", xOf(sample.time));
    dot.setAttribute("cy", sample.relative > 0 ? yOf(sample.relative) : kHeight - kBottom);
  }

  makeSlider(element, samples.length, { left: kLeft, right: kInset }, show, () => chosen);
  const horizon = run.horizon === null ? samples.length - 1 : samples.findIndex((sample) => sample.time >= run.horizon);
  chosen = Math.max(0, horizon);
  drawAtItsWidth(element, draw);
  show(chosen);
}
