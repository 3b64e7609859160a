// Makes one page of its parts, for build: node assemble.js FOLDER_OF_PROGRAM FOLDER_OF_THREE PAGE
"use strict";
const fs = require("fs");
const path = require("path");
const zlib = require("zlib");

const [programs, three, page] = process.argv.slice(2);
const root = path.join(__dirname, "../..");
const read = file => fs.readFileSync(file, "utf8");
const own = name => read(path.join(__dirname, name));
// In HTML nothing may end a script but its own end.
const inScript = text => text.replace(/<(?=\/script|!--)/gi, "<\\");
// The comment at the head of a scene.
function about(text) {
  const lines = [];
  for (const line of text.split("\n")) {
    const comment = /^\s*\/\/\s?(.*)$/.exec(line);
    if (comment) lines.push(comment[1]);
    else if (lines.length > 0) break;
  }
  return lines.join(" ");
}

const folder = path.join(root, "assets/scenes");
const scenes = fs.readdirSync(folder).filter(name => name.endsWith(".json")).sort().map(name => {
  const text = read(path.join(folder, name));
  return { name, about: about(text), text };
});
const libraries = ["build/three.min.js", "examples/js/controls/OrbitControls.js", "examples/js/loaders/GLTFLoader.js"]
  .map(name => read(path.join(three, name))).join("\n;\n");
const version = /project\(careen VERSION ([0-9.]+)/.exec(read(path.join(root, "CMakeLists.txt")))[1];
const parts = {
  STYLE: read(path.join(root, "assets/page/base.css")) + own("style.css"),  // the colours of a run's page
  PROGRAM: `careen ${version}`,
  THREE: /REVISION="?(\d+)/.exec(libraries)?.[1] ?? "",
  SCENES: JSON.stringify(scenes).replace(/</g, "\\u003c"),
  WASM: zlib.gzipSync(fs.readFileSync(path.join(programs, "careen.wasm")), { level: 9 }).toString("base64"),
  WORKER: inScript(own("worker.js").replace("{{CAREEN}}", () => read(path.join(programs, "careen.js")))),
  LIBRARIES: inScript(libraries),
  PAGE: own("page.js"),
};
fs.mkdirSync(path.dirname(page), { recursive: true });
fs.writeFileSync(page, own("index.html").replace(/\{\{([A-Z]+)\}\}/g, (mark, name) => parts[name]));
console.log(`the page     ${page}, ${(fs.statSync(page).size / 1e6).toFixed(1)} MB`);
