#pragma once

#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "support/contact_oracles.h"
#include "support/quad_scene.h"

// Boxes on or before fixed boxes that move: in closed form between the changes.
namespace careen::oracle {

inline Quad frictionOf(const QuadBox& one, const QuadBox& other) {
  return sqrt(one.friction * other.friction);
}
inline Quad restitutionOf(const QuadBox& one, const QuadBox& other) {
  return one.restitution > other.restitution ? one.restitution : other.restitution;
}

/// Seen from what goes on evenly: pulled back to it, and thrown off by it with a part of its speed.
class QuadHops {
 public:
  QuadHops(Quad pull, Quad restitution) : pull_(std::move(pull)), restitution_(std::move(restitution)) {}

  const Quad& gap() const { return gap_; }
  /// Now what it is seen from goes faster, by that much, or slower.
  void jumps(const Quad& faster) {
    speed_ -= faster;
    if (gap_ == 0 && speed_ < 0) {
      speed_ *= -restitution_;
    }
  }
  void advance(Quad by) {
    while (gap_ > 0 || speed_ > 0) {
      const Quad arrives = sqrt(speed_ * speed_ + 2 * pull_ * gap_);
      const Quad lands = (speed_ + arrives) / pull_;
      if (lands > by) {
        gap_ += by * (speed_ - pull_ * by / 2);
        speed_ -= pull_ * by;
        return;
      }
      by -= lands;
      gap_ = 0;
      speed_ = restitution_ * arrives;
      if (2 * speed_ <= by * pull_ * (1 - restitution_)) {  // all of the hops that are left
        speed_ = 0;
      }
    }
  }

 private:
  Quad pull_;  // [m/s²]
  Quad restitution_;
  Quad gap_ = 0;
  Quad speed_ = 0;
};

/// On a lift that goes straight up and down along its path.
inline QuadPoses onLift(const QuadBox& box, const QuadBox& lift, const QuadVector& gravity,
                        std::span<const double> times) {
  if (abs(box.position[2] - box.halfExtents[2] - lift.position[2] - lift.halfExtents[2]) > Quad(1e-15)) {
    throw std::invalid_argument("does not stand on the lift");
  }
  QuadPoses poses;
  for (const double time : times) {
    QuadHops hops(-gravity[2], restitutionOf(box, lift));
    Quad now = 0;
    Quad speed = 0;
    Quad raised = 0;
    const auto advance = [&](const Quad& to) {
      hops.advance(to - now);
      raised += speed * (to - now);
      now = to;
    };
    for (std::size_t k = 0; k < lift.path.size() && lift.path[k].first < time; ++k) {
      const auto& [bends, place] = lift.path[k];
      advance(bends);
      const bool isLast = k + 1 == lift.path.size();
      const Quad next =
          isLast ? Quad(0) : Quad((lift.path[k + 1].second - place)[2] / (lift.path[k + 1].first - bends));
      hops.jumps(next - speed);
      speed = next;
    }
    advance(time);
    QuadVector position = box.position;
    position[2] += raised + hops.gap();
    poses.push_back({position, box.attitude});
  }
  return poses;
}

/// Before a plate that goes on along x, on a level floor: it slides forwards until it stands, or until the
/// plate meets it; from then on it is pulled back to the plate by friction, as it stops no more.
class QuadPushed {
 public:
  QuadPushed(const QuadBox& box, const QuadBox& plate, const QuadVector& gravity, const QuadWall& floor)
      : box_(box), plate_(plate), slows_(-frictionOf(box, floor) * gravity[2]) {
    const Quad gap = box.position[0] - box.halfExtents[0] - plate.position[0] - plate.halfExtents[0];
    const Quad faster = box.velocity[0] - plate.velocity[0];
    meets_ = (faster + sqrt(faster * faster + 2 * slows_ * gap)) / slows_;
    if (meets_ * slows_ > box.velocity[0]) {
      meets_ = (gap + box.velocity[0] * box.velocity[0] / (2 * slows_)) / plate.velocity[0];
    }
    metAt_ = slid(meets_).second;
  }

  QuadPoses poses(std::span<const double> times) const {
    QuadPoses poses;
    for (const double time : times) {
      QuadVector position = box_.position;
      if (time < meets_) {
        position[0] += slid(time).first;
      } else {
        QuadHops hops(slows_, restitutionOf(box_, plate_));
        hops.jumps(plate_.velocity[0] - metAt_);
        hops.advance(time - meets_);
        position[0] += slid(meets_).first + plate_.velocity[0] * (time - meets_) + hops.gap();
      }
      poses.push_back({position, box_.attitude});
    }
    return poses;
  }

