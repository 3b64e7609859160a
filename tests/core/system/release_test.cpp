#include "core/system/release.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace careen {
namespace {

TEST(DrawingPackages, areOsMesaWhereDebianHasIt) {
  EXPECT_EQ(drawingPackages("NAME=\"Debian GNU/Linux\"\nVERSION_ID=\"12\"\nID=debian\n"), "libosmesa6");
  EXPECT_EQ(drawingPackages("VERSION_ID=13\n"), "libosmesa6");
}

TEST(DrawingPackages, areThoseOfEglFromFourteenOn) {
  EXPECT_EQ(drawingPackages("VERSION_ID=\"14\"\n"), "libegl1 libegl-mesa0 libgl1-mesa-dri");
  EXPECT_EQ(
      drawingPackages("NAME=\"Debian GNU/Linux\"\nVERSION_CODENAME=forky\n"),  // testing names no number
      "libegl1 libegl-mesa0 libgl1-mesa-dri");
  EXPECT_EQ(drawingPackages(""), "libegl1 libegl-mesa0 libgl1-mesa-dri");
}

TEST(CLibrary, isNamedWithItsVersion) {
  int major = 0;
  int minor = 0;
  EXPECT_EQ(std::sscanf(cLibrary().c_str(), "glibc %d.%d", &major, &minor), 2) << cLibrary();
  EXPECT_EQ(major, 2);
}

}  // namespace
}  // namespace careen
