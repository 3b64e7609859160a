#include "audit/passage.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/world/body.h"

namespace careen {
namespace {

constexpr double kOfFall = 1.0 / 64;        // as in the ledger: of what falling by its own size would give
constexpr std::size_t kDoubtful = 3;        // rows beside a contact whose estimated velocities may be off
constexpr double kLongestStep = 1.0 / 180;  // [s] of crowds
constexpr double kUlpsOfSums = 4096 * std::numeric_limits<double>::epsilon();

class Sums {
 public:
  Sums(const Trajectory& run, std::size_t index, const std::vector<Passage>& passages, double fallingSpeed,
       Findings& findings)
      : body_(run.world.bodies[index]),
        index_(index),
        segments_(run.tracks[index].segments.unpacked()),
        passages_(passages),
        findings_(findings) {
    momentum_ = std::max(kOfFall * body_.mass.mass * fallingSpeed, std::numeric_limits<double>::min());
    angular_ = std::max(momentum_ * body_.halfExtents.norm(), std::numeric_limits<double>::min());
    for (const Segment& segment : segments_) {
      const SampledStep& step = std::get<SampledStep>(segment.motion);
      momentum_ = std::max({momentum_, body_.mass.mass * step.start.velocity.norm(),
                            body_.mass.mass * step.end.velocity.norm()});
      angular_ = std::max({angular_, step.start.angularMomentum.norm(), step.end.angularMomentum.norm()});
      far_ = std::max(far_, step.end.pose.position.norm());
    }
    // Speeds may be means over a step of the program that made the table; estimates are off beside impacts.
    const bool isKnown = run.given->velocities && run.given->angularVelocities;
    const double shortest = run.settings.duration / static_cast<double>(passages.size());
    beside_ = std::max<std::size_t>(
        isKnown ? 0 : kDoubtful, static_cast<std::size_t>(std::ceil(std::min(kLongestStep / shortest, 1e6))));
  }

  void addAll();

 private:
  bool isSettled(std::size_t row) const;
  void addTouch(std::size_t row);
  void addFlight(std::size_t row);
  void report(AuditKind kind, std::size_t row, double amount, double rounding);

  const Body& body_;
  std::size_t index_;
  const std::vector<Segment>& segments_;
  const std::vector<Passage>& passages_;
  Findings& findings_;
  double momentum_ = 0;            // [kg m/s] the largest
  double angular_ = 0;             // [kg m²/s] likewise
  double far_ = 0;                 // [m]
  std::size_t beside_ = 0;         // rows within the same step
  Passage sum_;                    // since it flies, or touches, without a break
  std::vector<double> frictions_;  // [N s] likewise
};

bool Sums::isSettled(std::size_t row) const {
  const auto from = passages_.begin() + static_cast<std::ptrdiff_t>(row - std::min(row, beside_));
  const auto to =
      passages_.begin() + static_cast<std::ptrdiff_t>(std::min(row + beside_ + 1, passages_.size()));
  return std::all_of(from, to, [&](const Passage& each) { return each.kind == passages_[row].kind; });
}

void Sums::report(AuditKind kind, std::size_t row, double amount, double rounding) {
  const SampledStep& step = std::get<SampledStep>(segments_[row].motion);
  findings_.add(
      kind, rounding,
      {.size = amount, .time = segments_[row].start + step.duration, .bodies = {index_}, .wall = {}});
}

void Sums::addTouch(std::size_t row) {
  const Passage& now = passages_[row];
  sum_.missing = now.missing ? std::max(0.0, sum_.missing.value_or(0) + *now.missing) : 0;
  sum_.surplus = std::max(0.0, sum_.surplus + now.surplus);
  frictions_.push_back(std::max(*sum_.missing, sum_.surplus));
  if (frictions_.size() > beside_) {
    const auto last = frictions_.end() - static_cast<std::ptrdiff_t>(beside_) - 1;
    const double lasting = *std::min_element(last, frictions_.end());
    report(AuditKind::kFriction, row, lasting / momentum_, kUlpsOfSums);
  }
}

void Sums::addFlight(std::size_t row) {
  const Passage& now = passages_[row];
  sum_.impulse += now.impulse;
  sum_.angularImpulse += now.angularImpulse;
  sum_.way += now.way;
  sum_.turn += now.turn;
  const double size = body_.halfExtents.norm();
  const double rounding = kUlpsOfSums * (1 + far_ / size);
  report(AuditKind::kLinearMomentum, row, sum_.impulse.norm() / momentum_, rounding);
  report(AuditKind::kAngularMomentum, row, sum_.angularImpulse.norm() / angular_, rounding);
  report(AuditKind::kContinuity, row, sum_.way.norm() + size * sum_.turn.norm(), rounding * size);
}

void Sums::addAll() {
  for (std::size_t row = 0; row < passages_.size(); ++row) {
    const Passage::Kind kind = passages_[row].kind;
    const bool counts = kind != Passage::Kind::kUnknown && isSettled(row);
    if (!counts || kind != sum_.kind) {
      sum_ = {.kind = kind};
      frictions_.clear();
    }
    if (counts) {
      kind == Passage::Kind::kTouched ? addTouch(row) : addFlight(row);
    }
  }
}

}  // namespace

void addUp(const Trajectory& run, std::size_t body, const std::vector<Passage>& passages, double fallingSpeed,
           Findings& findings) {
  if (passages.empty()) {
    return;
  }
  Sums sums(run, body, passages, fallingSpeed, findings);
  sums.addAll();
}

}  // namespace careen
