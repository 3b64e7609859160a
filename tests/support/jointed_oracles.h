#pragma once

#include <Eigen/Cholesky>
#include <array>
#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <cstddef>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "support/closed_forms.h"

namespace careen::oracle {

using Quads = std::vector<Quad>;
using RateOf = std::function<Quads(const Quads&)>;

/// y after this time of y′ = rate(y), in steps no longer than `longest`: Gragg's midpoint rule, extrapolated
/// to step 0, of order 24.
inline Quads advanced(Quads y, const RateOf& rate, const Quad& time, double longest) {
  constexpr int kColumns = 12;
  const auto moved = [](Quads from, const Quad& by, const Quads& along) {
    for (std::size_t i = 0; i < from.size(); ++i) {
      from[i] += by * along[i];
    }
    return from;
  };
  const auto midpoints = [&](const Quads& start, const Quads& first, const Quad& step, int count) {
    const Quad h = step / count;
    Quads before = start;
    Quads now = moved(start, h, first);
    for (int i = 1; i < count; ++i) {
      Quads next = moved(before, 2 * h, rate(now));
      before = std::exchange(now, std::move(next));
    }
    const Quads last = rate(now);
    for (std::size_t i = 0; i < now.size(); ++i) {
      now[i] = (now[i] + before[i] + h * last[i]) / 2;
    }
    return now;
  };
  const int steps = std::max(1, static_cast<int>(ceil(time / longest)));
  for (int n = 0; n < steps; ++n) {
    const Quads first = rate(y);
    std::vector<Quads> row;
    for (int k = 0; k < kColumns; ++k) {
      std::vector<Quads> next{midpoints(y, first, time / steps, 2 * (k + 1))};
      for (int j = 1; j <= k; ++j) {
        const Quad ratio = Quad(k + 1) / (k + 1 - j);
        Quads better = next.back();
        for (std::size_t i = 0; i < better.size(); ++i) {
          better[i] += (better[i] - row[static_cast<std::size_t>(j - 1)][i]) / (ratio * ratio - 1);
        }
        next.push_back(std::move(better));
      }
      row = std::move(next);
    }
    y = row.back();
  }
  return y;
}

/// Boxes in a row, each joined to the one before at a point, the first one to the world, or to nothing: from
/// Newton's and Euler's equations in the links' turns and rates alone, so that no joint can open.
class QuadChain {
 public:
  /// One of as many joints as boxes is the first box's with the world.
  explicit QuadChain(const QuadScene& scene)
      : scene_(scene), isFree_(scene.joints.size() < scene.boxes.size()) {
    const std::size_t count = scene.boxes.size();
    std::vector<Quad> beyond(count + 1, Quad(0));  // [kg] of this link and all after it
    for (std::size_t k = count; k-- > 0;) {
      beyond[k] = beyond[k + 1] + scene.boxes[k].mass;
    }
    mass_ = beyond[0];
    const auto joint = [&](std::size_t k) {
      return isFree_ ? (k == 0 ? scene.boxes[0].position : scene.joints[k - 1].at) : scene.joints[k].at;
    };
    for (std::size_t k = 0; k < count; ++k) {
      const QuadBox& box = scene.boxes[k];
      const QuadTurn back = inverse(box.attitude);
      Link link{.middle = turned(back, QuadVector(box.position - joint(k)))};
      link.next = k + 1 < count ? turned(back, QuadVector(joint(k + 1) - joint(k))) : QuadVector::Zero();
      link.moment = box.mass * link.middle + beyond[k + 1] * link.next;
      link.inertia = box.mass * aboutEnd(link.middle) + beyond[k + 1] * aboutEnd(link.next);
      for (int i = 0; i < 3; ++i) {
        link.inertia(i, i) += box.moments.at(static_cast<std::size_t>(i));
      }
      links_.push_back(link);
      centre_ += box.mass / mass_ * box.position;
      velocity_ += box.mass / mass_ * box.velocity;
    }
    root_ = joint(0);
  }

