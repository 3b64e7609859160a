// The window as its user meets it: a real program on a display of its own, real keys, real screenshots.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "image/png.h"
#include "support/environment_variable.h"
#include "support/process.h"
#include "support/x_display.h"

namespace careen {
namespace {

using Clock = std::chrono::steady_clock;
constexpr int kWidth = 96;
constexpr int kHeight = 64;

// A film of ten frames, as fast as may be.
std::string scene(const std::string& color, const std::string& fps = "10") {
  return R"({
  "careen": 1, "duration": 1, "gravity": [0, 0, -10],
  "room": { "min": [-2, -2, 0], "max": [2, 2, 4], "open": ["-y"], "restitution": 1 },
  "boxes": [ { "name": "crate", "half_extents": [0.5, 0.4, 0.3], "mass": 1, "position": [0, 0, 1],
               "velocity": [1, 0, 2], "angular_velocity": [1, 2, 3], "color": ")" +
         color + R"(" } ],
  "overlays": ["trail"], "film": { "size": [96, 64], "fps": )" +
         fps + "} }";
}

// Not how long it takes, but how long before it has failed.
testing::AssertionResult eventually(const std::function<bool()>& holds) {
  for (const auto end = Clock::now() + std::chrono::seconds(30); Clock::now() < end;) {
    if (holds()) {
      return testing::AssertionSuccess();
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return testing::AssertionFailure() << "in vain for 30 s";
}

class View : public testing::Test {
 protected:
  void SetUp() override { folder_.write("scene.json", scene("#c8553d")); }

  Process careen(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), CAREEN_BINARY);
    return {arguments, folder_.path()};
  }
  /// Shows a scene, paused at its first frame.
  Process viewPaused(const std::string& file) const { return careen({"view", file, "--paused"}); }
  /// Frame of a film that another command has drawn.
  Picture frame(const std::string& file, int number) const {
    const std::string folder = "film-" + file;
    if (!std::filesystem::exists(folder_ / folder)) {
      const Ended ended = careen({"render", file, "--out", folder}).wait();
      EXPECT_EQ(ended.exitCode, 0) << ended.err;
    }
    return readPng(folder_ / (folder + "/00000" + std::to_string(number) + ".png"));
  }

  /// What is above the bar.
  Picture shown() const {
    Picture picture = display_.screenshot();
    picture.height = std::min(picture.height, kHeight);
    picture.rgb.resize(picture.rowBytes() * static_cast<std::size_t>(picture.height));
    return picture;
  }
  testing::AssertionResult shows(const Picture& expected) const {
    return eventually([&] { return shown().rgb == expected.rgb; })
           << ", the window says " << display_.title();
  }
  testing::AssertionResult says(const std::string& words) const {
    return eventually([&] { return display_.title().find(words) != std::string::npos; })
           << " for '" << words << "', the window says " << display_.title();
  }
  void quit(Process& view) const {
    display_.press("q");
    const Ended ended = view.wait();
    EXPECT_EQ(ended.exitCode, 0) << ended.err;
    EXPECT_NE(ended.out.find("ms to draw"), std::string::npos) << ended.out;
  }

  TemporaryFolder folder_;
  XDisplay display_{640, 480};
  EnvironmentVariable x_{"DISPLAY", display_.name()};
  EnvironmentVariable wayland_{"WAYLAND_DISPLAY", std::nullopt};
};

TEST_F(View, stepsThroughTheFilmsFramesByteForByte) {
  Process view = viewPaused("scene.json");
  ASSERT_TRUE(says("scene.json: frame 0 of 0-9, 0 s, paused"));
  EXPECT_TRUE(shows(frame("scene.json", 0)));
  const std::vector<std::pair<std::string, int>> keys = {
      {"period", 1}, {"Right", 2}, {"comma", 1}, {"Left", 0}, {"Left", 0}, {"End", 9},
      {"Right", 9},  {"Home", 0},  {"3", 3},     {"9", 8},    {"0", 0}};
  for (const auto& [key, expected] : keys) {
    display_.press(key);
    EXPECT_TRUE(says("frame " + std::to_string(expected) + " of")) << key;
    EXPECT_TRUE(shows(frame("scene.json", expected))) << key;
  }
  quit(view);
}

TEST_F(View, takesStillsOfTheFilm) {
  Process view = careen({"view", "scene.json", "--paused", "--out", "stills"});
  ASSERT_TRUE(says("frame 0"));
  display_.press("3");
  display_.press("s");  // at once: the picture may not have been drawn
  ASSERT_TRUE(eventually([&] { return view.outSoFar().find("scene-0.3.png") != std::string::npos; }));
  quit(view);
  ASSERT_EQ(careen({"render", "scene.json", "--still", "0.3", "--out", "expected.png"}).wait().exitCode, 0);
  EXPECT_EQ(textOf(folder_ / "stills/scene-0.3.png"), textOf(folder_ / "expected.png"));
}

TEST_F(View, playsAtTheFilmsSpeedAndPausesAtItsEnd) {
  Process view = viewPaused("scene.json");
  ASSERT_TRUE(says("paused"));
  const Clock::time_point begun = Clock::now();
  display_.press("space");
  EXPECT_TRUE(says("playing"));
  EXPECT_TRUE(says("frame 9 of 0-9, 0.9 s, paused"));
  EXPECT_GE(Clock::now() - begun, std::chrono::milliseconds(900));
  EXPECT_TRUE(shows(frame("scene.json", 9)));
  display_.press("space");
  EXPECT_TRUE(says("playing"));
  display_.press("space");
  EXPECT_TRUE(says("paused"));
  quit(view);
}

TEST_F(View, playsWithoutBeingAsked) {
  Process view = careen({"view", "scene.json"});
  EXPECT_TRUE(says("playing"));
  EXPECT_TRUE(says("frame 9 of 0-9, 0.9 s, paused"));
  EXPECT_TRUE(shows(frame("scene.json", 9)));
  quit(view);
}

TEST_F(View, goesWhereTheBarIsDragged) {
  Process view = viewPaused("scene.json");
  ASSERT_TRUE(says("frame 0"));
  display_.drag(10, kHeight + 8, kWidth - 2, kHeight + 4);
  EXPECT_TRUE(says("frame 9"));
  display_.drag(kWidth / 2, kHeight + 8, 36, 10);  // begun on the bar, it stays with the bar
  EXPECT_TRUE(says("frame 3 of 0-9, 0.3 s, paused"));
  EXPECT_TRUE(shows(frame("scene.json", 3)));
  quit(view);
}

TEST_F(View, turnsTheCameraAndGoesBackToTheFilms) {
  Process view = viewPaused("scene.json");
  ASSERT_TRUE(shows(frame("scene.json", 0)));
  display_.drag(60, 30, 40, 35);
  ASSERT_TRUE(says("camera turned"));
  ASSERT_TRUE(eventually([&] { return shown().rgb != frame("scene.json", 0).rgb; }));
  const Picture turned = shown();
  display_.scroll();
  ASSERT_TRUE(eventually([&] { return shown().rgb != turned.rgb; }));
  display_.press("s");
  display_.press("s");
  ASSERT_TRUE(eventually([&] { return view.outSoFar().find("turned-2.png") != std::string::npos; }));
  EXPECT_EQ(readPng(folder_ / "out/scene-0-turned-1.png").rgb, shown().rgb);
  EXPECT_EQ(textOf(folder_ / "out/scene-0-turned-2.png"), textOf(folder_ / "out/scene-0-turned-1.png"));
  display_.press("c");
  EXPECT_TRUE(shows(frame("scene.json", 0)));
  EXPECT_EQ(display_.title().find("turned"), std::string::npos);
  quit(view);
}

TEST_F(View, readsTheFileAgainWhenItChanges) {
  folder_.write("blue.json", scene("#0000ff"));
  const Picture blue = frame("blue.json", 5);
  Process view = viewPaused("scene.json");
  ASSERT_TRUE(says("frame 0"));
  display_.press("6");
  ASSERT_TRUE(shows(frame("scene.json", 5)));
  folder_.write("scene.json", scene("#0000ff"));
  EXPECT_TRUE(shows(blue));  // and where it was
  folder_.write("scene.json", R"({ "careen": 1, "boxen": [] })");
  EXPECT_TRUE(eventually([&] { return view.errSoFar().find("boxen") != std::string::npos; }));
  EXPECT_TRUE(shows(blue));
  folder_.write("scene.json", scene("#c8553d"));
  EXPECT_TRUE(shows(frame("scene.json", 5)));
  quit(view);
}

TEST_F(View, picksTheNextSceneOfTheFolder) {
  folder_.write("blue.json", scene("#0000ff"));
  folder_.write("broken.json", "{}");
  folder_.write("aside.txt", "no scene");
  Process view = viewPaused("scene.json");
  ASSERT_TRUE(says("scene.json: frame 0"));
  display_.press("n");
  EXPECT_TRUE(says("blue.json: frame 0"));
  EXPECT_TRUE(shows(frame("blue.json", 0)));
  display_.press("n");
  EXPECT_TRUE(eventually([&] { return view.errSoFar().find("broken.json") != std::string::npos; }));
  EXPECT_TRUE(says("blue.json: frame 0"));
  display_.press("n");
  EXPECT_TRUE(says("scene.json: frame 0"));
  display_.press("p");
  display_.press("p");
  EXPECT_TRUE(says("blue.json: frame 0"));
  quit(view);
}

// A scene that takes long to simulate does not stop what is shown, nor the end.
TEST_F(View, staysAtHandWhileItLoads) {
  folder_.write("slow.json", R"({
  "careen": 1, "duration": 1e7, "gravity": [0, 0, -10], "room": { "min": [-2, -2, 0], "max": [2, 2, 4], "restitution": 1 },
  "boxes": [ { "half_extents": [0.5, 0.4, 0.3], "mass": 1, "position": [0, 0, 1], "velocity": [9, 5, 2] } ] })");
  Process view = viewPaused("scene.json");
  ASSERT_TRUE(says("frame 0"));
  display_.press("n");
  ASSERT_TRUE(says("scene.json: frame 0 of 0-9, 0 s, paused, loading slow.json"));
  display_.press("period");
  EXPECT_TRUE(says("scene.json: frame 1 of 0-9, 0.1 s, paused, loading slow.json"));
  EXPECT_TRUE(shows(frame("scene.json", 1)));
  quit(view);
}

TEST_F(View, fitsOnTheScreen) {
  Process view = careen(
      {"view", "scene.json", "--paused", "--size", "1280x704", "--threads", "0"});  // 1280x720 with the bar
  ASSERT_TRUE(says("frame 0"));
  EXPECT_TRUE(eventually([&] { return display_.screenshot().width == 640; }));
  EXPECT_EQ(display_.screenshot().height, 360);
  quit(view);
}

TEST_F(View, signalEndsIt) {
  Process view = viewPaused("scene.json");
  ASSERT_TRUE(says("frame 0"));
  view.send(SIGTERM);
  const Ended ended = view.wait();
  EXPECT_EQ(ended.signal, SIGTERM);
  EXPECT_NE(ended.err.find("interrupted"), std::string::npos) << ended.err;
}

TEST_F(View, badSceneOrOptionIsRefused) {
  folder_.write("broken.json", "{}");
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"view", "broken.json"},
                                             {"view", "missing.json"},
                                             {"view", "scene.json", "--size", "0x1"},
                                             {"view", "scene.json", "--overlays", "wings"},
                                             {"view", "scene.json", "--method", "magic"}}) {
    const Ended ended = careen(arguments).wait();
    EXPECT_EQ(ended.exitCode, 2) << arguments[1] << ended.err;
    EXPECT_FALSE(ended.err.empty()) << arguments[1];
  }
}

