#pragma once

#include <cstdint>
#include <vector>

#include "physics/pile/crowd_articulations.h"
#include "physics/pile/crowd_contacts.h"
#include "physics/pile/crowd_depth.h"
#include "physics/pile/crowd_members.h"
#include "physics/pile/crowd_memory.h"
#include "physics/pile/projection.h"

namespace careen {

/// What pushes members of a crowd apart that are deep in each other.
class CrowdApart {
 public:
  CrowdApart(CrowdMembers& members, CrowdContacts& contacts, CrowdArticulations& articulations,
             CrowdDepth& depth, CrowdMemory& memory);

  /// A step begins, or is taken again.
  void begin() { projected_ = 0; }
  /// All that are near, every few steps; returns whether it was time for that.
  bool projectAll();
  /// Pushes apart the few that are deep after a step; returns whether that went well: on their way, too, and
  /// not through others. In a jam, where it fails again and again, it is not tried each time.
  bool mend();
  /// The same as far as it can be done. Where that does little, or where bodies would have to go through
  /// others to where they are pushed, all are held as they were before the step, or else left where they
  /// came. Returns how deep [m] any are then, on their way, too.
  double projectOnWay();

  /// [m] What the projections of this step left; 0 where there were none.
  double left() const { return projected_ > 0 ? left_ : 0; }
  /// Of all steps.
  std::int64_t passes() const { return passes_; }
  const PileProjection& projection() const { return projection_; }

 private:
  struct Kept {  // a body before a pass of the projection
    Vec3 position = Vec3::Zero();
    Quat attitude = Quat::Identity();
    double path = 0;    // [m]
    double turned = 0;  // [m]
  };
  enum class Aim : char { kApart, kHold };
  void beginProjection(Aim aim);
  void refreshGaps(PileManifold& manifold, PileProjection::Look look) const;
  double project(int passes);
  void closeJoints();
  void addGapsOfJoined(CrowdProblem& displacements);
  void keepPlaces();
  void restorePlaces();
  bool lookAtDeep(Aim aim);
  bool tryToMend();
  double deepestOnWay();

  CrowdMembers& members_;
  CrowdContacts& contacts_;
  CrowdArticulations& articulations_;
  CrowdDepth& depth_;
  CrowdMemory& memory_;
  PileProjection projection_;
  std::vector<Kept> kept_;  // where it left bodies least deep in each other
  double projected_ = 0;    // [m] how far it moved one in this step, at the most
  double left_ = 0;         // [m] by the last projection
  std::int64_t passes_ = 0;
};

}  // namespace careen