  /// Of each box, in steps no longer than this [s].
  std::vector<QuadPoses> poses(std::span<const double> times, double longest) const {
    Quads state;
    for (const QuadBox& box : scene_.boxes) {
      state.insert(state.end(), box.attitude.begin(), box.attitude.end());
    }
    for (const QuadBox& box : scene_.boxes) {
      const QuadVector spin =
          turned(box.attitude, QuadVector(box.momentum[0] / box.moments[0], box.momentum[1] / box.moments[1],
                                          box.momentum[2] / box.moments[2]));
      state.insert(state.end(), spin.data(), spin.data() + 3);
    }
    std::vector<QuadPoses> all(links_.size());
    Quad now = 0;
    for (const double time : times) {
      state = advanced(
          std::move(state), [this](const Quads& at) { return rate(at); }, time - now, longest);
      now = time;
      QuadVector end = root_;
      if (isFree_) {
        end = centre_ + now * (velocity_ + now / 2 * scene_.gravity);
        for (std::size_t k = 0; k < links_.size(); ++k) {
          end -= turned(attitude(state, k), links_[k].moment) / mass_;
        }
      }
      for (std::size_t k = 0; k < links_.size(); ++k) {
        const QuadTurn turn = attitude(state, k);
        all[k].push_back({end + turned(turn, links_[k].middle), turn});
        end += turned(turn, links_[k].next);
      }
    }
    return all;
  }

 private:
  using Matrix = Matrix3<Quad>;
  struct Link {
    QuadVector middle = QuadVector::Zero();  // from its first joint, in its own frame
    QuadVector next = QuadVector::Zero();    // the next joint, likewise
    QuadVector moment = QuadVector::Zero();  // [kg m] of its mass, and of all that it carries at the next one
    Matrix inertia = Matrix::Zero();         // of the same about its first joint, in its own frame
  };

  static Matrix aboutEnd(const QuadVector& r) { return r.dot(r) * Matrix::Identity() - r * r.transpose(); }
  static QuadTurn attitude(const Quads& state, std::size_t k) {
    return normalized(QuadTurn{state[4 * k], state[4 * k + 1], state[4 * k + 2], state[4 * k + 3]});
  }

  // Link k is turned about its first joint by what it carries: by link j after it, which moves as α_j × s_j
  // (+ ω_j × (ω_j × s_j)) per mass, at the next joint r_k; by link j before it as α_j × r_j, at s_k.
  Quads rate(const Quads& state) const {
    const std::size_t count = links_.size();
    std::vector<QuadVector> next(count);
    std::vector<QuadVector> moment(count);
    std::vector<QuadVector> spin(count);
    Eigen::Matrix<Quad, Eigen::Dynamic, Eigen::Dynamic> inertia(3 * count, 3 * count);
    Eigen::Matrix<Quad, Eigen::Dynamic, 1> torque(3 * count);
    Quads rates;
    for (std::size_t k = 0; k < count; ++k) {
      const QuadTurn turn = attitude(state, k);
      const Quad* const w = &state[4 * count + 3 * k];
      spin[k] = QuadVector(w[0], w[1], w[2]);
      next[k] = turned(turn, links_[k].next);
      moment[k] = turned(turn, links_[k].moment);
      const QuadTurn moves = times(QuadTurn{0, w[0] / 2, w[1] / 2, w[2] / 2}, turn);
      rates.insert(rates.end(), moves.begin(), moves.end());
      Matrix frame;
      frame << turned(turn, QuadVector::UnitX()), turned(turn, QuadVector::UnitY()),
          turned(turn, QuadVector::UnitZ());
      inertia.block<3, 3>(3 * k, 3 * k) = frame * links_[k].inertia * frame.transpose();
    }
    for (std::size_t k = 0; k < count; ++k) {
      const Matrix own = inertia.block<3, 3>(3 * k, 3 * k);
      QuadVector sum = -spin[k].cross(QuadVector(own * spin[k]));
      if (!isFree_) {
        sum += moment[k].cross(scene_.gravity);
      }
      for (std::size_t j = 0; j < count; ++j) {
        const QuadVector& arm = j > k ? next[k] : moment[k];
        const QuadVector& carried = j > k ? moment[j] : next[j];
        const auto add = [&](const QuadVector& at, const QuadVector& what) {
          inertia.block<3, 3>(3 * k, 3 * j) += at.dot(what) * Matrix::Identity() - what * at.transpose();
          sum -= at.cross(QuadVector(spin[j].cross(QuadVector(spin[j].cross(what)))));
        };
        if (j != k) {
          inertia.block<3, 3>(3 * k, 3 * j).setZero();
          add(arm, carried);
        }
        if (isFree_) {  // the first joint follows, so that the centre of all falls freely
          add(QuadVector(-moment[k] / mass_), moment[j]);
        }
      }
      torque.segment<3>(3 * k) = sum;
    }
    const Eigen::Matrix<Quad, Eigen::Dynamic, 1> turns = inertia.ldlt().solve(torque);
    rates.insert(rates.end(), turns.data(), turns.data() + turns.size());
    return rates;
  }

