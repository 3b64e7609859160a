#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "physics/pile/reached_contacts.h"

namespace careen {

/// Restitution in a crowd's step, by the law of resolveImpact() as it is without friction: e G + (1−e) P, G
/// being generalized reflections and P the plastic projection. What it looks at is what the impulses reach.
///
/// A contact that does not strike begins at rest, or parting: what forces do in the step is carried by the
/// impulses of the step.
class CrowdRestitution {
 public:
  CrowdRestitution(const CrowdMembers& members, const CrowdContacts& contacts)
      : reached_(members, contacts) {}

  /// As ReachedContacts, whose points take part.
  void begin() { reached_.begin(); }
  void strike(int slot, int index, double approach) { reached_.strike(slot, index, approach); }
  /// Approach slower than `slow` [m/s] is no impact.
  void resolve(double slow);

  std::span<const ReachedPoint> points() const { return reached_.points(); }
  /// Their velocities: what restitution adds, e (G − P).
  std::span<const ReachedBody> bodies() const { return reached_.bodies(); }

 private:
  void restart();
  void findApproaching(std::vector<int>& approaching) const;
  std::vector<double> levels() const;
  void reflect(double threshold);
  void guess(std::span<const int> ofManifold);
  double solveAt(ReachedPoint& point);
  void project(std::span<const int> chosen);
  void projectAll(double most);
  double rubAt(ReachedPoint& point);
  void rub();

  ReachedContacts reached_;
  double slow_ = 0;
  std::size_t visits_ = 0;  // of points, in projections
  std::vector<int> front_;  // points that may approach
};

}  // namespace careen
