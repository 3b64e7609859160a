#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "core/names.h"
#include "physics/world/method.h"
#include "physics/world/run_settings.h"
#include "trajectory/archive.h"
#include "trajectory/trajectory.h"

namespace careen {

// The record of a trajectory file, type by type: visit(archive, value) reads and writes. A change here is
// another format version.

template <class Archive>
void visit(Archive& archive, Visited<Archive, Vec3> vector) {
  for (int i = 0; i < 3; ++i) {
    archive.visit(vector[i]);
  }
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Pose> pose) {
  visit(archive, pose.position);
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      archive.visit(pose.worldFromBody(row, column));
    }
  }
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, BodyState> state) {
  visit(archive, state.pose);
  visit(archive, state.velocity);
  visit(archive, state.angularMomentum);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Rest> rest) {
  visit(archive, rest.pose);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, EulerStep> step) {
  visit(archive, step.start);
  visit(archive, step.force);
  visit(archive, step.torque);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Flight> flight) {
  visit(archive, flight.position);
  visit(archive, flight.velocity);
  visit(archive, flight.acceleration);
  for (int i = 0; i < 4; ++i) {
    archive.visit(flight.worldFromBody.coeffs()[i]);
  }
  visit(archive, flight.angularMomentum);
}

/// By name: the methods' values may change.
template <class Archive>
void visit(Archive& archive, Visited<Archive, Method> method) {
  std::string name;
  if constexpr (!Archive::kReads) {
    name = traitsOf(method).name;
  }
  archive.visit(name);
  if constexpr (Archive::kReads) {
    const std::optional<Method> known = methodNamed(name);
    if (!known) {
      archive.fail("was made by the method '" + name + "', expected one of " + listed(kMethodNames));
    }
    method = *known;
  }
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, SteppedFlight> stepped) {
  visit(archive, stepped.method);
  archive.visit(stepped.dt);
  visit(archive, stepped.start);
}

template <class Archive, class Step>
void visitStep(Archive& archive, Step& step) {
  archive.visit(step.duration);
  for (std::size_t k = 0; k < step.position.size(); ++k) {
    visit(archive, step.position[k]);
    for (int i = 0; i < 4; ++i) {
      archive.visit(step.worldFromBody[k][i]);
    }
  }
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, SampledStep> step) {
  archive.visit(step.duration);
  visit(archive, step.start);
  visit(archive, step.end);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, CrowdStep> step) {
  visitStep(archive, step);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, ContactStep> step) {
  visitStep(archive, step);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Mat3> matrix) {
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      archive.visit(matrix(row, column));
    }
  }
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Driven> driven) {
  visit(archive, driven.pivot);
  visit(archive, driven.arm);
  visit(archive, driven.worldFromBody);
  visit(archive, driven.velocity);
  visit(archive, driven.spin);
  visit(archive, driven.amplitude);
  visit(archive, driven.swing);
  archive.visit(driven.rate);
  archive.visit(driven.phase);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, CoursePart> part) {
  archive.visit(part.from);
  visit(archive, part.motion);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, MassProperties> mass) {
  archive.visit(mass.mass);
  archive.visit(mass.inverseMass);
  visit(archive, mass.inertiaBody);
  visit(archive, mass.inverseInertiaBody);
}

/// What a body has since format version 7, stored after the rest.
template <class Archive>
void visitPlacement(Archive& archive, Visited<Archive, Body> body) {
  visit(archive, body.boxCenter);
  archive.visit(body.mass.turned);
  visit(archive, body.mass.bodyFromPrincipal);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, BodyPart> part) {
  visit(archive, part.halfExtents);
  visit(archive, part.center);
  archive.visit(part.turned);
  visit(archive, part.bodyFromPart);
}

/// What a body has since format version 13.
template <class Archive>
void visitParts(Archive& archive, Visited<Archive, Body> body) {
  if constexpr (Archive::kReads) {
    std::vector<BodyPart> parts;
    visitAll(archive, parts);
    if (!parts.empty()) {
      setParts(body, std::move(parts));
    }
  } else {
    visitAll(archive, body.parts);
  }
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Motion> motion) {
  visitVariant(archive, motion);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Segment> segment) {
  archive.visit(segment.start);
  visit(archive, segment.motion);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, BodyIndex> body) {
  visitIndex(archive, body.value);
}

