#include "render/overlay/overlays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "core/error.h"
#include "render/stage.h"
#include "scene/plan.h"
#include "view/scene_extent.h"

namespace careen {
namespace {

constexpr int kWidth = 1280;
constexpr int kHeight = 720;
constexpr double kFrame = 1.0 / 30;
constexpr const char* kPanels = "time,energy,velocity,spin-axis,angular-momentum,impulses";

// The crate's room seen straight on from 10 m in front of y = 0, 60° upward.
Scene roomStraightOn() {
  Scene scene = crateInRoom();
  scene.camera = cameraAt(Vec3(0, -10, 1.5), Vec3(0, 0, 1.5), 60);
  return scene;
}
const double kPixels = 360 / std::tan(std::numbers::pi / 6) / 10;  // to the metre at y = 0

Vec2 onPicture(const Vec3& point) {
  const double scale = kPixels * 10 / (point.y() + 10);
  return {640 + scale * point.x(), 360 - scale * (point.z() - 1.5)};
}

bool overlap(const Plate& a, const Plate& b) {
  return (a.min.array() < b.max.array()).all() && (b.min.array() < a.max.array()).all();
}

class OverlaysTest : public testing::Test {
 protected:
  OverlayShapes shapesAt(const std::string& names, double time, int width = kWidth,
                         int height = kHeight) const {
    const Trajectory run = shown();
    Overlays overlays(run, OverlaySet::named(names), kFrame);
    const double aspect = static_cast<double>(width) / height;
    const View view = viewOf(*scene_.camera, extentOf(run), aspect);
    const auto momentAt = [&](double filmTime) {
      return OverlayMoment{.sceneTime = std::clamp(filmTime, 0.0, run.settings.duration), .view = view};
    };
    return overlays.shapesAt(time, momentAt, width, height);
  }
  template <class Shape>
  static std::vector<Shape> only(const OverlayShapes& shapes) {
    std::vector<Shape> found;
    for (const OverlayShape& each : shapes) {
      if (const Shape* const shape = std::get_if<Shape>(&each)) {
        found.push_back(*shape);
      }
    }
    return found;
  }
  // Arrows of one overlay; the legend's, which come last, are not among them.
  std::vector<Stroke> arrows(const std::string& name, double time) const {
    std::vector<Stroke> found = only<Stroke>(shapesAt(name, time));
    found.pop_back();
    return found;
  }
  // The run with the scene's boxes as they are now.
  Trajectory shown() const {
    Trajectory run = shownAs(scene_, run_);
    run.world = setupOf(scene_).world;
    return run;
  }
  void simulate() { run_ = runOf(scene_); }
  void fall() {
    scene_.gravity = Vec3(0, 0, -10);
    scene_.room->material.restitution = 0.5;
    scene_.boxes[0] = boxAt(Vec3(0, 0, 1), Vec3(0.3, 0.3, 0.2));
    simulate();
  }
  void strike(double time, double impulse) {
    run_.impacts.push_back({.time = time,
                            .a = {0},
                            .b = Partner::ofWall(0),
                            .point = Vec3(1, 0, 1),
                            .normal = Vec3(-1, 0, 0),
                            .impulse = impulse});
  }

