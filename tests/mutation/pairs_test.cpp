// Films that must count as the same, each by its own tolerance: other threads, jobs, renderers, processors.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "compare/tolerance.h"
#include "film/manifest.h"
#include "mutation/subject.h"
#include "support/process.h"

namespace careen {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

// Mesa reads its variables when a process opens GL, so each way of drawing is a process of its own.
struct Way {
  const char* name;
  const char* tolerance;
  const char* renderer;  ///< part of the GL renderer string then
  Words variables;
  Words options;
};

const Words kOneJob = {"--jobs", "1", "--threads", "0"};
const Way kPlain = {"plain", "exact", "llvmpipe", {}, kOneJob};

// With 128-bit vectors llvmpipe of Mesa 22.3 crashes on processors with wider ones, and 512 acts as 256: see
// rendering_backend.cpp. Processors without AVX have 128.
const std::vector<Way>& ways() {
  static const std::vector<Way> kWays = {
      {"1 thread", "exact", "llvmpipe", {}, {"--jobs", "1", "--threads", "1"}},
      {"2 threads", "exact", "llvmpipe", {}, {"--jobs", "1", "--threads", "2"}},
      {"2 jobs", "exact", "llvmpipe", {}, {"--jobs", "2"}},
      {"3 jobs", "exact", "llvmpipe", {}, {"--jobs", "3"}},
      {"through EGL", "exact", "libEGL", {}, {"--jobs", "1", "--rendering-backend", "egl"}},
      {"256 bits", "same-machine", "256 bits", {"LP_NATIVE_VECTOR_WIDTH=256"}, kOneJob},
      {"512 bits asked for", "same-machine", "256 bits", {"LP_NATIVE_VECTOR_WIDTH=512"}, kOneJob},
      {"SSE2", "same-picture", "128 bits", {"GALLIUM_OVERRIDE_CPU_CAPS=sse2"}, kOneJob},
      {"SSE4.1", "same-picture", "128 bits", {"GALLIUM_OVERRIDE_CPU_CAPS=sse4.1"}, kOneJob},
      {"AVX", "same-picture", "llvmpipe", {"GALLIUM_OVERRIDE_CPU_CAPS=avx"}, kOneJob},
      {"softpipe", "other-renderer", "softpipe", {"GALLIUM_DRIVER=softpipe"}, {"--jobs", "2"}}};
  return kWays;
}

const std::array kFrameNames = {"000000", "000012", "000040"};
const char* const kFrameList = "0,12,40";

// Half of them were not used to measure the tolerances.
const std::array kScenes = {"careen", "wall",    "gas",         "hecker_1997",
                            "stack",  "incline", "galperin_pi", "housner"};

std::string fileName(std::string scene) {
  std::replace(scene.begin(), scene.end(), '_', '-');
  return scene + ".json";
}

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
    Words arguments = {"render",   "run.careen",
                       "--out",    way.name,
                       "--frames", frames,
                       "--size",   std::to_string(pictureWidth()) + "x" + std::to_string(pictureHeight())};
    arguments.insert(arguments.end(), way.options.begin(), way.options.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    run(way.variables, arguments);
  }
  void expectSame(const Way& way) {
    const std::optional<FilmManifest> manifest = readManifest(folder_ / way.name);
    ASSERT_TRUE(manifest);
    EXPECT_NE(manifest->renderer.find(way.renderer), std::string::npos)
        << way.name << ": " << manifest->renderer;
    const Tolerance tolerance = toleranceOf(way.tolerance);
    for (const std::string frame : kFrameNames) {
      const fs::path expected = folder_ / kPlain.name / (frame + ".png");
      const fs::path actual = folder_ / way.name / (frame + ".png");
      const bool identical = textOf(expected) == textOf(actual);
      const PictureDifference difference = differenceOf(readDeepPng(expected), readDeepPng(actual));
      const PictureJudgement judgement = judge(difference, tolerance);
      EXPECT_NE(judgement.verdict, Verdict::kDifferent)
          << way.name << ", " << frame << ": " << judgement.reasons.at(0);
      const Margin margin = marginOf(difference, tolerance);
      EXPECT_EQ(judgement.verdict == Verdict::kDifferent, margin.ratio > 1) << way.name << ", " << frame;
      std::printf("%-12s %-18s %s %-14s %s%s %.3g\n", GetParam(), way.name, frame.c_str(), way.tolerance,
                  identical ? "same bytes, " : "", margin.criterion.c_str(), margin.ratio);
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
  inParts.name = "in parts";
  for (const char* const frame : {kFrameNames[2], kFrameNames[0], kFrameNames[1]}) {
    draw(inParts, frame, {"--resume"});
  }
  expectSame(inParts);
}

INSTANTIATE_TEST_SUITE_P(Of, Pairs, testing::ValuesIn(kScenes),
                         [](const auto& scene) { return std::string(scene.param); });

TEST(AllPairs, areTwoHundred) {
  const std::size_t count = kScenes.size() * kFrameNames.size() * (ways().size() + 1);
  EXPECT_GE(count, 200U);
  std::printf("%zu pairs\n", count);
}

}  // namespace
}  // namespace careen
