#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "render/overlay/frame.h"
#include "render/overlay/name_places.h"

namespace careen {

/// What a film shows at a moment.
struct OverlayMoment {
  double sceneTime = 0;  ///< [s] within the run
  View view;
};
using MomentAt = std::function<OverlayMoment(double filmTime)>;

/// The names of boxes. A name fades in where its place stays free of other boxes, names and panels for some
/// frames before and after, and fades out before that ends; in between it moves with its box. So it neither
/// jumps nor flickers, yet depends on the film alone: what was drawn before is kept only to save time.
class Names {
 public:
  /// Of boxes that were given a name; of all, if they are few. Keeps a reference to the run.
  Names(const Trajectory& run, double frameSeconds);

  const std::vector<std::size_t>& bodies() const { return named_; }

  using FreeAt = std::function<FreeNamePlaces(const OverlayMoment& moment)>;

  /// Adds the names at `filmTime` [s], where the film shows `frame`.
  void add(OverlayShapes& shapes, const OverlayFrame& frame, double filmTime, const MomentAt& momentAt,
           const FreeAt& freeAt);

 private:
  static constexpr std::int8_t kNowhere = -1;
  struct Known {
    OverlayMoment moment;
    FreeNamePlaces free;
  };
  void learn(std::int64_t frame, const OverlayFrame& shown, const MomentAt& momentAt, const FreeAt& freeAt);
  const std::vector<std::int8_t>& chosenAt(std::int64_t frame);
  bool staysFree(std::int64_t frame, std::size_t name, std::size_t place) const;
  bool everCollide(std::int64_t frame, std::size_t a, std::size_t placeOfA, std::size_t b,
                   std::size_t placeOfB) const;

  const Trajectory& run_;
  double frameSeconds_;
  std::int64_t reach_;  // [frames] of a fade
  std::vector<std::size_t> named_;
  std::array<int, 2> pictureSize_{};
  std::map<std::int64_t, Known> known_;
  std::map<std::int64_t, std::vector<std::int8_t>> chosen_;  // each name's place
};

/// What names need beside the frame.
struct NamesNow {
  Names& names;
  double filmTime;  ///< [s]
  const MomentAt& momentAt;
  const Names::FreeAt& freeAt;
};

}  // namespace careen