  Scene scene_ = roomStraightOn();
  Trajectory run_ = drifting(scene_, Vec3(1, 0, 0.5));
};

void expectNear(const Vec2& found, const Vec2& expected, double tolerance = 1e-6) {
  EXPECT_LT((found - expected).norm(), tolerance) << found.transpose() << "; " << expected.transpose();
}

TEST_F(OverlaysTest, velocityPointsWhereTheBoxGoes) {
  const std::vector<Stroke> found = arrows("velocity", 0.5);
  ASSERT_EQ(found.size(), 1U);
  expectNear(found[0].from, onPicture(Vec3(0.5, 0, 1.25)));
  // The film's largest speed, at right angles to the line of sight: the longest arrow.
  expectNear(found[0].to - found[0].from, 0.2 * kHeight * Vec2(1, -0.5).normalized());
}

TEST_F(OverlaysTest, angularMomentumAndSpinPointAlongThem) {
  std::get<EulerStep>(run_.tracks[0].segments[0].motion).start.angularMomentum = Vec3(0, 0, 0.3);
  const std::vector<Stroke> momentum = arrows("angular-momentum", 0);
  ASSERT_EQ(momentum.size(), 1U);
  expectNear(momentum[0].to - momentum[0].from, Vec2(0, -0.2 * kHeight), 1e-2);
  const std::vector<Stroke> spin = arrows("spin-axis", 0);
  ASSERT_EQ(spin.size(), 2U);  // backwards, then the arrow
  const Vec3 omega = angularVelocity(run_.world.bodies[0].mass, run_.state(0, 0));
  const Vec2 way = spin[1].to - spin[1].from;
  const Vec2 expected = onPicture(Vec3(0, 0, 1) + 1e-6 * omega) - onPicture(Vec3(0, 0, 1));
  EXPECT_NEAR(way.normalized().dot(expected.normalized()), 1, 1e-6);
  EXPECT_LT(way.dot(spin[0].to - spin[0].from), 0);
}

TEST_F(OverlaysTest, impulseFadesAndVanishes) {
  strike(0.2, 3);
  strike(0.6, 1.5);
  EXPECT_TRUE(arrows("impulses", 0.199).empty());
  for (const double age : {0.0, 0.05, 0.2}) {
    const std::vector<Stroke> found = arrows("impulses", 0.2 + age);
    ASSERT_EQ(found.size(), 1U) << age;
    EXPECT_NEAR(found[0].ink.alpha, 1 - age / (kImpactFrames * kFrame), 1e-9);
    expectNear(found[0].from, onPicture(Vec3(1, 0, 1)));
    expectNear(found[0].to - found[0].from, Vec2(-0.2 * kHeight, 0));
  }
  EXPECT_TRUE(arrows("impulses", 0.2 + kImpactFrames * kFrame + 1e-9).empty());
  expectNear(arrows("impulses", 0.6)[0].to - arrows("impulses", 0.6)[0].from, Vec2(-0.1 * kHeight, 0));
}

TEST_F(OverlaysTest, otherBoxGetsTheImpulseTheOtherWay) {
  strike(0.2, 3);
  scene_.boxes.push_back(boxAt(Vec3(1, 1, 1), Vec3(0.1, 0.1, 0.1)));
  run_.tracks.push_back({.segments = {{.start = 0, .motion = Rest{}}}});
  run_.impacts[0].b = Partner::ofBody(1);
  const std::vector<Stroke> found = arrows("impulses", 0.2);
  ASSERT_EQ(found.size(), 2U);
  expectNear(found[0].to - found[0].from, found[1].from - found[1].to);
}

TEST_F(OverlaysTest, contactIsMarkedWithItsNormal) {
  strike(0.2, 3);
  const std::vector<Stroke> found = only<Stroke>(shapesAt("contacts", 0.2));
  ASSERT_EQ(found.size(), 2U);
  expectNear(found[0].from, onPicture(Vec3(1, 0, 1)));
  EXPECT_LT(found[0].to.x(), found[0].from.x() - 20);
  EXPECT_NEAR(found[0].to.y(), found[0].from.y(), 1e-9);
  expectNear(found[1].from, onPicture(Vec3(1, 0, 1)));
  EXPECT_EQ(found[1].from, found[1].to);
  EXPECT_TRUE(shapesAt("contacts", 0.9).empty());
}

// Arrows and trails of nearer boxes lie over those of farther ones, whatever the order of the boxes.
TEST_F(OverlaysTest, whatIsNearerIsDrawnOverWhatIsBehind) {
  for (const bool isFarther : {true, false}) {
    scene_ = roomStraightOn();
    scene_.boxes.push_back(boxAt(Vec3(0.5, isFarther ? 1 : -1, 1), Vec3(0.1, 0.1, 0.1)));
    scene_.boxes.back().name = "other";
    run_ = drifting(scene_, Vec3(1, 0, 0.5));
    run_.tracks.push_back(run_.tracks[0]);
    std::get<EulerStep>(run_.tracks[1].segments[0].motion).start.pose = scene_.boxes[1].pose;
    const Vec2 other = onPicture(scene_.boxes[1].pose.position);
    const std::vector<Stroke> found = arrows("velocity", 0);
    ASSERT_EQ(found.size(), 2U);
    expectNear(found[isFarther ? 0 : 1].from, other);
    const std::vector<Ribbon> trails = only<Ribbon>(shapesAt("trail", 1));
    ASSERT_EQ(trails.size(), 4U);
    const auto length = [](const Ribbon& ribbon) {
      return (ribbon.points.back().at - ribbon.points.front().at).norm();
    };
    EXPECT_LT(length(trails[0]), length(trails[3]));  // as seen in perspective
  }
}

// How strong a point of a trail is tells its time: there and then the corner was.
TEST_F(OverlaysTest, trailGoesThroughTheCornersPlaces) {
  scene_.duration = 3;
  scene_.boxes[0].velocity = Vec3(2, 0.3, 1);
  scene_.boxes[0].angularVelocity = Vec3(3, 7, -2);
  simulate();
  ASSERT_FALSE(run_.impacts.empty());
  for (const double time : {0.4, 2.5}) {
    const std::vector<Ribbon> ribbons = only<Ribbon>(shapesAt("trail", time));
    ASSERT_EQ(ribbons.size(), 2U);  // its dark rim and itself
    for (const Ribbon& ribbon : ribbons) {
      EXPECT_GT(ribbon.points.size(), 40U);
      for (const RibbonPoint& point : ribbon.points) {
        const double then = std::max(0.0, time - (1 - point.strength) * kTrailSeconds);
        expectNear(point.at, onPicture(run_.state(0, then).pose.worldPoint(Vec3(0.5, 0.3, 0.2))), 1e-5);
      }
      EXPECT_NEAR(ribbon.points.front().strength, 1 - std::min(time, kTrailSeconds) / kTrailSeconds, 1e-12);
      EXPECT_EQ(ribbon.points.back().strength, 1);
    }
  }
}

TEST_F(OverlaysTest, whatRestsLeavesNoTrail) {
  run_ = drifting(scene_, Vec3::Zero());
  EXPECT_TRUE(shapesAt("trail", 0.7).empty());
}

// Wider than the crate, so beside it, with a line that ends on it and a dot there.
TEST_F(OverlaysTest, nameStandsBesideItsBox) {
  scene_.boxes[0].name = "Kiste ü";
  const OverlayShapes shapes = shapesAt("names", 0);
  ASSERT_EQ(shapes.size(), 4U);
  const Stroke line = std::get<Stroke>(shapes[0]);
  const Stroke dot = std::get<Stroke>(shapes[1]);
  const Plate plate = std::get<Plate>(shapes[2]);
  const Label label = std::get<Label>(shapes[3]);
  EXPECT_EQ(label.text, "Kiste ü");
  for (int index = 0; index < kCorners; ++index) {
    const Vec3 point = scene_.boxes[0].pose.worldPoint(corner(scene_.boxes[0].halfExtents, index));
    EXPECT_GT(plate.min.x(), onPicture(point).x());
  }
  EXPECT_EQ(line.from.x(), plate.min.x());
  EXPECT_EQ(line.to, dot.to);
  EXPECT_EQ(dot.from, dot.to);
  EXPECT_LT((line.to - onPicture(scene_.boxes[0].pose.position)).norm(), 0.5 * kPixels);
  const double width = findFont(kPlainFont).width(label.text, label.size);
  EXPECT_GT(label.at.x(), plate.min.x());
  EXPECT_LT(label.at.x() + width, plate.max.x());
}

TEST_F(OverlaysTest, namesDoNotCoverEachOther) {
  for (const char* name : {"second", "third", "fourth"}) {
    scene_.boxes.push_back(scene_.boxes[0]);
    scene_.boxes.back().name = name;
    run_.tracks.push_back(run_.tracks.back());
    std::get<EulerStep>(run_.tracks.back().segments[0].motion).start.pose.position.x() += 1;
  }
  const std::vector<Plate> plates = only<Plate>(shapesAt("names", 0));
  ASSERT_EQ(plates.size(), 4U);
  for (std::size_t i = 0; i < plates.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_FALSE(overlap(plates[i], plates[j])) << i << ' ' << j;
    }
  }
}

TEST_F(OverlaysTest, namesKeepClearOfThePanels) {
  std::get<EulerStep>(run_.tracks[0].segments[0].motion).start.pose.position = Vec3(-9, 0, 6.44);
  const std::vector<Plate> alone = only<Plate>(shapesAt("names", 0));
  const std::vector<Plate> both = only<Plate>(shapesAt("time,names", 0));
  ASSERT_EQ(alone.size(), 1U);
  ASSERT_EQ(both.size(), 2U);
  EXPECT_TRUE(overlap(both[0], alone[0]));
  EXPECT_FALSE(overlap(both[0], both[1]));
}

// As when the mouse turns the camera, or a still has another size.
TEST_F(OverlaysTest, namesStandWhereTheViewAskedForHasThem) {
  const Trajectory run = shown();
  const auto platesOf = [&](Overlays& overlays, const Camera& camera, int width) {
    const View view = viewOf(camera, extentOf(run), 16.0 / 9);
    const auto momentAt = [&](double /*filmTime*/) { return OverlayMoment{.sceneTime = 0, .view = view}; };
    return only<Plate>(overlays.shapesAt(0, momentAt, width, width * 9 / 16));
  };
  const Camera turned = cameraAt(Vec3(3, -9, 2), Vec3(-1, 0, 1), 20);  // near: on the box, not beside it
  Overlays overlays(run, OverlaySet::named("names"), kFrame);
  Overlays other(run, OverlaySet::named("names"), kFrame);
  Overlays larger(run, OverlaySet::named("names"), kFrame);
  platesOf(overlays, *scene_.camera, kWidth);
  const std::vector<Plate> near = platesOf(overlays, turned, kWidth);
  const std::vector<Plate> expected = platesOf(other, turned, kWidth);
  ASSERT_EQ(near.size(), 1U);
  ASSERT_EQ(expected.size(), 1U);
  EXPECT_EQ(near[0].min, expected[0].min);
  EXPECT_EQ(platesOf(overlays, *scene_.camera, 640).at(0).min,
            platesOf(larger, *scene_.camera, 640).at(0).min);
}

TEST_F(OverlaysTest, timeCodeTellsTheScenesTime) {
  EXPECT_EQ(timeCode(0), "00:00:00.000");
  EXPECT_EQ(timeCode(1.234), "00:00:01.234");
  EXPECT_EQ(timeCode(59.9996), "00:01:00.000");
  EXPECT_EQ(timeCode(3600 * 12 + 34 * 60 + 56.789), "12:34:56.789");
  const std::vector<Label> labels = only<Label>(shapesAt("time", 0.5));
  ASSERT_EQ(labels.size(), 1U);
  EXPECT_EQ(labels[0].text, "00:00:00.500");
  EXPECT_EQ(labels[0].typeface, Typeface::kMonospaced);
}

// 0.8 m above the floor under 10 m/s²: after 0.2 s a quarter of the energy is motion, after the impact at 0.4
// s three quarters are lost.
TEST_F(OverlaysTest, barsAreAsLongAsTheirEnergies) {
  fall();
  const auto barsAt = [&](double time) {
    const std::vector<Plate> plates = only<Plate>(shapesAt("energy", time));
    std::array<double, 4> ends{};  // of lost, potential, rotation, kinetic: as they are drawn
    for (std::size_t i = 0; i < ends.size(); ++i) {
      EXPECT_EQ(plates.at(i + 1).min, plates.at(1).min);
      ends.at(i) = plates.at(i + 1).max.x() - plates.at(1).min.x();
    }
    EXPECT_GT(plates[1].hatching, 0);
    return ends;
  };
  const auto falling = barsAt(0.2);
  const double whole = falling[0];
  EXPECT_NEAR(falling[3], 0.25 * whole, 1e-9 * whole);
  EXPECT_NEAR(falling[2], falling[3], 1e-9 * whole);  // nothing turns
  EXPECT_NEAR(falling[1], whole, 1e-9 * whole);       // nothing is lost
  const auto bounced = barsAt(0.5);
  EXPECT_NEAR(bounced[1], 0.25 * whole, 1e-9 * whole);
  EXPECT_NEAR(bounced[0], whole, 1e-9 * whole);
  const std::vector<Label> labels = only<Label>(shapesAt("energy", 0.5));
  std::vector<std::string> texts;
  texts.reserve(labels.size());
  for (const Label& label : labels) {
    texts.push_back(label.text);
  }
  // Up at 2 m/s from 0.4 s on: 1 m/s and 0.15 m at 0.5 s.
  EXPECT_EQ(texts, (std::vector<std::string>{"kinetic", "0.500 J", "rotation", "0.000 J", "potential",
                                             "1.500 J", "sum", "2.000 J", "lost", "6.000 J"}));
}

TEST_F(OverlaysTest, roundValuesAreEasilyRead) {
  EXPECT_DOUBLE_EQ(roundValue(10), 5);
  EXPECT_DOUBLE_EQ(roundValue(8), 2);
  EXPECT_DOUBLE_EQ(roundValue(0.003), 0.001);
  EXPECT_DOUBLE_EQ(roundValue(1e6), 5e5);
}

TEST_F(OverlaysTest, legendSaysHowLongAnArrowOfARoundValueIs) {
  run_ = drifting(scene_, Vec3(10, 0, 0));
  const OverlayShapes shapes = shapesAt("velocity", 0);
  EXPECT_EQ(only<Label>(shapes).back().text, "velocity  5 m/s");
  const Stroke sample = only<Stroke>(shapes).back();
  EXPECT_NEAR((sample.to - sample.from).norm(), 0.5 * 0.2 * kHeight, 1e-9);
}

TEST_F(OverlaysTest, sizesGrowWithThePictureAndNeverGetTooSmallToRead) {
  EXPECT_NEAR(OverlayStyle(2160).text, 3 * OverlayStyle(720).text, 1e-9);
  EXPECT_EQ(OverlayStyle(360).text, 12);
  EXPECT_EQ(OverlayStyle(240).text, 8);
  EXPECT_EQ(OverlayStyle(36).text, 8);
}

TEST_F(OverlaysTest, everythingStaysOnThePictureThatStandsAtItsEdges) {
  for (const auto& [width, height] : {std::pair{64, 36},
                                      {160, 90},
                                      {160, 120},
                                      {320, 180},
                                      {640, 360},
                                      {1280, 720},
                                      {3840, 2160},
                                      {120, 900}}) {
    for (const Plate& plate : only<Plate>(shapesAt(kPanels, 0.5, width, height))) {
      EXPECT_GE(plate.min.minCoeff(), 0);
      EXPECT_LE(plate.max.x(), width);
      EXPECT_LE(plate.max.y(), height);
    }
  }
}

TEST_F(OverlaysTest, panelsCoverAQuarterOfThePictureAtMost) {
  fall();
  for (int height = 20; height <= 400; height += 10) {
    for (const int width : {height / 2, height * 4 / 3, height * 16 / 9, 4 * height}) {
      const std::vector<Plate> plates = only<Plate>(shapesAt(kPanels, 0.5, width, height));
      int covered = 0;
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          covered += std::any_of(plates.begin(), plates.end(), [&](const Plate& plate) {
            return x >= plate.min.x() && x < plate.max.x() && y >= plate.min.y() && y < plate.max.y();
          });
        }
      }
      EXPECT_LE(covered, 0.25 * width * height) << width << 'x' << height;
    }
  }
}