/// 0 for a wall or 1 for a body, then its index.
template <class Archive>
void visit(Archive& archive, Visited<Archive, Partner> partner) {
  auto kind = static_cast<std::uint8_t>(partner.isWall() ? 0 : 1);
  archive.visit(kind);
  int index = partner.isWall() ? static_cast<int>(partner.wall()) : partner.body();
  visitIndex(archive, index);
  if constexpr (Archive::kReads) {
    if (kind > 1) {
      archive.fail("has an unknown kind of record");
    }
    if (index < 0) {
      archive.fail("names an unknown body or wall");
    }
    partner = kind == 0 ? Partner::ofWall(static_cast<std::size_t>(index)) : Partner::ofBody(index);
  }
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Impact> impact) {
  archive.visit(impact.time);
  visit(archive, impact.a);
  visit(archive, impact.b);
  visit(archive, impact.point);
  visit(archive, impact.normal);
  archive.visit(impact.approach);
  archive.visit(impact.impulse);
  archive.visit(impact.tangential);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Material> material) {
  archive.visit(material.restitution);
  archive.visit(material.friction);
}

template <class Archive>
void visitSurface(Archive& archive, Visited<Archive, Material> material) {
  visit(archive, material.surface.velocity);
  visit(archive, material.surface.spin);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Body> body) {
  archive.visit(body.name);
  visit(archive, body.halfExtents);
  visit(archive, body.mass);
  visit(archive, body.material);
  visit(archive, body.initial);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Wall> wall) {
  archive.visit(wall.name);
  visit(archive, wall.normal);
  archive.visit(wall.offset);
  visit(archive, wall.material);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, SpringEnd> end) {
  visitOptional(archive, end.body);
  visit(archive, end.point);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Spring> spring) {
  visit(archive, spring.from);
  visit(archive, spring.to);
  archive.visit(spring.stiffness);
  archive.visit(spring.damping);
  archive.visit(spring.restLength);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Drag> drag) {
  archive.visit(drag.linear);
  archive.visit(drag.angular);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, GravityChange> change) {
  archive.visit(change.time);
  visit(archive, change.gravity);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, World> world) {
  visit(archive, world.gravity);
  visitAll(archive, world.bodies);
  visitAll(archive, world.walls);
  visitAll(archive, world.springs);
  visitOptional(archive, world.drag);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, RoomShape> room) {
  visit(archive, room.min);
  visit(archive, room.max);
  for (std::size_t side = 0; side < room.open.size(); ++side) {
    visit(archive, room.open[side]);
  }
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Plane> plane) {
  visit(archive, plane.normal);
  archive.visit(plane.offset);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Color> color) {
  archive.visit(color.red);
  archive.visit(color.green);
  archive.visit(color.blue);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, std::array<std::size_t, 3>> triangle) {
  for (std::size_t corner = 0; corner < 3; ++corner) {
    auto index = static_cast<int>(triangle[corner]);
    visitIndex(archive, index);
    if constexpr (Archive::kReads) {
      triangle[corner] = static_cast<std::size_t>(std::max(index, 0));
    }
  }
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, DrawnPart> part) {
  auto body = static_cast<int>(part.body);
  visitIndex(archive, body);
  if constexpr (Archive::kReads) {
    part.body = static_cast<std::size_t>(std::max(body, 0));
  }
  visitAll(archive, part.mesh.points);
  visitAll(archive, part.mesh.triangles);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Camera> camera) {
  visit(archive, camera.eye);
  visit(archive, camera.target);
  visit(archive, camera.up);
  archive.visit(camera.fovDegrees);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, CameraKey> key) {
  archive.visit(key.time);
  visit(archive, key.eye);
  visit(archive, key.target);
  archive.visit(key.fovDegrees);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, CameraMove> move) {
  archive.visit(move.orbitDegrees);
  visitOptional(archive, move.followed);
  visitAll(archive, move.keys);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, TimeKey> key) {
  archive.visit(key.film);
  archive.visit(key.scene);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, FrameRate> rate) {
  std::string text = rate.text();
  archive.visit(text);
  if constexpr (Archive::kReads) {
    rate = parseFrameRate(text);
  }
}

