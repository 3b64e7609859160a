#include "stage/picture_settings.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace careen {
namespace {

TEST(PictureSettings, looksAndAntialiasingsHaveNamesThatLeadBackToThem) {
  for (const std::string_view name : kLooks) {
    EXPECT_EQ(nameOf(lookNamed(name)), name);
  }
  for (const std::string_view name : kAntialiasings) {
    EXPECT_EQ(nameOf(antialiasingNamed(name)), name);
  }
  EXPECT_EQ(lookNamed("clay"), Look::kClay);
  EXPECT_EQ(antialiasingNamed("4x"), Antialiasing::kMultisampled);
}

TEST(PictureSettings, unknownNamesAreRefusedWithThoseThereAre) {
  for (const char* name : {"", "Clay", "8x"}) {
    EXPECT_THROW(lookNamed(name), InputError) << name;
    EXPECT_THROW(antialiasingNamed(name), InputError) << name;
  }
}

TEST(PictureSettings, aspectIsWidthOverHeight) {
  PictureSettings picture;
  picture.width = 1920;
  picture.height = 1080;
  EXPECT_EQ(picture.aspect(), 1920.0 / 1080.0);
}

}  // namespace
}  // namespace careen
