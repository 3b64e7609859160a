#include "render/overlay/overlay_pictures.h"

namespace careen {
namespace {

using RecentImpacts = OverlayPictures;

// A chattering box has more impacts than can be seen: 400 are drawn, each with two strokes.
TEST_F(RecentImpacts, areTheLatestIfThereAreTooMany) {
  for (int i = 0; i < 500; ++i) {
    strike(0.2 + 1e-6 * i, 3);
  }
  run_.impacts[99].point.z() = 2;   // the last one that is left out
  run_.impacts[100].point.z() = 0;  // the first one that is drawn
  const std::vector<Stroke> found = only<Stroke>(shapesAt("contacts", 0.3));
  ASSERT_EQ(found.size(), 800U);
  expectNear(found[0].from, onPicture(Vec3(1, 0, 0)));
}

}  // namespace
}  // namespace careen