// A NameSet.
template <class Archive, class Set>
void visitNames(Archive& archive, Set& set) {
  std::string text = set.text();
  archive.visit(text);
  if constexpr (Archive::kReads) {
    set = Set::named(text);
  }
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, PictureSettings> picture) {
  visitIndex(archive, picture.width);
  visitIndex(archive, picture.height);
  visit(archive, picture.rate);
  visitNamed(archive, picture.look, kLooks);
  visitNamed(archive, picture.antialiasing, kAntialiasings);
  archive.visit(picture.shutter.degrees);
  visitIndex(archive, picture.shutter.samples);
  visitNames(archive, picture.overlays);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Stage> stage) {
  archive.visit(stage.name);
  visitOptional(archive, stage.room);
  visitAll(archive, stage.planes);
  visitAll(archive, stage.colors);
  visitOptional(archive, stage.camera);
  visit(archive, stage.cameraMove);
  visitAll(archive, stage.timeMap.keys);
  visit(archive, stage.picture);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, PlanItem> item) {
  archive.visit(item.what);
  visit(archive, item.modelled);
  archive.visit(item.reason);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Track> track) {
  if constexpr (Archive::kReads) {
    visitAll(archive, track.segments.open());
  } else {
    visitAll(archive, track.segments);
  }
}

/// [s] -1: never.
template <class Archive>
void visitTime(Archive& archive, Visited<Archive, std::optional<double>> time) {
  constexpr double kNever = -1;
  double stored = time.value_or(kNever);
  archive.visit(stored);
  if constexpr (Archive::kReads) {
    time = stored >= 0 ? std::optional(stored) : std::nullopt;
  }
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, RunFigures> figures) {
  archive.visit(figures.energyChange);
  archive.visit(figures.momentumChange);
  archive.visit(figures.orthogonality);
  archive.visit(figures.deepestPenetration);
  visitTime(archive, figures.boundedFrom);
}

/// What figures have since format version 8, stored after the rest.
template <class Archive>
void visitResiduals(Archive& archive, Visited<Archive, RunFigures> figures) {
  for (auto* residuals : {&figures.contact, &figures.crowds}) {
    auto problems = static_cast<std::uint64_t>(residuals->problems);
    archive.visit(problems);
    if constexpr (Archive::kReads) {
      residuals->problems = static_cast<std::int64_t>(problems);
    }
    archive.visit(residuals->primal);
    archive.visit(residuals->dual);
    archive.visit(residuals->complementarity);
  }
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, CrowdSettings> crowds) {
  int when = static_cast<int>(crowds.when);
  visitIndex(archive, when);
  visitIndex(archive, crowds.above);
  archive.visit(crowds.tolerance);
  if constexpr (Archive::kReads) {
    if (when < 0 || when > static_cast<int>(CrowdSettings::When::kAbove) || crowds.above < 0 ||
        !(crowds.tolerance > 0)) {
      archive.fail("has invalid settings of crowds");
    }
    crowds.when = static_cast<CrowdSettings::When>(when);
  }
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, RunSettings> settings) {
  visit(archive, settings.method);
  archive.visit(settings.dt);
  archive.visit(settings.tolerance);
  archive.visit(settings.duration);
}

/// What a run starts from.
template <class Archive>
void visitStart(Archive& archive, Visited<Archive, Trajectory> run) {
  archive.visit(run.sceneText);
  std::string sceneHash = run.sceneHash();
  archive.visit(sceneHash);
  visit(archive, run.settings);
  visit(archive, run.figures);
  visit(archive, run.world);
  visit(archive, run.stage);
  visitAll(archive, run.plan.items);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Trajectory> run) {
  visitStart(archive, run);
  visitAll(archive, run.tracks);
  visitAll(archive, run.impacts);
}

}  // namespace careen
