#include <array>
#include <set>

#include "render/overlay/overlay_pictures.h"

namespace careen {
namespace {

using OverlayPanels = OverlayPictures;

constexpr const char* kPanels = "time,energy,velocity,spin-axis,angular-momentum,impulses";

TEST_F(OverlayPanels, roundValuesAreEasilyRead) {
  EXPECT_DOUBLE_EQ(roundValue(10), 5);
  EXPECT_DOUBLE_EQ(roundValue(8), 2);
  EXPECT_DOUBLE_EQ(roundValue(0.003), 0.001);
  EXPECT_DOUBLE_EQ(roundValue(1e6), 5e5);
}

TEST_F(OverlayPanels, legendSaysHowLongAnArrowOfARoundValueIs) {
  run_ = drifting(scene_, Vec3(10, 0, 0));
  const OverlayShapes shapes = shapesAt("velocity", 0);
  EXPECT_EQ(only<Label>(shapes).back().text, "velocity  5 m/s");
  const Stroke sample = only<Stroke>(shapes).back();
  EXPECT_NEAR((sample.to - sample.from).norm(), 0.5 * 0.2 * kHeight, 1e-9);
}

TEST_F(OverlayPanels, legendHasItsOwnOrder) {
  std::get<EulerStep>(run_.tracks[0].segments.open()[0].motion).start.angularMomentum = Vec3(0, 0, 0.3);
  strike(0.2, 3);
  std::vector<std::string> words;
  for (const Label& label : only<Label>(shapesAt("impulses,spin-axis,angular-momentum,velocity", 0))) {
    words.push_back(label.text.substr(0, label.text.find("  ")));
  }
  EXPECT_EQ(words, (std::vector<std::string>{"velocity", "angular momentum", "spin", "impulse"}));
}

TEST_F(OverlayPanels, everythingStaysOnThePictureThatStandsAtItsEdges) {
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

TEST_F(OverlayPanels, panelsCoverAQuarterOfThePictureAtMost) {
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
TEST_F(OverlayPanels, panelsForWhichThereIsNoRoomAreLeftOut) {
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

// At most 0.6 of the largest and more than 0.6/2.5 of it, and 1, 2 or 5 times a power of ten.
TEST_F(OverlayPanels, valuesOfTheLegendAreRound) {
  for (double largest = 1e-6; largest < 1e6; largest *= 1.003) {
    const double value = roundValue(largest);
    EXPECT_LE(value, 0.6 * largest * (1 + 1e-15));
    EXPECT_GT(value, 0.6 / 2.5 * largest);
    const double digit = value / std::pow(10, std::floor(std::log10(value * (1 + 1e-12))));
    EXPECT_TRUE(std::fabs(digit - 1) < 1e-12 || std::fabs(digit - 2) < 1e-12 || std::fabs(digit - 5) < 1e-12)
        << value;
  }
}

}  // namespace
}  // namespace careen
