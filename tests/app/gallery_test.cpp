// app/gallery and its pictures: one of each shipped scene, and one of a sweep.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <sstream>
#include <string>

#include "support/process.h"

namespace careen {
namespace {

const std::filesystem::path kRoot = CAREEN_SOURCE_DIR;

std::set<std::string> namesIn(const std::filesystem::path& folder, const std::string& ending) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ending) {
      names.insert(entry.path().stem().string());
    }
  }
  return names;
}

std::set<std::string> shippedScenes() { return namesIn(kRoot / "assets/scenes", ".json"); }

// Big-endian, as in a PNG header.
unsigned numberAt(const std::string& bytes, std::size_t place) {
  unsigned number = 0;
  for (const char byte : bytes.substr(place, 4)) {
    number = number * 256 + static_cast<unsigned char>(byte);
  }
  return number;
}

std::set<std::string> pictured() {
  std::set<std::string> names = shippedScenes();
  names.insert("sweep");
  return names;
}

TEST(Gallery, hasAPictureOfEachSceneAndNoOthers) {
  ASSERT_GT(shippedScenes().size(), 10U);
  EXPECT_EQ(namesIn(kRoot / "assets/gallery", ".png"), pictured());
}

TEST(Gallery, picturesAreAllOfOneSize) {
  for (const std::string& name : namesIn(kRoot / "assets/gallery", ".png")) {
    const std::string png = textOf(kRoot / "assets/gallery" / (name + ".png"));
    ASSERT_TRUE(png.starts_with("\x89PNG\r\n\x1a\n") && png.size() > 24) << name;
    const bool isSweep = name == "sweep";  // 10 × 10 frames of 96 × 54
    EXPECT_EQ(numberAt(png, 16), isSweep ? 960U : 640U) << name;
    EXPECT_EQ(numberAt(png, 20), isSweep ? 540U : 360U) << name;
  }
}

TEST(Gallery, hasAFrameForEachSceneAndListsThemForAnUnknownName) {
  const TemporaryFolder folder;
  const Ended ended = Process({kRoot / "app/gallery", "nope"}, folder.path()).wait();
  EXPECT_EQ(ended.exitCode, 2) << ended.out;
  const std::string said = "found 'nope', expected one of: ";
  ASSERT_TRUE(ended.err.starts_with(said)) << ended.err;
  std::istringstream names(ended.err.substr(said.size()));
  std::set<std::string> known;
  for (std::string name; names >> name;) {
    known.insert(name);
  }
  EXPECT_EQ(known, pictured());
}

}  // namespace
}  // namespace careen
