#include "render/overlay/names.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace careen {
namespace {

constexpr double kFadeSeconds = 0.1;
constexpr double kMostFadeFrames = 6;
constexpr std::size_t kMostDefaultNames = 16;  // above this number of boxes, default names are not shown

bool isSame(const OverlayMoment& a, const OverlayMoment& b) {
  return a.sceneTime == b.sceneTime && a.view.eye == b.view.eye &&
         a.view.clipFromOffset == b.view.clipFromOffset;
}

Ink faded(Ink ink, double strength) {
  ink.alpha *= strength;
  return ink;
}

void addName(OverlayShapes& shapes, const OverlayFrame& frame, const std::string& text,
             const NamePlaces& name, std::size_t place, double strength) {
  const NamePlace& at = name.at.at(place);
  Plate plate = plateFor(frame.style, at.min, at.min + name.size);
  plate.max = plate.min + name.size;
  if (place >= kPlacesOnBox) {
    const Vec2 start = at.end.cwiseMax(plate.min).cwiseMin(plate.max);
    const Stroke line{.from = start,
                      .to = at.end,
                      .width = 0.6 * frame.style.line,
                      .halo = frame.style.halo,
                      .ink = {kIvory, strength}};
    shapes.emplace_back(line);
    Stroke dot = line;
    dot.from = dot.to;
    dot.width = 1.8 * frame.style.line;
    shapes.emplace_back(dot);
  }
  plate.ink = faded(plate.ink, strength);
  shapes.emplace_back(plate);
  const double em = nameSize(frame.style);
  const double down = std::round(0.5 * (name.size.y() + frame.fonts->plain.capitalHeight(em)));
  shapes.emplace_back(
      Label{.text = text, .at = plate.min + Vec2(0.3 * em, down), .size = em, .ink = {kIvory, strength}});
}

}  // namespace

Names::Names(const Trajectory& run, double frameSeconds)
    : run_(run),
      frameSeconds_(frameSeconds),
      reach_(static_cast<std::int64_t>(
          std::clamp(std::round(kFadeSeconds / frameSeconds), 1.0, kMostFadeFrames))) {
  const std::vector<Body>& bodies = run.world.bodies;
  for (std::size_t body = 0; body < bodies.size(); ++body) {
    if (bodies.size() <= kMostDefaultNames || bodies[body].name != "box-" + std::to_string(body)) {
      named_.push_back(body);
    }
  }
}

void Names::learn(std::int64_t frame, const OverlayFrame& shown, const MomentAt& momentAt,
                  const FreeAt& freeAt) {
  const std::array<int, 2> size = {shown.screen.width(), shown.screen.height()};
  std::map<std::int64_t, OverlayMoment> needed;
  for (std::int64_t i = frame - 2 * reach_; i <= frame + 2 * reach_; ++i) {
    needed[i] = momentAt(static_cast<double>(i) * frameSeconds_);
  }
  const bool isOfAnother =
      size != pictureSize_ || std::any_of(known_.begin(), known_.end(), [&](const auto& each) {
        const auto now = needed.find(each.first);
        return now != needed.end() && !isSame(now->second, each.second.moment);
      });
  const auto isFar = [&](const auto& each) { return isOfAnother || !needed.contains(each.first); };
  std::erase_if(known_, isFar);
  std::erase_if(chosen_, isFar);
  pictureSize_ = size;
  for (const auto& [i, moment] : needed) {
    if (!known_.contains(i)) {
      known_[i] = {.moment = moment, .free = freeAt(moment)};
    }
  }
}

bool Names::staysFree(std::int64_t frame, std::size_t name, std::size_t place) const {
  for (std::int64_t i = frame - reach_; i <= frame + reach_; ++i) {
    if (!known_.at(i).free.of[name].at.at(place).isFree) {
      return false;
    }
  }
  return true;
}

bool Names::everCollide(std::int64_t frame, std::size_t a, std::size_t placeOfA, std::size_t b,
                        std::size_t placeOfB) const {
  for (std::int64_t i = frame - reach_; i <= frame + reach_; ++i) {
    const std::vector<NamePlaces>& places = known_.at(i).free.of;
    if (collide(places[a], placeOfA, places[b], placeOfB)) {
      return true;
    }
  }
  return false;
}

// Each takes the first place that stays free and is not taken, the nearest box first.
const std::vector<std::int8_t>& Names::chosenAt(std::int64_t frame) {
  const auto [entry, isNew] = chosen_.try_emplace(frame);
  std::vector<std::int8_t>& chosen = entry->second;
  if (!isNew) {
    return chosen;
  }
  chosen.assign(named_.size(), kNowhere);
  std::vector<std::size_t> placed;
  for (const std::size_t name : known_.at(frame).free.nearestFirst) {
    for (std::size_t place = 0; place < kNamePlaces && chosen[name] == kNowhere; ++place) {
      const auto isTaken = [&](std::size_t other) {
        return everCollide(frame, name, place, other, static_cast<std::size_t>(chosen[other]));
      };
      if (staysFree(frame, name, place) && std::none_of(placed.begin(), placed.end(), isTaken)) {
        chosen[name] = static_cast<std::int8_t>(place);
        placed.push_back(name);
      }
    }
  }
  return chosen;
}

// A name is as strong as the majority of the frames within reach that choose one place. Each of them found it
// free at this frame too; and two names of which both have a majority were chosen together in one of them, so
// that they do not cover each other.
void Names::add(OverlayShapes& shapes, const OverlayFrame& frame, double filmTime, const MomentAt& momentAt,
                const FreeAt& freeAt) {
  if (named_.empty()) {
    return;
  }
  const std::int64_t middle = std::llround(filmTime / frameSeconds_);
  learn(middle, frame, momentAt, freeAt);
  std::vector<std::array<std::int64_t, kNamePlaces>> votes(named_.size());
  for (std::int64_t i = middle - reach_; i <= middle + reach_; ++i) {
    const std::vector<std::int8_t>& chosen = chosenAt(i);
    for (std::size_t name = 0; name < named_.size(); ++name) {
      if (chosen[name] != kNowhere) {
        ++votes[name].at(static_cast<std::size_t>(chosen[name]));
      }
    }
  }
  const std::vector<NamePlaces> places = namePlaces(frame, named_);
  for (const std::size_t name : known_.at(middle).free.nearestFirst) {
    const auto most = std::max_element(votes[name].begin(), votes[name].end());
    const double strength = static_cast<double>(*most - reach_ - 1) / static_cast<double>(reach_);
    if (strength > 0) {
      addName(shapes, frame, run_.world.bodies[named_[name]].name, places[name],
              static_cast<std::size_t>(most - votes[name].begin()), strength);
    }
  }
}

constexpr OverlayKind kNamesOverlay = {
    .shows =
        "names of boxes, on what is seen of the box or beside it with a line to it; none for names like "
        "`box-17` if there are more than 16 boxes",
    .layer = OverlayLayer::kNames,
    .needs = OverlayNeeds::kNames,
    .add = [](OverlayShapes& shapes, const OverlayFrame& frame, const ShownOverlay& /*shown*/) {
      const NamesNow& now = *frame.names;
      now.names.add(shapes, frame, now.filmTime, now.momentAt, now.freeAt);
    }};

}  // namespace careen
