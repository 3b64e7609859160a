#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "render/overlay/frame.h"

namespace careen {

/// Places for a box's name: first on the box, then beside it with a line to it. Each moves as the box and the
/// rectangle around it in the picture do.
inline constexpr std::size_t kPlacesOnBox = 9;
inline constexpr std::size_t kPlacesBeside = 16;
inline constexpr std::size_t kNamePlaces = kPlacesOnBox + kPlacesBeside;

struct NamePlace {
  Vec2 min = Vec2::Zero();  ///< [px] upper left corner of the name's plate
  Vec2 end = Vec2::Zero();  ///< [px] of the line, on the box
  bool isFree = false;      ///< no box is covered but its own, where that is seen, and no panel
};

struct NamePlaces {
  Vec2 size = Vec2::Zero();  ///< [px] of the plate
  std::array<NamePlace, kNamePlaces> at{};

  Plate plate(std::size_t place) const {
    return {.min = at.at(place).min, .max = at.at(place).min + size, .ink = {}};
  }
};

/// Size of the letters of names [px].
double nameSize(const OverlayStyle& style);

/// Places for the names of these bodies, not asked whether they are free.
std::vector<NamePlaces> namePlaces(const OverlayFrame& frame, std::span<const std::size_t> named);

/// The same, with those marked that are free.
struct FreeNamePlaces {
  std::vector<NamePlaces> of;             ///< in the order of the bodies asked for
  std::vector<std::size_t> nearestFirst;  ///< indices of these
};
FreeNamePlaces freeNamePlaces(const OverlayFrame& frame, std::span<const std::size_t> named,
                              const std::vector<Plate>& panels);

/// Whether two names, with their lines, would cover each other at these places.
bool collide(const NamePlaces& a, std::size_t placeOfA, const NamePlaces& b, std::size_t placeOfB);

}  // namespace careen
