// Films that must pass for the same, each by its own tolerance: other threads, jobs, ways to draw,
// processors.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "compare/tolerance.h"
#include "core/file.h"
#include "mutation/subject.h"
#include "support/process.h"

namespace careen {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

// Mesa reads its variables when a process opens GL, so each way to draw is a process of its own.
struct Way {
  const char* name;
  const char* tolerance;
  Words variables;
  Words options;
};

const Way kPlain = {"plain", "exact", {}, {"--jobs", "1", "--threads", "0"}};

// 128 bits make this Mesa's LLVM end the process.
const std::vector<Way>& ways() {
  static const std::vector<Way> kWays = {
      {"1 thread", "exact", {}, {"--jobs", "1", "--threads", "1"}},
      {"2 threads", "exact", {}, {"--jobs", "1", "--threads", "2"}},
      {"2 jobs", "exact", {}, {"--jobs", "2"}},
      {"3 jobs", "exact", {}, {"--jobs", "3"}},
      {"through EGL", "exact", {}, {"--jobs", "1", "--rendering-backend", "egl"}},
      {"256 bits", "same-machine", {"LP_NATIVE_VECTOR_WIDTH=256"}, {"--jobs", "1", "--threads", "0"}},
      {"512 bits", "same-machine", {"LP_NATIVE_VECTOR_WIDTH=512"}, {"--jobs", "1", "--threads", "0"}},
      {"SSE2", "same-picture", {"GALLIUM_OVERRIDE_CPU_CAPS=sse2"}, {"--jobs", "1", "--threads", "0"}},
      {"SSE4.1", "same-picture", {"GALLIUM_OVERRIDE_CPU_CAPS=sse4.1"}, {"--jobs", "1", "--threads", "0"}},
      {"AVX", "same-picture", {"GALLIUM_OVERRIDE_CPU_CAPS=avx"}, {"--jobs", "1", "--threads", "0"}},
      {"softpipe", "other-renderer", {"GALLIUM_DRIVER=softpipe"}, {"--jobs", "2"}}};
  return kWays;
}

const std::array kFrames = {"000000", "000012", "000040"};
const char* const kFrameList = "0,12,40";

// Half of them are others than those the tolerances were measured with.
const std::array kScenes = {"careen", "wall",    "gas",         "hecker_1997",
                            "stack",  "incline", "galperin_pi", "housner"};

std::string fileName(std::string scene) {
  std::replace(scene.begin(), scene.end(), '_', '-');
  return scene + ".json";
}

DeepPicture readDeep(const fs::path& path) { return decodeDeepPng(readFile(path), path.string()); }

class Pairs : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const fs::path scene = fs::path(CAREEN_SOURCE_DIR) / "assets" / "scenes" / fileName(GetParam());
    run({}, {"simulate", scene.string(), "--duration", "1.5", "-o", "run.careen"});
    draw(kPlain, kFrameList, {});
  }

  void run(const Words& variables, const Words& arguments) {
    Words command = {"env"};
    command.insert(command.end(), variables.begin(), variables.end());
    command.emplace_back(CAREEN_BINARY);
    command.insert(command.end(), arguments.begin(), arguments.end());
    const Ended ended = Process(command, folder_.path()).wait();
    ASSERT_EQ(ended.exitCode, 0) << ended.err;
  }
  void draw(const Way& way, const std::string& frames, const Words& more) {
    const char* const height = std::getenv("CAREEN_MUTATION_HEIGHT");
    const int rows = height == nullptr ? 180 : std::stoi(height);
    Words arguments = {
        "render",   "run.careen", "--out",  way.name,
        "--frames", frames,       "--size", std::to_string(rows * 16 / 9) + "x" + std::to_string(rows)};
    arguments.insert(arguments.end(), way.options.begin(), way.options.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    run(way.variables, arguments);
  }
  void expectSame(const Way& way) {
    const Tolerance tolerance = toleranceOf(way.tolerance);
    for (const std::string frame : kFrames) {
      const fs::path expected = folder_ / kPlain.name / (frame + ".png");
      const fs::path actual = folder_ / way.name / (frame + ".png");
      const bool identical = textOf(expected) == textOf(actual);
      const PictureDifference difference = differenceOf(readDeep(expected), readDeep(actual));
      const Judgement judgement = judge(difference, tolerance);
      EXPECT_NE(judgement.verdict, Verdict::kDifferent)
          << way.name << ", " << frame << ": " << judgement.reasons.at(0);
      const Margin margin = marginOf(difference, tolerance);
      EXPECT_EQ(judgement.verdict == Verdict::kDifferent, margin.ratio > 1) << way.name << ", " << frame;
      std::printf("%-12s %-12s %s %-14s %s %s %.3g\n", GetParam(), way.name, frame.c_str(), way.tolerance,
                  identical ? "same bytes" : "", margin.criterion.c_str(), margin.ratio);
    }
  }

  TemporaryFolder folder_;
};

TEST_P(Pairs, passWhicheverWayTheyAreDrawn) {
  for (const Way& way : ways()) {
    draw(way, kFrameList, {});
    if (HasFatalFailure()) {
      return;
    }
    expectSame(way);
  }
  Way inParts = kPlain;
  inParts.name = "resumed";
  draw(inParts, kFrames[2], {});
  draw(inParts, kFrameList, {"--resume"});
  expectSame(inParts);
}

INSTANTIATE_TEST_SUITE_P(Of, Pairs, testing::ValuesIn(kScenes),
                         [](const auto& scene) { return std::string(scene.param); });

TEST(AllPairs, areTwoHundred) {
  const std::size_t count = kScenes.size() * kFrames.size() * (ways().size() + 1);
  EXPECT_GE(count, 200U);
  std::printf("%zu pairs\n", count);
}

}  // namespace
}  // namespace careen
