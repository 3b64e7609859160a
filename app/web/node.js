// Before the program starts: in node it has the machine's files, environment and standard streams.
if (typeof process === "object" && typeof importScripts !== "function") {
  const nodeFiles = require("fs");
  Module.wasmBinary = nodeFiles.readFileSync(__dirname + "/careen.wasm");
  const folders = nodeFiles.readdirSync("/", { withFileTypes: true }).map(entry => entry.name)
    .filter(name => !["dev", "proc", "sys"].includes(name))
    .filter(name => {
      try {
        return nodeFiles.statSync("/" + name).isDirectory();
      } catch (error) {
        return false;
      }
    });
  // Bytes, so that neither stream is a terminal: there is no status line and no pager.
  const streams = { stdout: { to: 1, bytes: [] }, stderr: { to: 2, bytes: [] } };
  const flush = stream => {
    for (let left = Buffer.from(stream.bytes); left.length > 0;) {
      try {
        left = left.subarray(nodeFiles.writeSync(stream.to, left));
      } catch (error) {
        if (error.code !== "EAGAIN") return;
      }
    }
    stream.bytes.length = 0;
  };
  for (const [name, stream] of Object.entries(streams)) {
    Module[name] = byte => {
      stream.bytes.push(byte);
      if (byte === 10) flush(stream);
    };
  }
  process.on("exit", () => Object.values(streams).forEach(flush));
  Module.preRun = () => {
    for (const name of folders) {
      if (!FS.analyzePath("/" + name).exists) FS.mkdir("/" + name);
      FS.mount(NODEFS, { root: "/" + name }, "/" + name);
    }
    FS.chdir(process.cwd());
    Object.assign(ENV, process.env);
  };
}
