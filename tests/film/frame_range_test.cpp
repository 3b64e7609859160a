#include "film/frame_range.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/error.h"

namespace careen {
namespace {

using Frames = std::vector<std::int64_t>;

Frames frames(const std::string& text, std::int64_t count) { return framesOf(parseFrameRanges(text), count); }

TEST(FrameRange, namesFramesSingleFromToAndByStep) {
  EXPECT_EQ(frames("3", 10), (Frames{3}));
  EXPECT_EQ(frames("2-4", 10), (Frames{2, 3, 4}));
  EXPECT_EQ(frames("1-8:3", 10), (Frames{1, 4, 7}));
  EXPECT_EQ(frames("1-7:3", 10), (Frames{1, 4, 7}));
  EXPECT_EQ(frames("4:2", 10), (Frames{4, 6, 8}));
  EXPECT_EQ(frames("9", 10), (Frames{9}));
}

TEST(FrameRange, putsFramesInOrderEachOnce) {
  EXPECT_EQ(frames("7:1,0-2,1-3", 10), (Frames{0, 1, 2, 3, 7, 8, 9}));
}

TEST(FrameRange, noRangesMeanAllFrames) { EXPECT_EQ(framesOf({}, 4), (Frames{0, 1, 2, 3})); }

TEST(FrameRange, stepBeyondAllNumbersIsAFrameAlone) {
  EXPECT_EQ(frames("1-3:9223372036854775807", 10), (Frames{1}));
}

TEST(FrameRange, refusesWhatItCannotRead) {
  for (const char* text : {"", ",", "1,", "a", "1-", "-1", "3-1", "1:0", "1:", "1--2", "1-2:-1", "1 2", "0x1",
                           "99999999999999999999"}) {
    EXPECT_THROW(parseFrameRanges(text), InputError) << text;
  }
}

TEST(FrameRange, refusesFramesTheFilmHasNot) {
  for (const char* text : {"10", "5-10", "12:2"}) {
    EXPECT_THROW(frames(text, 10), InputError) << text;
  }
}

TEST(FrameRange, refusesMoreFramesThanCanBeListed) {
  constexpr std::int64_t kLong = 1'000'000'000'000;
  EXPECT_THROW(framesOf({}, kLong), InputError);
  EXPECT_THROW(frames("0-99999999999", kLong), InputError);
  EXPECT_THROW(frames("0-5999999,0-5999999", kLong), InputError);
  EXPECT_EQ(frames("0-99999999999:99999999999", kLong), (Frames{0, 99999999999}));
}

TEST(FrameRange, writesFramesShortestForm) {
  EXPECT_EQ(rangesText(Frames{0, 1, 2, 3, 7, 9, 10}), "0-3,7,9-10");
  EXPECT_EQ(rangesText(Frames{}), "");
  EXPECT_EQ(frames(rangesText(Frames{0, 2, 3, 8}), 10), (Frames{0, 2, 3, 8}));
}

}  // namespace
}  // namespace careen
