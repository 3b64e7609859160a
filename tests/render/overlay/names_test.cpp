#include "render/overlay/names.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "render/film/filming.h"
#include "render/overlay/overlays.h"
#include "render/rays.h"
#include "scene/scene_reader.h"
#include "view/camera.h"

namespace careen {
namespace {

// A name as it is drawn, and where its line ends, if it has one.
struct DrawnName {
  Plate plate;
  double strength = 0;
  std::optional<Vec2> end;
};

using DrawnNames = std::map<std::string, DrawnName>;

DrawnNames namesIn(const OverlayShapes& shapes) {
  DrawnNames names;
  DrawnName next;
  for (const OverlayShape& shape : shapes) {
    if (const Stroke* const stroke = std::get_if<Stroke>(&shape)) {
      next.end = stroke->to;
    } else if (const Plate* const plate = std::get_if<Plate>(&shape)) {
      next.plate = *plate;
    } else if (const Label* const label = std::get_if<Label>(&shape)) {
      next.strength = label->ink.alpha;
      EXPECT_TRUE(names.emplace(label->text, next).second) << label->text << " is there twice";
      next = {};
    }
  }
  return names;
}

// The names of a film, frame by frame, and what its pictures show by rays.
class NamedFilm {
 public:
  explicit NamedFilm(const Scene& scene)
      : run_(runOf(scene)),
        filming_(run_),
        overlays_(run_, OverlaySet::named("names"), run_.stage.picture.rate.frameTime(1)) {}

  std::int64_t frames() const { return run_.stage.picture.rate.frameCount(filming_.duration()); }
  const Trajectory& run() const { return run_; }
  const PictureSettings& picture() const { return run_.stage.picture; }

  OverlayMoment momentAt(double time) const {
    return {.sceneTime = filming_.sceneTime(time),
            .view = viewOf(filming_.camera(time), extentOf(run_), picture().aspect())};
  }
  DrawnNames names(std::int64_t frame) { return namesOf(overlays_, frame); }
  // By overlays that were asked for no other frame.
  DrawnNames namesAlone(std::int64_t frame) const {
    Overlays overlays(run_, OverlaySet::named("names"), picture().rate.frameTime(1));
    return namesOf(overlays, frame);
  }
  Rays rays(std::int64_t frame) const {
    const double time = picture().rate.frameTime(frame);
    return {run_, run_.poses(filming_.sceneTime(time)), filming_.camera(time)};
  }
  // Corners of the boxes in the picture, where they are in front of the camera.
  std::map<std::string, std::vector<std::optional<Vec2>>> corners(std::int64_t frame) const {
    const OverlayMoment moment = momentAt(picture().rate.frameTime(frame));
    const Screen screen(moment.view, picture().width, picture().height);
    const std::vector<Pose> poses = run_.poses(moment.sceneTime);
    std::map<std::string, std::vector<std::optional<Vec2>>> found;
    for (std::size_t box = 0; box < poses.size(); ++box) {
      const Body& body = run_.world.bodies[box];
      for (int index = 0; index < kCorners; ++index) {
        found[body.name].push_back(screen.at(poses[box].worldPoint(corner(body.halfExtents, index))));
      }
    }
    return found;
  }
  const std::string& nameOf(const Rays::Hit& hit) const {
    return run_.world.bodies[static_cast<std::size_t>(hit.thing)].name;
  }

 private:
  DrawnNames namesOf(Overlays& overlays, std::int64_t frame) const {
    return namesIn(overlays.shapesAt(
        picture().rate.frameTime(frame), [&](double time) { return momentAt(time); }, picture().width,
        picture().height));
  }

