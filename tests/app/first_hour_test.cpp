// What a newcomer meets in the first hour ends with what to do next.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/system/release.h"
#include "support/process.h"
#include "support/program.h"

namespace careen {
namespace {

class FirstHour : public testing::Test {
 protected:
  Ended run(const std::vector<std::string>& words) const { return Process(words, folder_.path()).wait(); }
  Ended careen(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), program());
    return run(arguments);
  }
  // Ends with that code, and its last words hold these.
  static void expectLastWords(const Ended& ended, int code, const std::string& words) {
    EXPECT_EQ(ended.exitCode, code) << ended.err;
    const std::string text = ended.err.substr(0, ended.err.find_last_not_of('\n') + 1);
    const std::string last = text.substr(text.rfind('\n') + 1);
    EXPECT_NE(last.find(words), std::string::npos) << ended.err;
  }

  TemporaryFolder folder_;
};

TEST_F(FirstHour, bareProgramShowsHelp) {
  const Ended ended = careen({});
  EXPECT_EQ(ended.exitCode, 0);
  EXPECT_EQ(ended.err, "");
  EXPECT_EQ(ended.out, careen({"--help"}).out);
  EXPECT_NE(ended.out.find("careen help tutorial"), std::string::npos);
}

TEST_F(FirstHour, wrongWordsAreUnderstood) {
  expectLastWords(careen({"simulat"}), 2, "did you mean 'simulate'?");
  expectLastWords(careen({"frobnicate"}), 2, "'careen --help' lists them");
  expectLastWords(careen({"simulate", "--tolerence", "1"}), 2,
                  "simulate: knows no option '--tolerence'; did you mean '--tolerance'?; 'careen "
                  "simulate --help'");
  expectLastWords(careen({"simulate", "fall.json", "--dt=1", "--impact=1.csv"}), 2,
                  "did you mean '--impacts'?");
  expectLastWords(careen({"simulate", "fall.json", "fall.csv"}), 2, "'fall.csv', expected no more arguments");
  expectLastWords(careen({"--frobnicate", "fall.json"}), 2,
                  "careen: knows no option '--frobnicate'; 'careen --help'");
  expectLastWords(careen({"simulate", "--alpha"}), 2,
                  "careen: simulate: knows no option '--alpha'; 'careen simulate --help'");
  expectLastWords(careen({"export", "run.careen"}), 2, "'careen export --help'");
  folder_.write("fall.json", "{}");
  expectLastWords(careen({"fall.json"}), 2, "to film it: careen render fall.json");
}

TEST_F(FirstHour, scenesThatCannotBeRead) {
  expectLastWords(careen({"simulate", "nowhere.json"}), 2, "next: look at the name");
  for (const char* const text :
       {"{", "{}", R"({"careen": 1, "duration": 1, "boxes": [{"half_extents": [1,1,1], "mas": 1}]})"}) {
    folder_.write("scene.json", text);
    expectLastWords(careen({"simulate", "scene.json"}), 2, "next: 'careen help scenes'");
  }
  folder_.write("scene.json", R"({"careen": 1, "duration": 1,})");
  EXPECT_NE(careen({"simulate", "scene.json"}).err.find("after the comma"), std::string::npos);
  folder_.write("scene.json", R"({"careen": 1, "duration": 1, "boxes": [{"half_extents": [1,1,1], "mass": 1}],
    "walls": [{"point": [0,0,0], "normal": [0,0,1]}]})");
  expectLastWords(careen({"simulate", "scene.json"}), 2, "or let --allow-overlap do it");
  expectLastWords(careen({"compare", "scene.json", "scene.json"}), 2, "next: give two pictures");
  expectLastWords(careen({"audit", "scene.json"}), 2, "next: make one: careen simulate");
  std::filesystem::create_directory(folder_ / "folder");
  expectLastWords(careen({"simulate", "folder"}), 2, "next: name a file in it");
  folder_.write("scene.json", R"({"careen": 1, "duration": 1, "boxes": [
    {"half_extents": [1,1,1], "mass": 1}, {"half_extents": [1,1,1], "mass": 1}]})");
  expectLastWords(careen({"simulate", "scene.json"}), 2, "--allow-overlap");
  expectLastWords(careen({"compare", "this", "that"}), 2, "next: look at the names");
}

// Root may write anywhere; its tests run as somebody who may not.
TEST_F(FirstHour, placesThatMayNotBeWritten) {
  folder_.write("scene.json",
                R"({"careen": 1, "duration": 1, "boxes": [{"half_extents": [1,1,1], "mass": 1}]})");
  std::filesystem::create_directory(folder_ / "closed");
  ASSERT_EQ(chmod((folder_ / "closed").c_str(), 0555), 0);
  ASSERT_EQ(chmod(folder_.path().c_str(), 0755), 0);
  std::vector<std::string> words = {program(), "simulate", "scene.json", "-o", "closed/run.careen"};
  if (geteuid() == 0) {
    const std::vector<std::string> other = {"setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"};
    words.insert(words.begin(), other.begin(), other.end());
  }
  expectLastWords(run(words), 3, "next: choose a place");
  expectLastWords(careen({"simulate", "scene.json", "-o", "nowhere/run.careen"}), 3,
                  "next: make that folder");
}

#ifdef CAREEN_RENDER
class RenderInTheFirstHour : public FirstHour {};

TEST_F(RenderInTheFirstHour, noDisplay) {
  expectLastWords(run({"env", "-u", "DISPLAY", "-u", "WAYLAND_DISPLAY", program(), "view"}), 3,
                  "careen render");
}

TEST_F(RenderInTheFirstHour, aFileWhereAFolderIsToBe) {
  folder_.write("out", "");
  expectLastWords(careen({"render", "--frames", "0", "--size", "64x36"}), 3, "next: choose another place");
}

TEST_F(RenderInTheFirstHour, noFfmpeg) {
  expectLastWords(run({"env", "PATH=" + folder_.path().string(), program(), "render", "--frames", "0",
                       "--size", "64x36", "--video", "film.mp4"}),
                  3, "apt install ffmpeg");
}

// Both libraries of GL are hidden by files of their names that hold nothing.
TEST_F(RenderInTheFirstHour, noGl) {
  for (const char* const library :
       {"libOSMesa.so", "libOSMesa.so.8", "libOSMesa.so.6", "libEGL.so.1", "libEGL.so"}) {
    folder_.write(library, "no library");
  }
  expectLastWords(
      run({"env", "LD_LIBRARY_PATH=" + folder_.path().string(), program(), "render", "--frames", "0"}), 3,
      "next: install one: apt install " + std::string(drawingPackages()));
}
#endif

}  // namespace
}  // namespace careen
