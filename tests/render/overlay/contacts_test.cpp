#include "render/overlay/overlay_pictures.h"

namespace careen {
namespace {

using ContactsOverlay = OverlayPictures;

TEST_F(ContactsOverlay, contactIsMarkedWithItsNormal) {
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

}  // namespace
}  // namespace careen
