#pragma once

#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "support/extrapolated_top.h"
#include "support/planar_box.h"
#include "support/quad_room.h"
#include "support/quad_scene.h"

namespace careen::oracle {

using QuadPoses = std::vector<QuadPose>;  // one per time

inline QuadVector fallen(const QuadScene& scene, const Quad& time) {
  const QuadBox& box = scene.boxes.at(0);
  return box.position + time * (box.velocity + time / 2 * scene.gravity);
}

/// Free flight, rotation by the Taylor series. Order 30 suffices for Quad, 48 for Bits192.
template <class Real = Quad, std::size_t kOrder = 30>
QuadPoses flown(const QuadScene& scene, std::span<const double> times) {
  const QuadBox& box = scene.boxes.at(0);
  FreeBody<Real> body{converted<Real>(box.moments), converted<Real>(box.momentum),
                      normalized(converted<Real>(box.attitude))};
  QuadPoses poses;
  Real at = 0;
  for (const double time : times) {
    advance<Real, kOrder>(body, Real(Real(time) - at));
    at = time;
    poses.push_back({fallen(scene, time), converted<Quad>(normalized(body.attitude))});
  }
  return poses;
}

/// Free flight, rotation by extrapolation.
inline QuadPoses flownByExtrapolation(const QuadScene& scene, std::span<const double> times) {
  ExtrapolatedTop top(scene.boxes.at(0));
  QuadPoses poses;
  Quad at = 0;
  for (const double time : times) {
    top.advance(Quad(time) - at);
    at = time;
    poses.push_back({fallen(scene, at), top.attitude()});
  }
  return poses;
}

/// Poses at these times by an oracle that advances from impact to impact, a QuadRoom or a PlanarBox.
template <class Oracle>
QuadPoses struck(Oracle oracle, std::span<const double> times, int impacts) {
  QuadPoses poses;
  int seen = 0;
  for (std::size_t k = 0; k < times.size();) {
    Oracle next = oracle;
    const bool strikes = next.strike(times.back());
    for (; k < times.size() && (!strikes || Quad(times[k]) <= next.time()); ++k) {
      poses.push_back(oracle.pose(Quad(times[k]) - oracle.time()));
    }
    oracle = std::move(next);
    seen += strikes ? 1 : 0;
  }
  if (seen != impacts) {
    throw std::runtime_error("other than the number of impacts expected: " + std::to_string(seen));
  }
  return poses;
}

}  // namespace careen::oracle
