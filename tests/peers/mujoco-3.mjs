// MuJoCo as WebAssembly, in doubles. All settings stay as it ships them, except what a world defines. Contacts that bounce
// have the stiffness that MuJoCo gives those that do not. The same as engine/study/peer_mujoco.cpp.
import loadMujoco from "@mujoco/mujoco";

import {inFrameOf, partsOf, rotated, touching} from "./vectors.mjs";

// MuJoCo has no coefficient of restitution, but springs in contacts whose damping can be chosen. This is the damping ratio
// of one that pushes but never pulls and gives back the part e of the approach: ln e = -2 ζ acos ζ / sqrt(1 - ζ²), and its
// continuation above ζ = 1 (Schwager and Poschel 2007).
function dampingRatio(restitution) {
  const lost = (z) => {
    const root = Math.sqrt(Math.abs(1 - z * z));
    return root < 1e-9 ? 2 : 2 * z * (z < 1 ? Math.acos(z) : Math.acosh(z)) / root;
  };
  let low = 0;
  let high = 1;
  while (Math.exp(-lost(high)) > restitution && high < 1e6) {
    high *= 2;
  }
  for (let k = 0; k < 100; ++k) {
    const middle = (low + high) / 2;
    if (Math.exp(-lost(middle)) > restitution) {
      low = middle;
    } else {
      high = middle;
    }
  }
  return low;
}

// A contact's spring: stiffness and damping, or time constant and damping ratio, of which MuJoCo makes the same stiffness.
function spring(restitution, constant) {
  return restitution > 0 ? [-1 / (constant * constant), -2 * dampingRatio(restitution) / constant] : [constant, 1];
}

// Of the coefficients the first two are sliding's; without any, a contact has one dimension.
const dimensions = (friction) => `condim="${friction > 0 ? 3 : 1}"`;

// Its geometries are named by their numbers, from this one on.
function boxText(box, first) {
  const inertial = box.fixed ? "" : `<freejoint/><inertial pos="0 0 0" mass="${box.mass}"
    diaginertia="${box.moments.join(" ")}" quat="${box.axes.join(" ")}"/>`;
  const geometries = partsOf(box).map((part, k) => `<geom type="box" name="${first + k}" pos="${part.middle.join(" ")}"
    quat="${part.orientation.join(" ")}" size="${part.half_extents.join(" ")}" ${dimensions(box.friction)}
    friction="${box.friction} 0 0"/>`);
  return `<body pos="${box.position.join(" ")}" quat="${box.orientation.join(" ")}">${inertial}${geometries.join("")}
    </body>`;
}

// What each geometry belongs to.
const ownersIn = (world) => [...world.walls, ...world.boxes.flatMap((box) => partsOf(box).map(() => box))];

// The scene as MJCF. Geometries are named by their numbers, walls first. MuJoCo has its own ways to mix two materials: where
// they differ, each pair is named and told its own.
function modelText(world) {
  const all = ownersIn(world);
  const walls = world.walls.map((wall, k) => `<geom type="plane" size="0 0 1" name="${k}"
    pos="${wall.normal.map((x) => x * wall.offset).join(" ")}" zaxis="${wall.normal.join(" ")}"
    ${dimensions(wall.friction)} friction="${wall.friction} 0 0"/>`);
  const boxes = world.boxes.map((box) => boxText(box, all.indexOf(box)));
  const pairs = [];
  if (all.some((each) => each.friction !== all[0].friction || each.restitution !== all[0].restitution)) {
    all.forEach((a, i) => all.slice(0, i).forEach((b, j) => {
      const isFixed = (geometry) => geometry.normal !== undefined || geometry.fixed;
      if (a !== b && !(isFixed(a) && isFixed(b))) {
        const friction = touching(a, b).friction;
        pairs.push(`<pair geom1="${i}" geom2="${j}" ${dimensions(friction)} friction="${friction} ${friction} 0 0 0"/>`);
      }
    }));
  }
  return `<mujoco><compiler angle="radian"/><option gravity="${world.gravity.join(" ")}"/><worldbody>${walls.join("")}
    ${boxes.join("")}</worldbody><contact>${pairs.join("")}</contact></mujoco>`;
}

class Moving {
  constructor(mujoco, world, isBest) {
    this.mujoco = mujoco;
    this.isBest = isBest;
    this.materials = ownersIn(world);
    this.model = mujoco.MjModel.from_xml_string(modelText(world));
    this.data = new mujoco.MjData(this.model);
    if (isBest) {
      this.model.opt.integrator = mujoco.mjtIntegrator.mjINT_RK4.value;
      this.model.opt.cone = mujoco.mjtCone.mjCONE_ELLIPTIC.value;
    }
    let place = 0;
    this.places = world.boxes.map((box) => box.fixed ? -1 : place++);
    const speeds = this.data.qvel;
    world.boxes.forEach((box, index) => {
      if (!box.fixed) {
        speeds.set([...box.velocity, ...inFrameOf(box.orientation, box.angular_velocity)], 6 * this.places[index]);
      }
    });
  }

  step(h) {
    if (h !== this.h) {
      this.h = h;
      this.setStep();
    }
    this.mujoco.mj_step(this.model, this.data);
  }

  // The springs of contacts depend on the step.
  setStep() {
    this.model.opt.timestep = this.h;
    const constant = this.isBest ? 2 * this.h : Math.max(0.02, 2 * this.h);
    const each = this.model.geom_solref;
    this.materials.forEach((material, k) => each.set(spring(material.restitution, constant), 2 * k));
    const [first, second, pairs] = [this.model.pair_geom1, this.model.pair_geom2, this.model.pair_solref];
    for (let k = 0; k < this.model.npair; ++k) {
      const {restitution} = touching(this.materials[first[k]], this.materials[second[k]]);
      pairs.set(spring(restitution, constant), 2 * k);
    }
  }

  state(index) {
    // MuJoCo puts everything back to its start where a number becomes too large.
    const {mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC, mjWARN_CONTACTFULL, mjWARN_CNSTRFULL} =
        this.mujoco.mjtWarning;
    const count = (warning) => this.data.warning.get(warning.value).number;
    if (count(mjWARN_CONTACTFULL) + count(mjWARN_CNSTRFULL) > 0) {
      throw new Error("more contacts than there is memory for");
    }
    const isLost = count(mjWARN_BADQPOS) + count(mjWARN_BADQVEL) + count(mjWARN_BADQACC) > 0;
    const at = Array.from(this.data.qpos.slice(7 * this.places[index], 7 * this.places[index] + 7));
    const moves = Array.from(this.data.qvel.slice(6 * this.places[index], 6 * this.places[index] + 6));
    const orientation = at.slice(3);
    return {
      position: isLost ? [NaN, NaN, NaN] : at.slice(0, 3),
      orientation,
      velocity: moves.slice(0, 3),
      angularVelocity: rotated(orientation, moves.slice(3)),
    };
  }

  end() {
    this.data.delete();
    this.model.delete();
  }
}

export async function load() {
  const mujoco = await loadMujoco({print: () => {}, printErr: () => {}});
  return (world, isBest) => new Moving(mujoco, world, isBest);
}
