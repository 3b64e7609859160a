#include "image/picture_ring.h"

#include <gtest/gtest.h>

#include <cstdint>

#include "core/error.h"
#include "core/system/worker.h"

namespace careen {
namespace {

TEST(PictureRing, whatAForkedProcessWritesIsReadHere) {
  const PictureRing ring(3, 5);
  Worker worker([&ring](const Channel&) { ring[4][2] = 77; });
  EXPECT_EQ(worker.end().fault, "");
  EXPECT_EQ(ring[4].size(), 5U);
  EXPECT_EQ(ring[4][2], 77);
}

TEST(PictureRing, placesComeRoundAndDoNotOverlap) {
  const PictureRing ring(3, 5);
  for (std::int64_t index = 0; index < 3; ++index) {
    for (std::uint8_t& byte : ring[index]) {
      byte = static_cast<std::uint8_t>(index);
    }
  }
  for (std::int64_t index = 0; index < 30; ++index) {
    EXPECT_EQ(ring[index].front(), index % 3);
    EXPECT_EQ(ring[index].back(), index % 3);
  }
}

TEST(PictureRing, tooMuchIsAnError) {
  EXPECT_THROW(PictureRing(1000, std::size_t{1} << 50U), MachineError);
  EXPECT_EQ(PictureRing(0, 1).places(), 0);
}

}  // namespace
}  // namespace careen
