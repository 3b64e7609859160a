// Films that are compared with one made before, as their user meets them.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/process.h"

namespace careen {
namespace {

namespace fs = std::filesystem;

const std::string kReferenceScene = R"({
  "careen": 1, "duration": 1, "gravity": [0, 0, -10],
  "room": { "min": [-2, -2, 0], "max": [2, 2, 4], "open": ["-y"], "restitution": 1 },
  "boxes": [ { "half_extents": [0.3, 0.2, 0.1], "mass": 1, "position": [0, 0, 1], "velocity": [1, 0, 2],
               "angular_velocity": [1, 2, 3] } ],
  "film": { "size": [64, 48], "fps": 10 }
})";

std::string withReplaced(std::string text, const std::string& from, const std::string& by) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), by);
}

using Names = std::vector<std::string>;

class RenderReference : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("scene.json", kReferenceScene);
    // Nothing of it is as the scene says.
    const Ended ended =
        careen({"scene.json", "--out", "ref", "--frames", "2,5", "--size", "80x60", "--fps", "20", "--look",
                "clay", "--antialiasing", "off", "--overlays", "velocity", "--shutter", "90:2"});
    ASSERT_EQ(ended.exitCode, 0) << ended.err;
  }

  Ended careen(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {CAREEN_BINARY, "render"});
    return Process(arguments, folder_.path()).wait();
  }
  Ended compared(std::vector<std::string> more = {}, const std::string& scene = "scene.json") const {
    more.insert(more.begin(), {scene, "--ref", "ref", "--out", "out"});
    return careen(more);
  }
  Names namesIn(const std::string& folder) const {
    Names names;
    for (const auto& entry : fs::directory_iterator(folder_ / folder)) {
      names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }
  Names kept() const { return namesIn("out"); }
  Ended approved(Names more = {}, const std::string& scene = "scene.json") const {
    more.insert(more.begin(), {scene, "--ref", "ref", "--approve"});
    return careen(more);
  }

  TemporaryFolder folder_;
};

TEST_F(RenderReference, ofTheSameFilmOnlyTheResultForCiSystemsIsLeft) {
  const Ended ended = compared();
  EXPECT_EQ(ended.exitCode, 0) << ended.out << ended.err;
  EXPECT_NE(ended.out.find(", 80x60, compared with " + (folder_ / "ref").string() +
                           "\nsame: same motion, same files"),
            std::string::npos)
      << ended.out;
  EXPECT_EQ(kept(), Names{"junit.xml"});
  EXPECT_NE(textOf(folder_ / "out/junit.xml").find(R"(tests="3" failures="0" errors="0")"),
            std::string::npos);
}

TEST_F(RenderReference, brokenFrameIsADifferenceWithAReport) {
  folder_.write("ref/000002.png", "no picture");
  EXPECT_EQ(compared().exitCode, 1);
  EXPECT_EQ(kept(), (Names{"000002.png", "film.json", "index.html", "junit.xml", "report.json"}));
  EXPECT_NE(textOf(folder_ / "out/junit.xml").find("is no PNG"), std::string::npos);
}

TEST_F(RenderReference, framesThatDifferStayAndNoOthers) {
  fs::copy_file(folder_ / "ref/000005.png", folder_ / "ref/000002.png", fs::copy_options::overwrite_existing);
  const Ended ended = compared();
  EXPECT_EQ(ended.exitCode, 1) << ended.err;
  EXPECT_NE(ended.out.find("differs: same motion, other picture in 1 of 2 frames"), std::string::npos)
      << ended.out;
  EXPECT_EQ(kept(), (Names{"000002.png", "film.json", "index.html", "junit.xml", "report.json"}));
  EXPECT_EQ(nlohmann::json::parse(textOf(folder_ / "out/film.json"))["frames"], "2");
}

TEST_F(RenderReference, whatIsAskedForTakesTheReferencesPlace) {
  const Ended ended = compared({"--look", "studio"});
  EXPECT_EQ(ended.exitCode, 1);
  EXPECT_NE(ended.out.find("look: clay, found studio"), std::string::npos) << ended.out;
  EXPECT_EQ(kept(),
            (Names{"000002.png", "000005.png", "film.json", "index.html", "junit.xml", "report.json"}));
}