  /// [J] of the plate, from the start to a time when it has come to push: whatever the impacts were, it gave
  /// the box its speed and what friction took since they met.
  Quad work(const Quad& time) const {
    const Quad& speed = plate_.velocity[0];
    return box_.mass * speed * (speed - metAt_ + slows_ * (time - meets_));
  }
  const Quad& meets() const { return meets_; }  ///< [s]

 private:
  // [m] and [m/s] of what no plate has met.
  std::pair<Quad, Quad> slid(const Quad& time) const {
    const Quad stands = box_.velocity[0] / slows_;
    const Quad t = time < stands ? time : stands;
    return {t * (box_.velocity[0] - slows_ * t / 2), box_.velocity[0] - slows_ * t};
  }

  QuadBox box_;
  QuadBox plate_;
  Quad slows_;  // [m/s²]
  Quad meets_;
  Quad metAt_;  // [m/s]
};

/// On a level table that swings along x. Its acceleration at the angle a of the swing is −swing sin a;
/// friction gives `most`. Where it slips, the slip's rate is 0 where sin a is ± most / swing, and between
/// such angles the slip has one root at the most.
class QuadNewmark {
 public:
  QuadNewmark(const QuadBox& box, const QuadBox& table, const QuadVector& gravity)
      : box_(box),
        amplitude_(table.amplitude[0]),
        rate_(table.rate),
        phase_(table.phase),
        most_(-frictionOf(box, table) * gravity[2]),
        ratio_(most_ / (amplitude_ * rate_ * rate_)),
        speed_(box.velocity[0]) {
    const Quad slip = speed_ - tableSpeed(0);
    slip == 0 ? chooses() : slips(slip > 0 ? 1 : -1);
  }

  /// At times that ascend.
  QuadPoses poses(std::span<const double> times) {
    QuadPoses poses;
    for (const double time : times) {
      while (ends_ < time) {
        advance(ends_);
        way_ == 0 ? slips(sideOfTurn()) : chooses();
        ++changes_;
      }
      advance(time);
      QuadVector position = box_.position;
      position[0] += moved_;
      poses.push_back({position, box_.attitude});
    }
    return poses;
  }
  /// How often it began to slip, to ride, or to slip the other way.
  int changes() const { return changes_; }

 private:
  Quad angle(const Quad& time) const { return rate_ * time + phase_; }
  Quad tableSpeed(const Quad& time) const { return amplitude_ * rate_ * cos(angle(time)); }

  // Ahead of a table that turns back.
  int sideOfTurn() const { return sin(angle(now_)) > 0 ? 1 : -1; }

  // Where it has the table's speed.
  void chooses() {
    if (abs(sin(angle(now_))) > ratio_) {
      slips(sideOfTurn());
      return;
    }
    way_ = 0;
    ends_ = 1e300;
    if (ratio_ < 1) {
      const Quad first = asin(ratio_);
      ends_ = (first + quadPi() * ceil((angle(now_) - first) / quadPi()) - phase_) / rate_;
    }
  }

  Quad slipAt(const Quad& time) const { return speed_ - way_ * most_ * (time - now_) - tableSpeed(time); }

  void slips(int way) {
    way_ = way;
    const Quad first = ratio_ < 1 ? Quad(asin(way * ratio_)) : Quad(0);
    const Quad turn = floor((angle(now_) - first) / (2 * quadPi()));
    Quad from = now_;
    for (Quad k = turn;; k += 1) {
      for (const Quad& each : {first, Quad(quadPi() - first)}) {
        const Quad to = (each + 2 * quadPi() * k - phase_) / rate_;
        // What has just begun to slip has none at its own angle.
        if (to > now_ + Quad(1e-25) && way * slipAt(to) <= 0) {
          ends_ = rootIn(from, to);
          return;
        }
        from = to > from ? to : from;
      }
    }
  }

  Quad rootIn(Quad from, Quad to) const {
    for (int halving = 0; halving < 240; ++halving) {
      const Quad middle = (from + to) / 2;
      (way_ * slipAt(middle) > 0 ? from : to) = middle;
    }
    return to;
  }

  void advance(const Quad& time) {
    const Quad by = time - now_;
    if (way_ == 0) {
      moved_ += amplitude_ * (sin(angle(time)) - sin(angle(now_)));
      speed_ = tableSpeed(time);
    } else {
      moved_ += by * (speed_ - way_ * most_ * by / 2);
      speed_ -= way_ * most_ * by;
    }
    now_ = time;
  }

  QuadBox box_;
  Quad amplitude_;  // [m]
  Quad rate_;
  Quad phase_;
  Quad most_;   // [m/s²]
  Quad ratio_;  // [1] of that and the largest of the table
  Quad now_ = 0;
  Quad ends_ = 0;  // [s] this way of moving
  Quad speed_;
  Quad moved_ = 0;
  int way_ = 0;  // of its slip, 0: it rides
  int changes_ = 0;
};

}  // namespace careen::oracle