// What has no room is left out as a whole, the time last.
TEST_F(OverlaysTest, panelsForWhichThereIsNoRoomAreLeftOut) {
  fall();
  const auto textsAt = [&](int width, int height) {
    std::set<std::string> texts;
    for (const Label& label : only<Label>(shapesAt("time,energy,velocity", 0.5, width, height))) {
      texts.insert(label.text.substr(0, label.text.find(' ')));
    }
    return texts;
  };
  const std::string time = "00:00:00.500";
  EXPECT_EQ(textsAt(64, 36), (std::set<std::string>{}));
  EXPECT_EQ(textsAt(160, 120), (std::set<std::string>{time}));
  for (const auto& [width, height] : {std::pair{320, 180}, {640, 360}}) {
    const std::set<std::string> texts = textsAt(width, height);
    EXPECT_EQ(texts.count(time), 1U) << height;
    EXPECT_EQ(texts.count("kinetic"), 1U) << height;
    EXPECT_EQ(texts.count("velocity"), 1U) << height;
  }
}

TEST_F(OverlaysTest, onlyWhatIsShownIsLookedFor) {
  const auto scalesWith = [&](const std::string& names) {
    return Overlays(run_, OverlaySet::named(names), kFrame).scales().speed;
  };
  EXPECT_EQ(scalesWith("time,energy,trail,names,contacts"), 0);
  EXPECT_GT(scalesWith("velocity"), 0);
}

TEST_F(OverlaysTest, fontIsNeededOnlyForWhatIsWritten) {
  const std::array<std::filesystem::path, 1> nowhere = {"/nowhere"};
  EXPECT_NO_THROW(Overlays(run_, OverlaySet::named("trail,contacts"), kFrame, nullptr, nowhere));
  for (const char* name : {"time", "names", "energy", "velocity", "impulses"}) {
    EXPECT_THROW(Overlays(run_, OverlaySet::named(name), kFrame, nullptr, nowhere), MachineError) << name;
  }
}

}  // namespace
}  // namespace careen
