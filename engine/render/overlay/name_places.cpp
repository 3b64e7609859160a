#include "render/overlay/name_places.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/overlay/box_cells.h"

namespace careen {
namespace {

// On the box, in quarters of the size of the rectangle around it: the middle first.
constexpr std::array<std::array<int, 2>, kPlacesOnBox> kOnBox = {
    {{0, 0}, {0, -1}, {0, 1}, {1, 0}, {-1, 0}, {1, -1}, {-1, -1}, {1, 1}, {-1, 1}}};

// Beside it: towards which side, and where the line to it ends.
constexpr std::array<std::array<int, 2>, 4> kSides = {{{1, 0}, {-1, 0}, {0, -1}, {0, 1}}};
constexpr double kSpread = 0.25;   // [1] of the rectangle's size
constexpr double kGapToBox = 0.8;  // [em] from a box to a name beside it
constexpr double kBetween = 2;     // [px] from a name to another

struct Seen {
  Vec2 centre;
  Vec2 min;
  Vec2 max;
};

std::optional<Seen> seenAt(const OverlayFrame& frame, std::size_t body) {
  const Body& box = frame.trajectory.world.bodies[body];
  const Pose pose = boxPose(box, frame.states[body].pose);
  const std::optional<Vec2> centre = frame.screen.at(pose.position);
  if (!centre) {
    return std::nullopt;
  }
  Seen seen{.centre = *centre, .min = *centre, .max = *centre};
  for (int index = 0; index < kCorners; ++index) {
    const std::optional<Vec2> at = frame.screen.at(pose.worldPoint(corner(box.halfExtents, index)));
    if (!at) {
      return std::nullopt;
    }
    seen.min = seen.min.cwiseMin(*at);
    seen.max = seen.max.cwiseMax(*at);
  }
  return seen;
}

Vec2 spot(const Seen& seen, int across, int down) {
  return seen.centre + kSpread * Vec2(across, down).cwiseProduct(seen.max - seen.min);
}

// Ends of the line to a name on this side: near that side, in the middle, and near that side's corners.
std::array<Vec2, 4> endsTowards(const Seen& seen, const std::array<int, 2>& side) {
  const auto [x, y] = side;
  return {spot(seen, x, y), seen.centre, spot(seen, x + y, y + x), spot(seen, x - y, y - x)};
}

Vec2 minBeside(const Seen& seen, const std::array<int, 2>& side, const Vec2& end, const Vec2& size,
               double gap) {
  Vec2 min = end - 0.5 * size;
  for (int axis = 0; axis < 2; ++axis) {
    const int towards = side.at(static_cast<std::size_t>(axis));
    if (towards != 0) {
      min[axis] = towards > 0 ? seen.max[axis] + gap : seen.min[axis] - gap - size[axis];
    }
  }
  return min;
}

Vec2 nearestOn(const Plate& plate, const Vec2& point) {
  return point.cwiseMax(plate.min).cwiseMin(plate.max);
}

bool areApart(const Plate& a, const Plate& b) {
  return (a.min.array() >= b.max.array() + kBetween).any() ||
         (b.min.array() >= a.max.array() + kBetween).any();
}

// Liang and Barsky: whether a part of the line lies in the plate.
bool crosses(const Vec2& from, const Vec2& to, const Plate& plate) {
  double enter = 0;
  double leave = 1;
  for (int axis = 0; axis < 2; ++axis) {
    const double way = to[axis] - from[axis];
    const double toMin = plate.min[axis] - kBetween - from[axis];
    const double toMax = plate.max[axis] + kBetween - from[axis];
    if (way == 0) {
      leave = toMin <= 0 && toMax >= 0 ? leave : -1;
      continue;
    }
    enter = std::max(enter, std::min(toMin / way, toMax / way));
    leave = std::min(leave, std::max(toMin / way, toMax / way));
  }
  return enter <= leave;
}

bool lineCrosses(const NamePlaces& of, std::size_t place, const Plate& plate) {
  return place >= kPlacesOnBox &&
         crosses(nearestOn(of.plate(place), of.at.at(place).end), of.at.at(place).end, plate);
}

bool isFree(const NamePlaces& name, std::size_t place, std::int32_t body, const BoxCells& cells,
            const std::vector<Plate>& panels) {
  const Plate plate = name.plate(place);
  const bool isBeside = place >= kPlacesOnBox;
  const Vec2& end = name.at.at(place).end;
  return cells.showOnly(isBeside ? BoxCells::kNoBox : body, plate.min, plate.max) &&
         (!isBeside ||
          (cells.showOnly(body, end) && cells.lineMeetsOnly(body, nearestOn(plate, end), end))) &&
         std::none_of(panels.begin(), panels.end(), [&](const Plate& panel) {
           return !areApart(plate, panel) || lineCrosses(name, place, panel);
         });
}

}  // namespace

double nameSize(const OverlayStyle& style) {
  return std::max(std::min(kEasyText, style.text), 0.9 * style.text);
}

std::vector<NamePlaces> namePlaces(const OverlayFrame& frame, std::span<const std::size_t> named) {
  const double em = nameSize(frame.style);
  const double gap = kGapToBox * em;
  std::vector<NamePlaces> found(named.size());
  for (std::size_t i = 0; i < named.size(); ++i) {
    NamePlaces& name = found[i];
    const std::string& text = frame.trajectory.world.bodies[named[i]].name;
    name.size = Vec2(std::round(frame.fonts->plain.width(text, em) + 0.6 * em), std::round(1.25 * em));
    const std::optional<Seen> seen = seenAt(frame, named[i]);
    if (!seen) {  // outside the picture, where nothing is free
      name.at.fill({.min = -2 * name.size, .end = -name.size});
      continue;
    }
    std::size_t place = 0;
    for (const auto& [across, down] : kOnBox) {
      const Vec2 middle = spot(*seen, across, down);
      name.at.at(place++) = {.min = middle - 0.5 * name.size, .end = middle};
    }
    for (const std::array<int, 2>& side : kSides) {
      for (const Vec2& end : endsTowards(*seen, side)) {
        name.at.at(place++) = {.min = minBeside(*seen, side, end, name.size, gap), .end = end};
      }
    }
  }
  return found;
}

FreeNamePlaces freeNamePlaces(const OverlayFrame& frame, std::span<const std::size_t> named,
                              const std::vector<Plate>& panels) {
  std::vector<CellBox> boxes;
  for (std::size_t i = 0; i < frame.states.size(); ++i) {
    const Body& body = frame.trajectory.world.bodies[i];
    boxes.push_back({.pose = boxPose(body, frame.states[i].pose), .halfExtents = body.halfExtents});
  }
  const BoxCells cells(frame.screen, boxes);
  FreeNamePlaces names{.of = namePlaces(frame, named), .nearestFirst = {}};
  std::vector<std::optional<std::size_t>> indexOf(frame.states.size());
  for (std::size_t i = 0; i < named.size(); ++i) {
    indexOf[named[i]] = i;
    for (std::size_t place = 0; place < kNamePlaces; ++place) {
      names.of[i].at.at(place).isFree =
          isFree(names.of[i], place, static_cast<std::int32_t>(named[i]), cells, panels);
    }
  }
  for (auto body = frame.farthestFirst.rbegin(); body != frame.farthestFirst.rend(); ++body) {
    if (indexOf[*body]) {
      names.nearestFirst.push_back(*indexOf[*body]);
    }
  }
  return names;
}

bool collide(const NamePlaces& a, std::size_t placeOfA, const NamePlaces& b, std::size_t placeOfB) {
  const Plate ofA = a.plate(placeOfA);
  const Plate ofB = b.plate(placeOfB);
  return !areApart(ofA, ofB) || lineCrosses(a, placeOfA, ofB) || lineCrosses(b, placeOfB, ofA);
}

}  // namespace careen