TEST_F(RenderReference, onlyFramesAskedForAreCompared) {
  fs::copy_file(folder_ / "ref/000005.png", folder_ / "ref/000002.png", fs::copy_options::overwrite_existing);
  const Ended ended = compared({"--frames", "5"});
  EXPECT_EQ(ended.exitCode, 0) << ended.out << ended.err;
}

TEST_F(RenderReference, missingFrameIsADifference) {
  fs::remove(folder_ / "ref/000005.png");
  const Ended ended = compared();
  EXPECT_EQ(ended.exitCode, 1) << ended.err;
  EXPECT_EQ(kept(), (Names{"000005.png", "film.json", "index.html", "junit.xml", "report.json"}));
}

// Gravity differs in its last bit: no pixel shows it.
TEST_F(RenderReference, otherMotionIsADifferenceEvenIfNoPictureShowsIt) {
  folder_.write("other.json", withReplaced(kReferenceScene, "-10]", "-10.000000000000002]"));
  const Ended ended = compared({}, "other.json");
  EXPECT_EQ(ended.exitCode, 1) << ended.err;
  EXPECT_NE(ended.out.find("differs: other motion, same"), std::string::npos) << ended.out;
  EXPECT_EQ(kept(), (Names{"film.json", "index.html", "junit.xml", "report.json"}));
  EXPECT_EQ(compared({"--motion", "any"}, "other.json").exitCode, 0);
}

TEST_F(RenderReference, differenceThatIsGoneLeavesNothingOfIt) {
  EXPECT_EQ(compared({"--look", "studio"}).exitCode, 1);
  EXPECT_EQ(compared().exitCode, 0);
  EXPECT_EQ(kept(), Names{"junit.xml"});
}

// A film that somebody makes where an earlier comparison was is theirs.
TEST_F(RenderReference, filmOfItsOwnIsNotTakenForAnEarlierComparison) {
  EXPECT_EQ(compared().exitCode, 0);
  ASSERT_EQ(careen({"scene.json", "--out", "out", "--frames", "3"}).exitCode, 0);
  EXPECT_EQ(kept(), (Names{"000003.png", "film.json", "report.json"}));
  const Ended ended = compared();
  EXPECT_EQ(ended.exitCode, 2);
  EXPECT_NE(ended.err.find("holds a film, of which only what differs would be left"), std::string::npos)
      << ended.err;
  EXPECT_EQ(kept(), (Names{"000003.png", "film.json", "report.json"}));
}

TEST_F(RenderReference, whatElseIsInTheFolderStays) {
  fs::create_directory(folder_ / "out");
  folder_.write("out/notes.txt", "mine");
  EXPECT_EQ(compared().exitCode, 0);
  EXPECT_EQ(kept(), (Names{"junit.xml", "notes.txt"}));
}

// The scene cannot be simulated: who looks at it first would say so.
TEST_F(RenderReference, badReferenceOrOptionIsToldBeforeAnythingIsSimulated) {
  folder_.write("broken.json", "{");
  fs::create_directory(folder_ / "empty");
  fs::create_directory(folder_ / "frameless");
  fs::copy_file(folder_ / "ref/film.json", folder_ / "frameless/film.json");
  struct Case {
    std::string reference;
    Names more;
    std::string said;
  };
  const std::vector<Case> cases = {
      {"nowhere", {}, "--ref: nowhere is not there"},
      {"scene.json", {}, "--ref: scene.json is no folder"},
      {"empty", {}, "--ref: empty has no film.json"},
      {"frameless", {}, "--ref: frameless has none of the frames"},
      {"ref", {"--threshold", "nearly"}, "--threshold: "},
      {"ref", {"--allow", "fail=2"}, "--allow: found 'fail=2'"},
      {"ref", {"--motion", "0.05"}, "--motion: found 0.05 and --ref"},
      {"ref",
       {"--ignore", "70,0,11,1"},
       "--ignore: found 70,0,11,1, expected a rectangle within the pictures' 80x60"},
      {"ref", {"--out", "./ref/"}, "--out: found the folder of --ref"},
      {"ref", {"--frames", "100"}, "100"},
  };
  for (const Case& each : cases) {
    Names arguments = {"broken.json", "--ref", each.reference};
    arguments.insert(arguments.end(), each.more.begin(), each.more.end());
    const Ended ended = careen(arguments);
    EXPECT_EQ(ended.exitCode, 2) << each.said;
    EXPECT_NE(ended.err.find(each.said), std::string::npos) << ended.err;
    EXPECT_FALSE(fs::exists(folder_ / "out"));
  }
  EXPECT_TRUE(fs::exists(folder_ / "ref/000002.png"));
}

