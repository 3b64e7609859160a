#include "render/overlay/style.h"

#include <gtest/gtest.h>

namespace careen {
namespace {

// Twice as high a picture has everything twice as large, where nothing is at its smallest.
TEST(OverlayStyle, growsWithThePicture) {
  const OverlayStyle small(1080);
  const OverlayStyle large(2160);
  EXPECT_DOUBLE_EQ(large.text, 2 * small.text);
  EXPECT_DOUBLE_EQ(large.line, 2 * small.line);
  EXPECT_DOUBLE_EQ(large.halo, 2 * small.halo);
  EXPECT_DOUBLE_EQ(large.head, 2 * small.head);
  EXPECT_DOUBLE_EQ(large.longestArrow, 2 * small.longestArrow);
}

TEST(OverlayStyle, staysLegibleInSmallPictures) {
  const OverlayStyle tiny(90);
  EXPECT_EQ(tiny.text, kSmallestText);
  EXPECT_EQ(tiny.line, 1.5);
  EXPECT_EQ(tiny.halo, 1);
  EXPECT_LT(tiny.head, tiny.longestArrow);
}

}  // namespace
}  // namespace careen
