#include "render/overlay/overlay_pictures.h"

namespace careen {
namespace {

using EnergyOverlay = OverlayPictures;

// 0.8 m above the floor under 10 m/s²: after 0.2 s a quarter of the energy is motion, after the impact at 0.4
// s three quarters are lost.
TEST_F(EnergyOverlay, barsAreAsLongAsTheirEnergies) {
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

}  // namespace
}  // namespace careen