TEST_F(RenderReference, approvedFilmTakesTheReferencesPlace) {
  folder_.write("other.json", withReplaced(kReferenceScene, "[1, 2, 3]", "[-1, 2, 3]"));
  folder_.write("ref/notes.txt", "mine");
  fs::create_directories(folder_ / "ref/more");
  folder_.write("ref/more/notes.txt", "mine too");
  fs::create_symlink("notes.txt", folder_ / "ref/link");
  const std::string before = textOf(folder_ / "ref/000005.png");
  const Names files = folder_.files();
  EXPECT_EQ(compared({}, "other.json").exitCode, 1);
  fs::remove_all(folder_ / "out");
  const Ended ended = approved({}, "other.json");
  EXPECT_EQ(ended.exitCode, 0) << ended.out << ended.err;
  EXPECT_NE(ended.out.find("approved     2 of 2 frames changed: "), std::string::npos) << ended.out;
  EXPECT_EQ(ended.out.find(".partial"), std::string::npos) << ended.out;
  EXPECT_EQ(folder_.files(), files);
  EXPECT_NE(textOf(folder_ / "ref/000005.png"), before);
  EXPECT_EQ(textOf(folder_ / "ref/more/notes.txt"), "mine too");
  EXPECT_EQ(fs::read_symlink(folder_ / "ref/link"), "notes.txt");
  EXPECT_EQ(compared({"--threshold", "exact"}, "other.json").exitCode, 0);
}

TEST_F(RenderReference, approvedFilmThatIsTheSameKeepsItsBytes) {
  fs::remove(folder_ / "ref/report.json");
  std::string film = textOf(folder_ / "ref/film.json");
  film = withReplaced(film, "\"renderer\": \"", "\"renderer\": \"another ");
  folder_.write("ref/film.json", film);
  const Ended ended = approved();
  EXPECT_EQ(ended.exitCode, 0) << ended.out << ended.err;
  EXPECT_NE(ended.out.find("approved     0 of 2 frames changed, the film stays as it was: "),
            std::string::npos)
      << ended.out;
  EXPECT_EQ(textOf(folder_ / "ref/film.json"), film);
  EXPECT_EQ(namesIn("ref"), (Names{"000002.png", "000005.png", "film.json"}));
}

TEST_F(RenderReference, approvalTakesAMotionThatNoPictureShows) {
  folder_.write("other.json", withReplaced(kReferenceScene, "-10]", "-10.000000000000002]"));
  const Ended ended = approved({}, "other.json");
  EXPECT_EQ(ended.exitCode, 0) << ended.out << ended.err;
  EXPECT_NE(ended.out.find(", only the motion did: "), std::string::npos) << ended.out;
  EXPECT_EQ(compared({}, "other.json").exitCode, 0);
  EXPECT_EQ(compared().exitCode, 1);
}

TEST_F(RenderReference, approvalThatFailsLeavesTheOldFilm) {
  const Names files = folder_.files();
  const std::string before = textOf(folder_ / "ref/000005.png");
  const auto expectRefused = [&](const Ended& ended, const std::string& said) {
    EXPECT_EQ(ended.exitCode, 2) << said;
    EXPECT_NE(ended.err.find(said), std::string::npos) << ended.err;
    EXPECT_EQ(folder_.files(), files);
    EXPECT_EQ(textOf(folder_ / "ref/000005.png"), before);
  };
  expectRefused(approved({"--out", "out"}), "--out excludes --approve");
  expectRefused(approved({"--frames", "2"}), "--frames excludes --approve");
  expectRefused(careen({"scene.json", "--out", "out", "--approve"}), "--approve");
  const Ended inside =
      Process({CAREEN_BINARY, "render", "../scene.json", "--ref", ".", "--approve"}, folder_ / "ref").wait();
  expectRefused(inside, "--approve: found the current folder in --ref");
}

TEST_F(RenderReference, optionsOfComparingNeedOne) {
  EXPECT_EQ(careen({"scene.json", "--allow", "fail=0.1", "--out", "out"}).exitCode, 2);
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

}  // namespace
}  // namespace careen
