// Calls of the system that fail, each in turn: a film is whole or not there, and the program says why.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/film_command.h"
#include "support/process.h"

namespace careen {
namespace {

class RenderFailing : public test::FilmCommand, public testing::WithParamInterface<const char*> {
 protected:
  std::filesystem::path mark() const { return folder_ / "failed"; }

  // Films three frames and a video while the n-th call of that kind fails.
  Ended film(int call) const {
    return Process({"env", "LD_PRELOAD=" CAREEN_FAILING_CALLS, "CAREEN_FAIL_IN=" CAREEN_BINARY,
                    "CAREEN_FAIL=" + std::string(GetParam()) + ":" + std::to_string(call),
                    "CAREEN_FAILED=" + mark().string(), CAREEN_BINARY, "render", "scene.json", "--out",
                    "film", "--frames", "0-2", "--video", "film.mkv", "--jobs", "1"},
                   folder_.path())
        .wait();
  }
  std::string framesOfVideo() const {
    return Process({"ffprobe", "-v", "error", "-count_frames", "-select_streams", "v", "-show_entries",
                    "stream=nb_read_frames", "-of", "csv=p=0", "film.mkv"},
                   folder_.path())
        .wait()
        .out;
  }
  void expectNothingHalf() const {
    EXPECT_FALSE(hasPartials());
    if (std::filesystem::exists(folder_ / "film")) {
      for (const auto& entry : std::filesystem::directory_iterator(folder_ / "film")) {
        const std::string text = textOf(entry.path());
        if (entry.path().extension() == ".png") {
          EXPECT_TRUE(text.ends_with(std::string("IEND\xAE\x42\x60\x82"))) << entry.path();
        } else {
          EXPECT_TRUE(nlohmann::json::accept(text)) << entry.path();
        }
      }
    }
    if (std::filesystem::exists(folder_ / "film.mkv")) {
      EXPECT_EQ(framesOfVideo(), "3\n");
    }
  }
};

// A call may fail without harm, as that which closes a socket (9 of 15): then the film must be whole.
TEST_P(RenderFailing, aFilmIsWholeOrToldToHaveFailed) {
  int call = 1;
  int told = 0;
  for (bool failed = true; failed; ++call) {
    const Ended ended = film(call);
    SCOPED_TRACE(std::string(GetParam()) + " " + std::to_string(call) + ": " + ended.err);
    failed = std::filesystem::remove(mark());
    EXPECT_TRUE(ended.exitCode == 3 || ended.exitCode == 0) << ended.exitCode << ' ' << ended.signal;
    expectNothingHalf();
    if (ended.exitCode == 0) {
      EXPECT_EQ(careen({"verify", "film"}).exitCode, 0);
      EXPECT_EQ(framesOfVideo(), "3\n");
    } else {
      EXPECT_TRUE(failed);
      EXPECT_NE(ended.err.find("careen: "), std::string::npos);
      ++told;
    }
    std::filesystem::remove_all(folder_ / "film");
    std::filesystem::remove(folder_ / "film.mkv");
    ASSERT_LT(call, 1000);
  }
  EXPECT_GE(told, 1);
}

INSTANTIATE_TEST_SUITE_P(Calls, RenderFailing,
                         testing::Values("write", "send", "close", "rename", "fork", "open"),
                         [](const auto& kind) { return std::string(kind.param); });

// What is out of memory in a call of another library may end a process of its own by a signal; that is told,
// too. The first calls come before main, from the libraries' own beginning.
class RenderWithoutMemory : public RenderFailing {};

TEST_P(RenderWithoutMemory, isToldToHaveFailed) {
  int told = 0;
  for (const int call : {100, 400, 1600, 3200, 6400, 12800}) {
    const Ended ended = film(call);
    SCOPED_TRACE(std::to_string(call) + ": " + ended.err);
    EXPECT_TRUE(ended.exitCode == 3 || ended.exitCode == 0) << ended.exitCode << ' ' << ended.signal;
    EXPECT_TRUE(ended.exitCode == 0 || ended.err.find("careen: ") != std::string::npos);
    expectNothingHalf();
    told += ended.exitCode == 3 ? 1 : 0;
    std::filesystem::remove(mark());
    std::filesystem::remove_all(folder_ / "film");
    std::filesystem::remove(folder_ / "film.mkv");
  }
  EXPECT_GE(told, 1);
}

INSTANTIATE_TEST_SUITE_P(Calls, RenderWithoutMemory, testing::Values("malloc"),
                         [](const auto& kind) { return std::string(kind.param); });

}  // namespace
}  // namespace careen
