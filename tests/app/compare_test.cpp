// Comparing pictures and runs, as its user meets it; films are in compare_films_test.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/copied_program.h"
#include "support/process.h"
#include "support/program.h"

namespace careen {
namespace {

const std::string kGallery = CAREEN_SOURCE_DIR "/assets/gallery/";

std::string crateScene(const std::string& speed, const std::string& name = "crate") {
  return R"({ "careen": 1, "duration": 3, "gravity": [0, 0, -10],
    "room": { "min": [-2, -2, 0], "max": [2, 2, 4], "restitution": 1 },
    "boxes": [ { "name": ")" +
         name + R"(", "half_extents": [0.3, 0.2, 0.1], "mass": 1, "position": [0, 0, 1],
                 "velocity": [)" +
         speed + R"(, 0, 2], "angular_velocity": [1, 2, 3] } ] })";
}

class Compare : public testing::Test {
 protected:
  Ended careen(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), program());
    return Process(arguments, folder_.path()).wait();
  }
  Ended compare(const std::vector<std::string>& arguments) const {
    std::vector<std::string> all = {"compare"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return careen(all);
  }
  void simulate(const std::string& name, const std::string& text) const {
    folder_.write(name + ".json", text);
    const Ended ended = careen({"simulate", name + ".json", "-o", name + ".careen"});
    ASSERT_EQ(ended.exitCode, 0) << ended.err;
  }

  TemporaryFolder folder_;
};

TEST_F(Compare, picturesAreSameOrNot) {
  const Ended same = compare({kGallery + "wall.png", kGallery + "wall.png"});
  EXPECT_EQ(same.exitCode, 0);
  EXPECT_EQ(same.out, "same: same file (same-picture)\n");
  const Ended other = compare({kGallery + "wall.png", kGallery + "stack.png"});
  EXPECT_EQ(other.exitCode, 1);
  EXPECT_TRUE(other.out.starts_with("differs: other picture (same-picture)\n  stack.png: ")) << other.out;
  EXPECT_EQ(other.err, "");
}

TEST_F(Compare, scriptsBesideTheProgramAreIgnored) {
  const CopiedProgram copy(program());
  copy.plantAll("assets/compare");
  copy.plant("assets/compare/page.js", "planted();\n");
  const Ended ended =
      Process({copy.path(), "compare", kGallery + "wall.png", kGallery + "stack.png", "--out", "report"},
              folder_.path())
          .wait();
  EXPECT_EQ(ended.exitCode, 1) << ended.err;
  const std::string page = textOf(folder_ / "report/index.html");
  EXPECT_NE(page.find(textOf(CAREEN_SOURCE_DIR "/assets/compare/page.js")), std::string::npos);
  EXPECT_EQ(page.find("planted"), std::string::npos);
}

TEST_F(Compare, everyNumberOfAThresholdCanBeGiven) {
  const Ended lenient = compare(
      {kGallery + "wall.png", kGallery + "stack.png", "--threshold", "exact", "--allow", "failpercent=100"});
  EXPECT_EQ(lenient.exitCode, 0);
  EXPECT_TRUE(lenient.out.starts_with("same, with a warning: same picture (exact, failpercent=100)\n"))
      << lenient.out;
  const Ended strict = compare({kGallery + "wall.png", kGallery + "stack.png", "--threshold", "exact",
                                "--allow", "failpercent=100,hardfail=0.5"});
  EXPECT_EQ(strict.exitCode, 1);
  EXPECT_NE(strict.out.find("at most 0.5 is allowed"), std::string::npos) << strict.out;
}

TEST_F(Compare, framesAreLoggedAsLinesOfJson) {
  const Ended ended = compare({kGallery + "wall.png", kGallery + "stack.png", "--log", "json", "--flip"});
  EXPECT_EQ(ended.exitCode, 1);
  const nlohmann::json line = nlohmann::json::parse(ended.out);
  EXPECT_EQ(line["name"], "stack.png");
  EXPECT_EQ(line["verdict"], "different");
  EXPECT_GT(line["flip"], 0.01);
  EXPECT_LT(line["ssim"], 1);
  EXPECT_FALSE(line["reasons"].empty());
  EXPECT_TRUE(ended.err.starts_with("differs: ")) << ended.err;
}

TEST_F(Compare, runsAreComparedBitByBitAndEventByEvent) {
  simulate("one", "// a comment\n" + crateScene("1"));
  simulate("same", crateScene("1"));
  simulate("other", crateScene("1.001"));
  const Ended same = compare({"one.careen", "same.careen"});
  EXPECT_EQ(same.exitCode, 0);
  EXPECT_EQ(same.out, "same: same motion, bit for bit\n");
  const Ended other = compare({"one.careen", "other.careen"});
  EXPECT_EQ(other.exitCode, 1);
  EXPECT_TRUE(other.out.starts_with("differs: other motion from 0 s on")) << other.out;
  EXPECT_NE(other.out.find("first impact that differs, number 1: at "), std::string::npos) << other.out;
  EXPECT_NE(other.out.find("crate against room-z"), std::string::npos) << other.out;
  EXPECT_NE(other.out.find("  state hash: "), std::string::npos) << other.out;
}

TEST_F(Compare, otherBoxesAreOtherMotion) {
  simulate("one", crateScene("1"));
  simulate("other", crateScene("1", "chest"));
  const Ended ended = compare({"one.careen", "other.careen", "--motion", "0.5"});
  EXPECT_EQ(ended.exitCode, 1);
  EXPECT_NE(ended.out.find("box crate is not there"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("box chest was not expected"), std::string::npos) << ended.out;
}

TEST_F(Compare, motionMayBeComparedWithinATolerance) {
  simulate("one", crateScene("1"));
  simulate("near", crateScene("1.00000001"));
  EXPECT_EQ(compare({"one.careen", "near.careen"}).exitCode, 1);
  EXPECT_EQ(compare({"one.careen", "near.careen", "--motion", "1e-3"}).exitCode, 1);  // chaos, from 2.8 s on
  const Ended ended = compare({"one.careen", "near.careen", "--motion", "1e-3", "--until", "1.5"});
  EXPECT_EQ(ended.exitCode, 0) << ended.out;
  EXPECT_NE(ended.out.find("same motion, within "), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find(" of a box's size or radians, up to 1.5 s\n"), std::string::npos) << ended.out;
  EXPECT_EQ(compare({"one.careen", "one.careen", "--until", "1.5"}).out,
            "same: same motion, bit for bit, up to 1.5 s\n");
}

TEST_F(Compare, badInputIsNamed) {
  folder_.write("text.png", "no picture");
  folder_.write("empty.png", "");
  std::filesystem::create_directory(folder_ / "folder");
  struct Bad {
    std::vector<std::string> arguments;
    std::string message;
  };
  const std::string picture = kGallery + "wall.png";
  for (const Bad& bad : std::vector<Bad>{
           {{picture, "nowhere.png"}, "nowhere.png: is not there"},
           {{"empty.png", picture}, "empty.png: is empty"},
           {{picture, "text.png"}, "text.png: is no PNG"},
           {{"text.png", "text.png"}, "text.png: is no PNG"},
           {{picture, "folder"},
            "found a picture and a folder, expected two pictures, two folders or two runs"},
           {{"folder", "folder"}, "folder: found no PNG files"},
           {{picture, picture, "--threshold", "close"}, "--threshold: found 'close', expected one of"},
           {{picture, picture, "--allow", "fail=-1"}, "--allow: found 'fail=-1', expected fail=0 to 1"},
           {{picture, picture, "--allow", "fail=nan"}, "--allow: found 'fail=nan', expected fail=0 to 1"},
           {{picture, picture, "--allow", "fail"}, "--allow: found 'fail', expected fail=0 to 1"},
           {{picture, picture, "--allow", "heat=1"},
            "--allow: found 'heat=1', expected NAME=NUMBER, with one of: fail,"},
           {{picture, picture, "--motion", "a bit"}, "--motion: found 'a bit', expected same, any, or"},
           {{picture, picture, "--until", "0"}, "--until: found 0, expected more than 0 s"},
           {{picture, picture, "--threads", "0"}, "--threads: found 0, expected 1 to 256"}}) {
    const Ended ended = compare(bad.arguments);
    EXPECT_EQ(ended.exitCode, 2) << bad.message;
    EXPECT_NE(ended.err.find(bad.message), std::string::npos) << ended.err;
    EXPECT_EQ(ended.out, "") << bad.message;
  }
}

TEST_F(Compare, regionsAreIgnored) {
  const std::string wall = kGallery + "wall.png";
  const std::string stack = kGallery + "stack.png";
  const Ended other =
      compare({wall, stack, "--ignore", "0,0,10,10", "--ignore", "20,0,10,10", "--out", "report"});
  EXPECT_EQ(other.exitCode, 1) << other.err;
  EXPECT_NE(other.out.find("\n  not compared: 0,0,10,10; 20,0,10,10\n"), std::string::npos) << other.out;
  EXPECT_EQ(nlohmann::json::parse(textOf(folder_ / "report/report.json"))["ignored"].size(), 2U);
  for (const char* const bad : {"0,0,10", "0,0,0,10", "0,0,100000,10", "nowhere.png"}) {
    const Ended refused = compare({wall, stack, "--ignore", bad, "--out", "bad"});
    EXPECT_EQ(refused.exitCode, 2) << bad;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "bad"));
  }
  simulate("run", crateScene("1"));
  const Ended runs = compare({"run.careen", "run.careen", "--ignore", "0,0,1,1"});
  EXPECT_EQ(runs.exitCode, 2);
  EXPECT_NE(runs.err.find("--ignore: found two runs, expected pictures"), std::string::npos) << runs.err;
}

}  // namespace
}  // namespace careen
