#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "support/process.h"

namespace careen::test {

inline const std::string kFilmScene = R"({
  "careen": 1, "name": "toss", "duration": 1, "gravity": [0, 0, -10], "method": "listing1", "dt": 0.001,
  "room": { "min": [-2, -2, 0], "max": [2, 2, 4], "open": ["-y"], "restitution": 1 },
  "boxes": [ { "name": "crate", "half_extents": [0.3, 0.2, 0.1], "mass": 1, "position": [0, 0, 1],
               "velocity": [1, 0, 2], "angular_velocity": [1, 2, 3] } ],
  "film": { "size": [64, 48], "fps": 10 }
})";

/// Makes films of kFilmScene in a folder of its own. Small pictures: what is tested is the path, not the
/// look.
class FilmCommand : public testing::Test {
 protected:
  void SetUp() override { folder_.write("scene.json", kFilmScene); }

  std::string frameOf(const std::vector<std::string>& options, const std::string& out) {
    std::vector<std::string> arguments = {"render", "--frames", "3", "--out", out};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Ended ended = careen(arguments);
    EXPECT_EQ(ended.exitCode, 0) << ended.err;
    return textOf(folder_ / out / "000003.png");
  }

  Ended careen(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), CAREEN_BINARY);
    return Process(arguments, folder_.path()).wait();
  }
  std::vector<std::string> framesIn(const std::string& name) const {
    std::vector<std::string> frames;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / name)) {
      if (entry.path().extension() == ".png") {
        frames.push_back(entry.path().filename().string());
      }
    }
    std::sort(frames.begin(), frames.end());
    return frames;
  }
  bool hasPartials() const {
    const std::vector<std::string> files = folder_.files();
    return std::any_of(files.begin(), files.end(),
                       [](const std::string& name) { return name.find(".partial") != std::string::npos; });
  }
  void expectSameFilm(const std::string& a, const std::string& b) const {
    ASSERT_EQ(framesIn(a), framesIn(b));
    for (const std::string& frame : framesIn(a)) {
      EXPECT_EQ(textOf(folder_ / a / frame), textOf(folder_ / b / frame)) << frame;
    }
  }

  TemporaryFolder folder_;
};

}  // namespace careen::test
