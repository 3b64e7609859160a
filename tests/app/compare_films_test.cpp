// Comparing films: what their folders say of themselves counts, too.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "support/process.h"

namespace careen {
namespace {

std::string filmScene(const std::string& speed, const std::string& color) {
  return R"({ "careen": 1, "duration": 1, "gravity": [0, 0, -10],
    "room": { "min": [-2, -2, 0], "max": [2, 2, 4], "open": ["-y"], "restitution": 1 },
    "boxes": [ { "name": "crate", "half_extents": [0.6, 0.4, 0.2], "mass": 1, "position": [0, 0, 1],
                 "velocity": [)" +
         speed + R"(, 0, 2], "angular_velocity": [1, 2, 3], "color": ")" + color + R"(" } ],
    "film": { "size": [160, 90], "fps": 10 } })";
}

class CompareFilms : public testing::Test {
 protected:
  Ended careen(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), CAREEN_BINARY);
    return Process(arguments, folder_.path()).wait();
  }
  void film(const std::string& name, const std::string& text, std::vector<std::string> options = {}) const {
    folder_.write(name + ".json", text);
    options.insert(options.begin(), {"render", name + ".json", "--out", name});
    const Ended ended = careen(options);
    ASSERT_EQ(ended.exitCode, 0) << ended.err;
  }

  TemporaryFolder folder_;
};

TEST_F(CompareFilms, motionAndPicturesAreToldApart) {
  film("one", filmScene("1", "#C8553D"));
  film("same", "// but for a comment\n" + filmScene("1", "#C8553D"), {"--jobs", "3"});
  film("colour", filmScene("1", "#3D55C8"));
  film("motion", filmScene("1.0000000000000002", "#C8553D"));
  Ended ended = careen({"compare", "one", "same"});
  EXPECT_EQ(ended.exitCode, 0) << ended.out;
  EXPECT_EQ(ended.out, "same: same motion, same files (same-picture)\n");
  ended = careen({"compare", "one", "colour"});
  EXPECT_EQ(ended.exitCode, 1);
  EXPECT_TRUE(
      ended.out.starts_with("differs: same motion, other picture in 10 of 10 frames (same-picture)\n"))
      << ended.out;
  EXPECT_NE(ended.out.find("  scene hash: "), std::string::npos) << ended.out;
  ended = careen({"compare", "one", "motion"});
  EXPECT_EQ(ended.exitCode, 1);
  EXPECT_TRUE(ended.out.starts_with("differs: other motion, same ")) << ended.out;
  EXPECT_EQ(careen({"compare", "one", "motion", "--motion", "any"}).exitCode, 0);
  ended = careen({"compare", "one", "motion", "--motion", "0.05"});
  EXPECT_EQ(ended.exitCode, 2);
  EXPECT_NE(ended.err.find("--motion: found 0.05 and a folder, expected same or any"), std::string::npos)
      << ended.err;
}

TEST_F(CompareFilms, lostFramesAreNamed) {
  film("one", filmScene("1", "#C8553D"));
  film("part", filmScene("1", "#C8553D"), {"--frames", "0-7,9"});
  const Ended ended = careen({"compare", "one", "part"});
  EXPECT_EQ(ended.exitCode, 1);
  EXPECT_NE(ended.out.find("  000008.png: it is missing\n"), std::string::npos) << ended.out;
}

TEST_F(CompareFilms, picturesInSubfoldersAreNoFramesOfAFilm) {
  film("one", filmScene("1", "#C8553D"), {"--frames", "0"});
  film("other", filmScene("1", "#C8553D"), {"--frames", "0"});
  std::filesystem::create_directory(folder_ / "one/truth");
  std::filesystem::copy_file(folder_ / "one/000000.png", folder_ / "one/truth/000000.png");
  EXPECT_EQ(careen({"compare", "one", "other"}).out, "same: same motion, same file (same-picture)\n");
  std::filesystem::remove(folder_ / "one/film.json");
  EXPECT_EQ(careen({"compare", "one", "other"}).exitCode, 0);
  std::filesystem::remove(folder_ / "other/film.json");
  const Ended ended = careen({"compare", "one", "other"});
  EXPECT_EQ(ended.exitCode, 1);
  EXPECT_NE(ended.out.find("  truth/000000.png: it is missing\n"), std::string::npos) << ended.out;
}

TEST_F(CompareFilms, reportsAreKeptOutOfWhatIsComparedAndOfFilms) {
  film("one", filmScene("1", "#C8553D"), {"--frames", "0"});
  for (const char* folder : {"a", "b"}) {
    std::filesystem::create_directory(folder_ / folder);
    std::filesystem::copy_file(folder_ / "one/000000.png", folder_ / folder / "0.png");
  }
  std::filesystem::create_directory_symlink("a", folder_ / "link");
  for (const char* out : {"a", "a/", "./b/.", "a/new/report", "link", "link/new", "b/../a", "one"}) {
    const Ended ended = careen({"compare", "a", "b/", "--out", out});
    EXPECT_EQ(ended.exitCode, 2) << out;
    EXPECT_NE(ended.err.find("--out: found " + std::string(out)), std::string::npos) << ended.err;
    EXPECT_EQ(ended.out, "") << out;
  }
  for (const char* folder : {"a", "b", "one"}) {
    EXPECT_FALSE(std::filesystem::exists(folder_ / folder / "index.html"));
  }
  EXPECT_EQ(careen({"compare", "a", "b", "--out", "ab"}).exitCode, 0);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "ab/index.html"));
}

}  // namespace
}  // namespace careen