  Trajectory run_;
  Filming filming_;
  Overlays overlays_;
};

Scene shipped(const std::string& name) {
  return readScene(std::filesystem::path(CAREEN_SOURCE_DIR) / "assets/scenes" / (name + ".json"));
}

// A name on its box covers nothing else, one beside it no box; its line ends on the box.
void expectEachAtItsBox(const NamedFilm& film, std::int64_t frame, const DrawnNames& names) {
  const Rays rays = film.rays(frame);
  for (const auto& [text, name] : names) {
    const Vec2 size = name.plate.max - name.plate.min;
    for (const double across : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      for (const double down : {0.0, 0.5, 1.0}) {
        const Vec2 at = name.plate.min + Vec2(across * size.x(), down * size.y());
        const Rays::Hit hit = rays.seenAt(at.x(), at.y());
        if (name.end) {
          EXPECT_FALSE(hit.isBox()) << text << " covers " << film.nameOf(hit) << " in frame " << frame;
        } else {
          EXPECT_TRUE(hit.isBox() && film.nameOf(hit) == text) << text << " in frame " << frame;
        }
      }
    }
    if (name.end) {
      const Rays::Hit hit = rays.seenAt(name.end->x(), name.end->y());
      EXPECT_TRUE(hit.isBox() && film.nameOf(hit) == text) << text << " in frame " << frame;
    }
  }
}

void expectApart(const DrawnNames& names, std::int64_t frame) {
  for (auto a = names.begin(); a != names.end(); ++a) {
    for (auto b = std::next(a); b != names.end(); ++b) {
      const Plate& one = a->second.plate;
      const Plate& other = b->second.plate;
      EXPECT_TRUE((one.min.array() >= other.max.array()).any() ||
                  (other.min.array() >= one.max.array()).any())
          << a->first << " and " << b->first << " in frame " << frame;
    }
  }
}

// From one frame to the next a name moves no farther than the fastest corner of its box and a whole pixel,
// to which it is rounded, before and after; it comes and goes by a third of its strength at most.
void expectSmooth(const NamedFilm& film, std::int64_t frame, const DrawnNames& before,
                  const DrawnNames& after) {
  constexpr double kRounding = 1.5;          // [px]
  constexpr double kStep = 1.0 / 3 + 1e-12;  // at 30 frames per second
  const auto cornersBefore = film.corners(frame - 1);
  const auto cornersAfter = film.corners(frame);
  for (const auto& [text, name] : after) {
    const auto was = before.find(text);
    if (was == before.end()) {
      EXPECT_LE(name.strength, kStep) << text << " in frame " << frame;
      continue;
    }
    EXPECT_LE(std::abs(name.strength - was->second.strength), kStep) << text << " in frame " << frame;
    double moved = 0;
    for (std::size_t i = 0; i < kCorners; ++i) {
      moved = std::max(
          moved,
          (cornersAfter.at(text)[i].value() - cornersBefore.at(text)[i].value()).cwiseAbs().maxCoeff());
    }
    const double jump = (name.plate.min - was->second.plate.min).cwiseAbs().maxCoeff();
    EXPECT_LE(jump, moved + kRounding) << text << " in frame " << frame;
  }
  for (const auto& [text, name] : before) {
    EXPECT_TRUE(after.contains(text) || name.strength <= kStep) << text << " in frame " << frame;
  }
}

// Scene, and how many of its boxes have a name at least, in the mean of the frames.
using NamedScene = std::pair<std::string, double>;

class NamesOfShippedScenes : public testing::TestWithParam<NamedScene> {};

void expectSame(const DrawnNames& a, const DrawnNames& b, std::int64_t frame) {
  ASSERT_EQ(a.size(), b.size()) << "frame " << frame;
  for (const auto& [text, name] : a) {
    EXPECT_EQ(name.plate.min, b.at(text).plate.min) << text << " in frame " << frame;
    EXPECT_EQ(name.strength, b.at(text).strength) << text << " in frame " << frame;
  }
}

TEST_P(NamesOfShippedScenes, eachIsAtItsBoxAndMovesWithItWhateverWasDrawnBefore) {
  NamedFilm film(shipped(GetParam().first));
  DrawnNames before;
  std::size_t drawn = 0;
  for (std::int64_t frame = 0; frame < film.frames(); ++frame) {
    const DrawnNames names = film.names(frame);
    expectEachAtItsBox(film, frame, names);
    expectApart(names, frame);
    if (frame > 0) {
      expectSmooth(film, frame, before, names);
    }
    if (frame % 40 == 17) {
      expectSame(names, film.namesAlone(frame), frame);
    }
    if (HasFailure()) {
      return;
    }
    drawn += names.size();
    before = names;
  }
  const double most =
      static_cast<double>(film.frames()) * static_cast<double>(film.run().world.bodies.size());
  EXPECT_GT(static_cast<double>(drawn) / most, GetParam().second);  // measured .89 and .151
}

INSTANTIATE_TEST_SUITE_P(Names, NamesOfShippedScenes,
                         testing::Values(NamedScene{"stack", 0.85}, NamedScene{"gas", 0.14}),
                         [](const auto& instance) { return instance.param.first; });

}  // namespace
}  // namespace careen
