#include "film/faults.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "film/folder.h"
#include "image/png.h"
#include "support/process.h"

namespace careen {
namespace {

Picture grey(int width, int height) {
  return {.width = width,
          .height = height,
          .rgb = std::vector<std::uint8_t>(static_cast<std::size_t>(3 * width * height), 90)};
}

TEST(Faults, areToldOfEveryFrameThatIsNotAsTheManifestHasIt) {
  const TemporaryFolder folder;
  FilmManifest manifest;
  manifest.picture.width = 8;
  manifest.picture.height = 6;
  manifest.frames = {0, 1, 2, 5, 9};
  for (const std::int64_t frame : {0, 2, 5}) {
    writePng(folder / frameFileName(frame), grey(8, 6));
  }
  writePng(folder / frameFileName(1), grey(6, 8));
  writePng(folder / frameFileName(7), grey(1, 1));  // nobody asked for it
  std::string bytes = textOf(folder / frameFileName(5));
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] + 1);
  folder.write(frameFileName(5), bytes);

  const std::vector<FrameFault> faults = findFaults(folder.path(), manifest);
  ASSERT_EQ(faults.size(), 3U);
  EXPECT_EQ(faults[0].frame, 1);
  EXPECT_EQ(faults[0].what, "is 6x8, expected 8x6");
  EXPECT_EQ(faults[1].frame, 5);
  EXPECT_NE(faults[1].what, "");
  EXPECT_EQ(faults[1].what.find(folder.path().string()), std::string::npos) << faults[1].what;
  EXPECT_EQ(faults[2].frame, 9);
  EXPECT_EQ(faults[2].what, "is missing");
}

TEST(Faults, areFramesThatShowAnotherPicture) {
  const TemporaryFolder folder;
  FilmManifest manifest;
  manifest.picture.width = 8;
  manifest.picture.height = 6;
  manifest.frames = {0, 1};
  for (const std::int64_t frame : manifest.frames) {
    Picture picture = grey(8, 6);
    picture.rgb[0] = static_cast<std::uint8_t>(frame);
    writePng(folder / frameFileName(frame), picture);
    manifest.hashes[frame] = frameHash(textOf(folder / frameFileName(frame)));
  }
  EXPECT_TRUE(findFaults(folder.path(), manifest).empty());
  folder.write(frameFileName(0), textOf(folder / frameFileName(1)));
  const std::vector<FrameFault> faults = findFaults(folder.path(), manifest);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].frame, 0);
  EXPECT_EQ(faults[0].what, "is another picture than was drawn");
  manifest.hashes.clear();
  EXPECT_TRUE(findFaults(folder.path(), manifest).empty()) << "an older manifest has none";
}

TEST(Faults, areNoneInAWholeFilm) {
  const TemporaryFolder folder;
  FilmManifest manifest;
  manifest.picture.width = 8;
  manifest.picture.height = 6;
  manifest.frames = {3};
  writePng(folder / frameFileName(3), grey(8, 6));
  EXPECT_TRUE(findFaults(folder.path(), manifest).empty());
}

}  // namespace
}  // namespace careen
