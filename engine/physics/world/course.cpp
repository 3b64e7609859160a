#include "physics/world/course.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/math/elementary.h"

namespace careen {
namespace {

// [1] By a vector [rad], right at any size.
Mat3 turnedBy(const Vec3& angle) {
  const double size = angle.norm();
  if (size == 0) {
    return Mat3::Identity();
  }
  const auto half = elementary::sinCos(size / 2);
  const Vec3 axis = (half.sin / size) * angle;
  return Quat(half.cos, axis.x(), axis.y(), axis.z()).toRotationMatrix();
}

}  // namespace

Kinematics Driven::at(double elapsed) const {
  const auto swings = elementary::sinCos(rate * elapsed + phase);
  const Mat3 turned = turnedBy(spin * elapsed + swing * swings.sin);
  const Vec3 from = turned * arm;
  const Vec3 omega = spin + (rate * swings.cos) * swing;
  const Vec3 omegaRate = (-rate * rate * swings.sin) * swing;
  return {.pose = {.position = pivot + (velocity * elapsed + amplitude * swings.sin) + from,
                   .worldFromBody = turned * worldFromBody},
          .velocity = velocity + (rate * swings.cos) * amplitude + omega.cross(from),
          .angularVelocity = omega,
          .isDriven = true,
          .acceleration = (-rate * rate * swings.sin) * amplitude + omegaRate.cross(from) +
                          omega.cross(omega.cross(from)),
          .angularAcceleration = omegaRate};
}

Driven Driven::after(double elapsed) const {
  Driven later = *this;
  const Mat3 turned = turnedBy(spin * elapsed);
  later.pivot += velocity * elapsed;
  later.arm = turned * arm;
  later.worldFromBody = turned * worldFromBody;
  later.phase += rate * elapsed;
  return later;
}

MotionRates boundsOf(const Driven& driven) {
  const double turning = driven.spin.norm() + driven.rate * driven.swing.norm();
  const double turningRate = driven.rate * driven.rate * driven.swing.norm();
  const double arm = driven.arm.norm();
  const double amplitude = driven.amplitude.norm();
  return {.speed = driven.velocity.norm() + driven.rate * amplitude + turning * arm,
          .acceleration = driven.rate * driven.rate * amplitude + (turning * turning + turningRate) * arm,
          .angularSpeed = turning,
          .angularAcceleration = turningRate};
}

const CoursePart& partAt(const Course& course, double time) {
  const auto later = std::upper_bound(course.begin() + 1, course.end(), time,
                                      [](double at, const CoursePart& part) { return at < part.from; });
  return *std::prev(later);
}

double nextPart(const Course& course, double time) {
  const auto later =
      std::find_if(course.begin(), course.end(), [&](const CoursePart& part) { return part.from > time; });
  return later == course.end() ? std::numeric_limits<double>::infinity() : later->from;
}

Course courseOf(const PrescribedMotion& motion, const Pose& home) {
  const std::vector<PathPoint>& path = motion.path;
  const Vec3 origin = path.empty() ? Vec3(Vec3::Zero()) : path.front().place;
  const Driven whole{.pivot = motion.about,
                     .arm = home.position - motion.about,
                     .worldFromBody = home.worldFromBody,
                     .velocity = motion.velocity,
                     .spin = motion.angularVelocity,
                     .amplitude = motion.amplitude,
                     .swing = motion.swing,
                     .rate = motion.rate,
                     .phase = motion.phase};
  Course course;
  const auto add = [&](double from, const Vec3& place, const Vec3& along) {
    CoursePart& part = course.emplace_back(CoursePart{.from = from, .motion = whole.after(from)});
    part.motion.pivot += place - origin;
    part.motion.velocity += along;
  };
  if (path.empty() || path.front().time > 0) {
    add(0, origin, Vec3::Zero());
  }
  for (std::size_t k = 0; k < path.size(); ++k) {
    const bool isLast = k + 1 == path.size();
    add(path[k].time, path[k].place,
        isLast ? Vec3(Vec3::Zero())
               : Vec3((path[k + 1].place - path[k].place) / (path[k + 1].time - path[k].time)));
  }
  return course;
}

}  // namespace careen
