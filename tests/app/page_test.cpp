// The page about a run, in a browser.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "support/browser.h"
#include "support/process.h"

namespace careen {
namespace {

const std::string kPageScene = R"({
  "careen": 1, "name": "toss & <catch>", "duration": 1, "gravity": [0, 0, -10],
  "room": { "min": [-2, -2, 0], "max": [2, 2, 4], "restitution": 0.8 },
  "boxes": [ { "name": "crate", "half_extents": [0.3, 0.2, 0.1], "mass": 1, "position": [0, 0, 0.5],
               "velocity": [1, 0, 2], "angular_velocity": [1, 2, 3] } ],
  "film": { "size": [64, 48], "fps": 10, "time": [[0, 0], [2, 1]] } })";

class RenderPage : public testing::Test {
 protected:
  void SetUp() override { folder_.write("scene.json", kPageScene); }
  Ended page(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {CAREEN_BINARY, "page"});
    return Process(arguments, folder_.path()).wait();
  }
  TemporaryFolder folder_;
};

TEST_F(RenderPage, leadsFromImpactsToTheirMomentsOfTheFilm) {
  const Ended ended = page({"scene.json", "--sound"});
  ASSERT_EQ(ended.exitCode, 0) << ended.err;
  EXPECT_NE(ended.out.find("scene.html"), std::string::npos) << ended.out;
  Browser browser;
  for (const int width : {360, 1200}) {
    browser.setSize(width, 900);
    browser.open(folder_.path() / "scene.html");
    EXPECT_EQ(browser.evaluate("document.getElementById('name').textContent"), "toss & <catch>");
    EXPECT_LE(browser.evaluate("document.documentElement.scrollWidth").get<int>(), width)
        << "nothing sticks out";
    EXPECT_EQ(browser.evaluate("document.querySelectorAll('#energy path').length"), 5);
    EXPECT_GT(browser.evaluate("document.getElementById('impacts').rows.length").get<int>(), 0);
    // The film is at half speed: an impact at t is at 2 t.
    const double impact = browser.evaluate("data.impacts[0][0]");
    browser.evaluate("document.querySelector('#impacts button').click()");
    EXPECT_NEAR(browser.evaluate("film.currentTime").get<double>(), 2 * impact, 1e-5);
    browser.evaluate("document.activeElement.blur()");
    browser.press("ArrowRight");
    EXPECT_NEAR(browser.evaluate("film.currentTime").get<double>(),
                2 * browser.evaluate("data.impacts[1][0]").get<double>(), 1e-5);
    browser.press("ArrowLeft");
    EXPECT_NEAR(browser.evaluate("film.currentTime").get<double>(), 2 * impact, 1e-5);
  }
  EXPECT_TRUE(browser.complaints().empty()) << browser.complaints().front();
  EXPECT_TRUE(browser.requests().empty()) << browser.requests().front();
}

TEST_F(RenderPage, isWholeOrNotThere) {
  EXPECT_EQ(page({"nothing.json"}).exitCode, 2);
  EXPECT_EQ(page({"scene.json", "--quality", "brilliant"}).exitCode, 2);
  const Ended nowhere = page({"scene.json", "-o", "missing/page.html"});
  EXPECT_EQ(nowhere.exitCode, 3) << nowhere.err;
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "missing"));
}

}  // namespace
}  // namespace careen