// It says so before it reads the scene.
TEST(ViewWithoutDisplay, saysSoAndEnds) {
  const TemporaryFolder folder;
  const EnvironmentVariable wayland("WAYLAND_DISPLAY", std::nullopt);
  const std::optional<std::string> notNamed;
  const std::optional<std::string> notThere = ":nobody";
  for (const auto& display : {notNamed, notThere}) {
    const EnvironmentVariable x("DISPLAY", display);
    const Ended ended = Process({CAREEN_BINARY, "view", "missing.json"}, folder.path()).wait();
    EXPECT_EQ(ended.exitCode, 3) << ended.err;
    EXPECT_NE(ended.err.find("no display"), std::string::npos) << ended.err;
    EXPECT_TRUE(folder.files().empty());
  }
}

TEST(ViewWithoutGlfw, saysWhatToInstall) {
  const TemporaryFolder folder;
  folder.write("libglfw.so.3", "");
  const EnvironmentVariable libraries("LD_LIBRARY_PATH", folder.path());
  const Ended ended = Process({CAREEN_BINARY, "view"}, folder.path()).wait();
  EXPECT_EQ(ended.exitCode, 3);
  EXPECT_NE(ended.err.find("apt install libglfw3"), std::string::npos) << ended.err;
}

}  // namespace
}  // namespace careen
