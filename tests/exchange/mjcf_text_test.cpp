#include "exchange/mjcf_text.h"

#include <gtest/gtest.h>

namespace careen {
namespace {

TEST(MjcfText, numbersAreInFullAndQuaternionsBeginWithW) {
  EXPECT_EQ(mjcfNumbers({0.1, -2, 1e60}), "0.1 -2 1e+60");
  EXPECT_EQ(mjcfNumbers(Vec3(1, 2, 3)), "1 2 3");
  EXPECT_EQ(mjcfNumbers(Quat(1, 2, 3, 4)), "1 2 3 4");
}

TEST(MjcfText, attributesAreEscaped) {
  EXPECT_EQ(mjcfAttribute("name", R"(<a & "b">)"), " name=\"&lt;a &amp; &quot;b&quot;&gt;\"");
}

}  // namespace
}  // namespace careen
