#include "render/overlay/overlay_pictures.h"

namespace careen {
namespace {

using TimeCode = OverlayPictures;

TEST_F(TimeCode, tellsTheScenesTime) {
  const std::vector<Label> labels = only<Label>(shapesAt("time", 0.5));
  ASSERT_EQ(labels.size(), 1U);
  EXPECT_EQ(labels[0].text, "00:00:00.500");
  EXPECT_EQ(labels[0].typeface, Typeface::kMonospaced);
}

TEST_F(TimeCode, tellsHoursMinutesSecondsAndThousandths) {
  EXPECT_EQ(timeCode(0), "00:00:00.000");
  EXPECT_EQ(timeCode(1.234), "00:00:01.234");
  EXPECT_EQ(timeCode(59.9996), "00:01:00.000");
  EXPECT_EQ(timeCode(3600 + 2 * 60 + 3.0456), "01:02:03.046");
  EXPECT_EQ(timeCode(100 * 3600), "100:00:00.000");
}

}  // namespace
}  // namespace careen
