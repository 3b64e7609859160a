"use strict";
// Runs careen's own commands on one scene, in files that only this worker sees.
//   in:  { module, name, files: { name: text } }
//   out: { phase } while it works, with figures while it simulates; then { done } or { fault }
function startProgram(Module) {
{{CAREEN}}
}

const kFinest = 1e-7;     // [m] --within: single precision
const kUsual = 1e-4;      // [m] of playback, from the run
const kPartOfBox = 1e-3;  // that much of the smallest box, if it is less
const kMany = 200;        // boxes, from which on playback may be ten times as far off

self.onmessage = ({ data }) => {
  let lines = [];
  let complaint = [];  // bytes
  const complaints = () => new TextDecoder().decode(Uint8Array.from(complaint)).trim();
  const program = {
    noInitialRun: true,
    thisProgram: "careen",
    print: line => {
      if (line.startsWith('{"phase"')) self.postMessage(JSON.parse(line));
      else lines.push(line);
    },
    stderr: byte => complaint.push(byte),  // no terminal: there is no status line
    instantiateWasm: (imports, receive) => {
      WebAssembly.instantiate(data.module, imports).then(instance => receive(instance), fail);
      return {};
    },
    onRuntimeInitialized: () => {
      try {
        work();
      } catch (error) {
        fail(error);
      }
    },
  };
  const fail = error => self.postMessage({ fault: complaints() || memoryWords(error) });
  // Where memory ends, so does the program.
  const memoryWords = error => /memory|allocat/i.test(String(error)) ? "out of memory" : String(error);

  // The lines that a command prints; null if it fails, which is then told.
  const run = (...words) => {
    lines = [];
    complaint = [];
    return program.callMain(words) === 0 ? lines : null;
  };

  function work() {
    const { FS } = program;
    const bytes = name => FS.readFile(name);
    const text = name => FS.readFile(name, { encoding: "utf8" });
    FS.mkdir("/scene");
    FS.chdir("/scene");
    for (const [name, content] of Object.entries(data.files)) FS.writeFile(name, content);
    const info = run("info", data.name);
    if (!info) return fail();
    self.postMessage({ phase: "simulate", simulated: 0, duration: 1, impacts: 0 });
    const start = performance.now();
    const files = ["--out", "run.careen", "--impacts", "impacts.csv", "--energy", "energy.csv", "--report", "report.json"];
    if (!run("simulate", data.name, ...files, "--log", "json", "--no-estimate-error", "--audit", "none")) return fail();
    const seconds = (performance.now() - start) / 1000;
    const notes = complaints().split("\n").filter(line => !/^(simulated|scene|files) /.test(line));
    const report = JSON.parse(text("report.json"));
    const sizes = [...data.files[data.name].matchAll(/"half_extents"\s*:\s*\[([^\]]*)\]/g)]
      .flatMap(match => match[1].split(",").map(Number)).filter(size => size > 0);
    const many = report.life.length > kMany ? 10 : 1;
    const within = Math.max(kFinest, Math.min(kUsual, kPartOfBox * Math.min(...sizes, 1)) * many);
    self.postMessage({ phase: "simulated; auditing" });
    const audit = run("audit", "run.careen") || lines;
    self.postMessage({ phase: "simulated and audited; finding the keys of the film" });
    if (!run("export", "run.careen", "--out", "film.glb", "--within", String(within), "--real-time",
             "--audit", "none")) return fail();
    const done = { name: data.name, info, audit, report, notes, seconds, within, film: bytes("film.glb"), run: bytes("run.careen"),
                   impacts: text("impacts.csv"), energy: text("energy.csv") };
    self.postMessage({ done }, [done.film.buffer, done.run.buffer]);
  }

  startProgram(program);
};
