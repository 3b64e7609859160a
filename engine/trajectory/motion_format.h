#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "core/names.h"
#include "physics/world/method.h"
#include "trajectory/archive.h"
#include "trajectory/trajectory.h"

namespace careen {

// Motions in a trajectory file, see trajectory_format.h.

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
void visit(Archive& archive, Visited<Archive, Motion> motion) {
  visitVariant(archive, motion);
}

template <class Archive>
void visit(Archive& archive, Visited<Archive, Segment> segment) {
  archive.visit(segment.start);
  visit(archive, segment.motion);
}

}  // namespace careen
