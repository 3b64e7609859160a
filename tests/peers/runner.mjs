// Runs one engine for careen's study, and as often as it is asked to:
//
//   node runner.mjs ENGINE default|best
//
// Each line on standard input is a question in JSON, in SI units, and is answered by a line on standard output:
//
//   {"table": "poses.csv", "step": 0.01, "times": [0.5, 1], "world": {
//     "gravity": [0, 0, -9.81],
//     "walls": [{"normal": [0, 0, 1], "offset": 0, "restitution": 0.5, "friction": 0.3}],
//     "boxes": [{"name": "a", "half_extents": [1, 1, 1], "middle": [0, 0, 0], "restitution": 0.5, "friction": 0.3,
//                "position": [0, 0, 5], "orientation": [1, 0, 0, 0], "fixed": false, "mass": 1, "moments": [1, 1, 1],
//                "axes": [1, 0, 0, 0], "velocity": [0, 0, 0], "angular_velocity": [0, 0, 0]}]}}
//   {"seconds": 0.0123}
//
// A box's frame has its origin at the centre of mass and its axes along the box's edges; "middle" is the box's in that
// frame, and "axes" the quaternion, w first, of the principal axes of its "moments" in it. A body of several boxes has
// "parts", each with "half_extents", "middle" and "orientation" in that frame; "half_extents" and "middle" of its own are
// those of the box around them. Other vectors are in the world's frame. A pair has the larger restitution of the two
// and the root of the product of their frictions. Steps are equal between two times, and no longer than "step". The
// table has the poses at these times, in the columns of tables of poses that careen reads. "seconds" is the time of
// cores that it took to set up the world, to step and to read the states. Where there is no answer it is
// {"failure": "why"}. The empty question {} is answered by {} once the engine is loaded.
//
// ENGINE.mjs has the engine: load() gives a function feed(world, isBest), and that an object with step(h), state(i) and
// end().
import {writeFileSync} from "node:fs";
import {createInterface} from "node:readline";

import {cross, normalized, rotated} from "./vectors.mjs";

console.log = console.error;  // standard output is for answers

const columns = ["time", "box", "x", "y", "z", "qw", "qx", "qy", "qz", "vx", "vy", "vz", "wx", "wy", "wz"];

function rowsAt(time, world, moving) {
  const rows = [];
  world.boxes.forEach((box, index) => {
    if (box.fixed) {
      return;
    }
    const state = moving.state(index);
    const {position, velocity, angularVelocity} = state;
    if (![...position, ...state.orientation, ...velocity, ...angularVelocity].every(Number.isFinite)) {
      throw new Error(`the state of ${box.name} is not finite by t = ${time} s`);
    }
    const orientation = normalized(state.orientation);
    const arm = rotated(orientation, box.middle);
    const turning = cross(angularVelocity, arm);
    rows.push([time, `"${box.name.replaceAll('"', '""')}"`, ...position.map((x, k) => x + arm[k]), ...orientation,
               ...velocity.map((x, k) => x + turning[k]), ...angularVelocity]);
  });
  return rows;
}

function run(feed, isBest, {table, step, times, world}) {
  const begun = process.cpuUsage();
  const moving = feed(world, isBest);
  const rows = [];
  try {
    let now = 0;
    for (const time of times) {
      // The factor prevents rounding from splitting an interval of n steps into n + 1.
      const count = Math.ceil((time - now) / step * (1 - 1e-12));
      for (let k = 0; k < count; ++k) {
        moving.step((time - now) / count);
      }
      now = time;
      rows.push(...rowsAt(time, world, moving));
    }
  } finally {
    moving.end();
  }
  const taken = process.cpuUsage(begun);
  writeFileSync(table, [columns, ...rows].map((row) => row.join(",") + "\n").join(""));
  return {seconds: Math.max(1e-6, (taken.user + taken.system) / 1e6)};
}

const [engine, settings] = process.argv.slice(2);
const feed = await (await import(`./${engine}.mjs`)).load();
for await (const line of createInterface({input: process.stdin})) {
  const question = JSON.parse(line);
  let answer = {};
  try {
    answer = question.world ? run(feed, settings === "best", question) : {};
  } catch (error) {
    answer = {failure: String(error?.message ?? error)};
  }
  process.stdout.write(JSON.stringify(answer) + "\n");
}