  const QuadScene& scene_;
  bool isFree_;
  std::vector<Link> links_;
  Quad mass_ = 0;
  QuadVector root_;
  QuadVector centre_ = QuadVector::Zero();
  QuadVector velocity_ = QuadVector::Zero();
};

/// θ″ = −w² sin θ in elliptic functions.
struct QuadHinged {
  Quad frequency;  ///< [rad/s] of small swings

  /// From rest at an angle, after a time.
  Quad fromRest(const Quad& start, const Quad& time) const {
    Quad cn;
    Quad dn;
    const Quad k = sin(start / 2);
    boost::math::jacobi_elliptic(Quad(abs(k)), Quad(frequency * time), &cn, &dn);
    return 2 * asin(k * cn / dn);
  }
  /// From hanging, on its way to rest where sin(θ/2) = k.
  Quad fromBelow(const Quad& k, const Quad& time) const {
    return 2 * asin(k * boost::math::jacobi_elliptic(k, Quad(frequency * time), static_cast<Quad*>(nullptr),
                                                     static_cast<Quad*>(nullptr)));
  }
  Quad quarter(const Quad& k) const { return boost::math::ellint_1(k) / frequency; }
};

/// [rad] About y, from where the box hangs from this place.
inline Quad angleFromHanging(const QuadVector& place, const QuadVector& box) {
  return atan2(place[0] - box[0], place[2] - box[2]);
}
/// A box turned about y by so much at this place.
inline QuadPose swung(const QuadBox& box, const QuadVector& place, const Quad& angle) {
  const QuadTurn turn = turnAbout(QuadVector::UnitY(), angle);
  return {place + turned(turn, QuadVector(box.position - place)), times(turn, box.attitude)};
}
/// About y, of a box that turns at this place.
inline Quad momentAbout(const QuadVector& place, const QuadBox& box) {
  return box.moments[1] + box.mass * (box.position - place).squaredNorm();
}

/// A box on a hinge along y.
inline QuadHinged pendulumOf(const QuadScene& scene) {
  const QuadBox& box = scene.boxes.at(0);
  const QuadVector& at = scene.joints.at(0).at;
  return {sqrt(-scene.gravity[2] * box.mass * (box.position - at).norm() / momentAbout(at, box))};
}

inline QuadPoses swungFromRest(const QuadScene& scene, std::span<const double> moments) {
  const QuadBox& box = scene.boxes.at(0);
  const QuadVector& at = scene.joints.at(0).at;
  const Quad start = angleFromHanging(at, box.position);
  QuadPoses poses;
  for (const double time : moments) {
    poses.push_back(swung(box, at, pendulumOf(scene).fromRest(start, time) - start));
  }
  return poses;
}

/// Two cranks, boxes 0 and 1, carry box 2, which does not turn.
inline std::vector<QuadPoses> parallelogram(const QuadScene& scene, std::span<const double> moments) {
  std::vector<QuadPoses> all(3);
  const QuadBox& bridge = scene.boxes.at(2);
  const std::array<QuadVector, 2> at = {scene.joints.at(0).at, scene.joints.at(1).at};
  const QuadVector arm = scene.joints.at(2).at - at[0];
  Quad inertia = bridge.mass * arm.squaredNorm();
  Quad weight = bridge.mass * arm.norm();
  for (std::size_t i = 0; i < 2; ++i) {
    inertia += momentAbout(at.at(i), scene.boxes.at(i));
    weight += scene.boxes.at(i).mass * (scene.boxes.at(i).position - at.at(i)).norm();
  }
  const QuadHinged pendulum{sqrt(-scene.gravity[2] * weight / inertia)};
  const Quad start = angleFromHanging(at[0], scene.joints.at(2).at);
  for (const double time : moments) {
    const Quad turn = pendulum.fromRest(start, time) - start;
    for (std::size_t i = 0; i < 2; ++i) {
      all.at(i).push_back(swung(scene.boxes.at(i), at.at(i), turn));
    }
    const QuadVector moved = turned(turnAbout(QuadVector::UnitY(), turn), arm) - arm;
    all[2].push_back({bridge.position + moved, bridge.attitude});
  }
  return all;
}

/// A box that swings on its hinge against a limit where it hangs.
inline QuadPoses swungAtLimit(const QuadScene& scene, std::span<const double> moments) {
  const QuadBox& box = scene.boxes.at(0);
  const QuadVector& at = scene.joints.at(0).at;
  const QuadHinged pendulum = pendulumOf(scene);
  const Quad start = angleFromHanging(at, box.position);
  QuadPoses poses;
  for (const double time : moments) {
    Quad k = sin(start / 2);
    Quad left = time - pendulum.quarter(k);
    if (left < 0) {
      poses.push_back(swung(box, at, pendulum.fromRest(start, time) - start));
      continue;
    }
    for (k *= scene.joints[0].restitution; left > 2 * pendulum.quarter(k); k *= scene.joints[0].restitution) {
      left -= 2 * pendulum.quarter(k);
    }
    poses.push_back(swung(box, at, pendulum.fromBelow(k, left) - start));
  }
  return poses;
}

/// A box that falls from rest until the rope at its middle is taut, and then swings; it turns as if it flew.
inline QuadPoses caughtByRope(const QuadScene& scene, std::span<const double> moments) {
  QuadPoses poses = flown(scene, moments);
  const QuadVector& at = scene.joints.at(0).at;
  const Quad& length = scene.joints.at(0).length;
  const Quad g = -scene.gravity[2];
  const QuadVector from = scene.boxes.at(0).position - at;
  const Quad depth = sqrt(length * length - from[0] * from[0]);
  const Quad taut = sqrt(2 * (from[2] + depth) / g);
  const Quad angle = atan2(-from[0], depth);
  for (std::size_t i = 0; i < moments.size(); ++i) {
    if (moments[i] > taut) {
      // Along the circle the fall is −g t in z: sin θ of it.
      const Quads now = advanced(
          {angle, -g * taut * sin(angle) / length},
          [&](const Quads& y) {
            return Quads{y[1], -g / length * sin(y[0])};
          },
          moments[i] - taut, 0.05);
      poses[i].position = at - length * QuadVector(sin(now[0]), Quad(0), cos(now[0]));
    }
  }
  return poses;
}

/// Two halves of one box, which flies: box 0 is the one at the lower x of it.
inline std::vector<QuadPoses> flownAsOne(const QuadScene& scene, std::span<const double> moments) {
  const QuadBox& left = scene.boxes.at(0);
  const QuadBox& right = scene.boxes.at(1);
  QuadScene one = scene;
  one.boxes.resize(1);
  QuadBox& whole = one.boxes[0];
  whole.halfExtents[0] *= 2;
  whole.mass = left.mass + right.mass;
  whole.position = (left.position + right.position) / 2;
  whole.velocity = (left.velocity + right.velocity) / 2;
  const QuadVector squares = whole.halfExtents.cwiseProduct(whole.halfExtents);
  for (int i = 0; i < 3; ++i) {
    const auto at = static_cast<std::size_t>(i);
    whole.moments.at(at) = whole.mass / 3 * (squares[(i + 1) % 3] + squares[(i + 2) % 3]);
    whole.momentum.at(at) = left.momentum.at(at) / left.moments.at(at) * whole.moments.at(at);
  }
  std::vector<QuadPoses> all(2);
  for (const QuadPose& pose : flown(one, moments)) {
    const QuadVector half = turned(pose.attitude, QuadVector(whole.halfExtents[0] / 2, Quad(0), Quad(0)));
    all[0].push_back({pose.position - half, pose.attitude});
    all[1].push_back({pose.position + half, pose.attitude});
  }
  return all;
}

/// State at these times of what a motor drives whose effort is chosen once in a period, and held.
inline std::vector<Quads> driven(Quads state, const QuadScene& scene, std::span<const double> moments,
                                 const std::function<Quad(const Quads&)>& effort,
                                 const std::function<Quads(const Quads&, const Quad&)>& rate) {
  std::vector<Quads> all;
  Quad held = 0;
  Quad now = 0;
  Quad sample = 0;
  for (const double time : moments) {
    while (now < time) {
      if (now == sample) {
        held = effort(state);
        sample += scene.period;
      }
      const Quad next = sample < time ? sample : Quad(time);
      state = advanced(
          state, [&](const Quads& y) { return rate(y, held); }, next - now, 1);
      now = next;
    }
    all.push_back(state);
  }
  return all;
}

/// A box on a slide along x with spring and damper, at 0 at the start, and a motor that aims at a place.
inline QuadPoses drivenToTarget(const QuadScene& scene, std::span<const double> moments) {
  const QuadBox& box = scene.boxes.at(0);
  const QuadJoint& slide = scene.joints.at(0);
  const std::vector<Quads> states = driven(
      {Quad(0), Quad(0)}, scene, moments,
      [&](const Quads& y) { return scene.kp * (scene.target - y[0]) - scene.kd * y[1]; },
      [&](const Quads& y, const Quad& effort) {
        return Quads{y[1], (effort - slide.stiffness * y[0] - slide.damping * y[1]) / box.mass};
      });
  QuadPoses poses;
  for (const Quads& state : states) {
    poses.push_back({box.position + state[0] * QuadVector::UnitX(), box.attitude});
  }
  return poses;
}

/// Box 0 slides along x, box 1 stands on it on a hinge along y; the motor of the slide pushes by gains.
inline std::vector<QuadPoses> polesUp(const QuadScene& scene, std::span<const double> moments) {
  const QuadBox& cart = scene.boxes.at(0);
  const QuadBox& pole = scene.boxes.at(1);
  const QuadVector& at = scene.joints.at(1).at;
  const QuadVector arm = pole.position - at;
  const Quad lean = atan2(arm[0], arm[2]);
  const Quad moment = pole.mass * arm.norm();
  const Quad turning = momentAbout(at, pole);
  const Quad mass = cart.mass + pole.mass;
  const Quads& gain = scene.gains;  // of way, speed, angle, rate
  const std::vector<Quads> states = driven(
      {Quad(0), lean, Quad(0), Quad(0)}, scene, moments,
      [&](const Quads& y) {
        const Quad angle = scene.joints[1].start + y[1] - lean;
        return Quad(-(gain.at(0) * y[0] + gain.at(1) * y[2] + gain.at(2) * angle + gain.at(3) * y[3]));
      },
      [&](const Quads& y, const Quad& effort) {
        const Quad across = moment * cos(y[1]);
        const Quad push = effort + moment * y[3] * y[3] * sin(y[1]);
        const Quad fall = -scene.gravity[2] * moment * sin(y[1]);
        const Quad whole = mass * turning - across * across;
        return Quads{y[2], y[3], (turning * push - across * fall) / whole,
                     (mass * fall - across * push) / whole};
      });
  std::vector<QuadPoses> all(2);
  for (const Quads& state : states) {
    const QuadVector way = state[0] * QuadVector::UnitX();
    all[0].push_back({cart.position + way, cart.attitude});
    all[1].push_back(swung(pole, at, state[1] - lean));
    all[1].back().position += way;
  }
  return all;
}

}  // namespace careen::oracle
