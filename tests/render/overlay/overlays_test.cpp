#include "render/overlay/overlays.h"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "core/error.h"
#include "render/overlay/overlay_pictures.h"
#include "support/generated_part.h"

namespace careen {
namespace {

using OverlaysTest = OverlayPictures;

const std::filesystem::path kAssetsOfOverlays = std::filesystem::path(CAREEN_SOURCE_DIR) / "assets";

// The list of stage/overlay.h with what each overlay shows.
struct NamedKind {
  std::string name;
  const OverlayKind& kind;
};
#define CAREEN_NAMED_KIND(Name, name) NamedKind{name, k##Name##Overlay},
const std::array kNamedKinds = {CAREEN_OVERLAYS(CAREEN_NAMED_KIND)};

TEST(OverlayKinds, areInTheSchemaAsTheListHasThem) {
  std::string shown;
  std::string names;
  for (const NamedKind& each : kNamedKinds) {
    shown.append(shown.empty() ? "" : "; ").append(each.name + ": " + each.kind.shows);
    names.append(names.empty() ? "" : ", ").append('"' + each.name + '"');
  }
  expectGenerated(
      kAssetsOfOverlays / "scene.schema.json", "\"description\": \"Overlays that explain the film. ",
      ",\n      \"default\"",
      shown +
          ".\",\n      \"type\": \"array\",\n      \"uniqueItems\": true,\n      \"items\": { \"enum\": [" +
          names + "] }");
}

TEST(OverlayKinds, areInTheManualAsTheListHasThem) {
  std::string rows;
  for (const NamedKind& each : kNamedKinds) {
    rows.append(rows.empty() ? "" : "\n").append("| `" + each.name + "` | " + each.kind.shows + " |");
  }
  expectGenerated(kAssetsOfOverlays / "manual/film.md", "| overlay | shows |\n|---|---|\n", "\n\n", rows);
}

// Whatever their order in the list: trails, axes, arrows, impacts, panels, names.
TEST_F(OverlaysTest, areDrawnFromBackToFront) {
  std::get<EulerStep>(run_.tracks[0].segments.open()[0].motion).start.angularMomentum = Vec3(0, 0, 0.3);
  scene_.boxes[0].name = "crate";
  strike(0.2, 3);
  const OverlayShapes shapes =
      shapesAt("contacts,impulses,angular-momentum,spin-axis,trail,velocity,names,time", 0.3);
  std::vector<std::string> order;
  const auto add = [&](const std::string& name) {
    if (order.empty() || order.back() != name) {
      order.push_back(name);
    }
  };
  std::size_t i = 0;
  for (; !std::holds_alternative<Plate>(shapes[i]); ++i) {
    const Stroke* const stroke = std::get_if<Stroke>(&shapes[i]);
    const auto isOf = [&](const Color& color) {
      const Color& ink = stroke->ink.color;
      return ink.red == color.red && ink.green == color.green && ink.blue == color.blue;
    };
    add(stroke == nullptr || stroke->from == stroke->to ? "path or point"
        : isOf(kMoss)                                   ? "axis"
        : isOf(kViolet)                                 ? "angular momentum"
        : isOf(kTeal)                                   ? "velocity"
        : isOf(kAmber)                                  ? "impulse"
                                                        : "normal");
  }
  EXPECT_EQ(order, (std::vector<std::string>{"path or point", "axis", "angular momentum", "velocity",
                                             "normal", "path or point", "impulse"}));
  EXPECT_EQ(std::get<Label>(shapes[i + 1]).text, "00:00:00.300");
  EXPECT_EQ(std::get<Label>(shapes.back()).text, "crate");
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
    std::get<EulerStep>(run_.tracks.back().segments.open()[0].motion).start.pose.position.x() += 1;
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
  std::get<EulerStep>(run_.tracks[0].segments.open()[0].motion).start.pose.position = Vec3(-9, 0, 6.44);
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

TEST_F(OverlaysTest, sizesGrowWithThePictureAndNeverGetTooSmallToRead) {
  EXPECT_NEAR(OverlayStyle(2160).text, 3 * OverlayStyle(720).text, 1e-9);
  EXPECT_EQ(OverlayStyle(360).text, 12);
  EXPECT_EQ(OverlayStyle(240).text, 8);
  EXPECT_EQ(OverlayStyle(36).text, 8);
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
