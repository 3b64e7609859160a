// Films that something stops, and the second run that completes them.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "support/film_command.h"
#include "support/process.h"

namespace careen {
namespace {

// In the order they were made in.
std::vector<pid_t> childrenOf(pid_t parent) {
  std::vector<pid_t> children;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const std::string name = entry.path().filename();
    const std::string status = textOf(entry.path() / "status");
    if (name.find_first_not_of("0123456789") == std::string::npos &&
        status.find("\nPPid:\t" + std::to_string(parent) + "\n") != std::string::npos) {
      children.push_back(std::stoi(name));
    }
  }
  std::sort(children.begin(), children.end());
  return children;
}

class RenderInterrupted : public test::FilmCommand {
 protected:
  /// Makes a film of a hundred frames.
  static std::vector<std::string> longFilm(const std::string& jobs) {
    return {CAREEN_BINARY, "render", "scene.json", "--out", "film", "--fps", "100", "--jobs", jobs};
  }
  void waitUntilInTheMiddle() const {
    for (int tries = 0; tries < 1000 && !std::filesystem::exists(folder_ / "film/000005.png"); ++tries) {
      usleep(5'000);
    }
  }
};

// No file may grow past 1 kB, as on a full disk.
TEST_F(RenderInterrupted, fullDiskEndsTheFilmWithNothingHalfWritten) {
  const Ended ended = Process({"bash", "-c",
                               std::string("trap '' XFSZ; ulimit -f 1; exec ") + CAREEN_BINARY +
                                   " render scene.json --out film --size 640x480"},
                              folder_.path())
                          .wait();
  EXPECT_EQ(ended.exitCode, 3) << ended.err;
  EXPECT_NE(ended.err.find("cannot be written"), std::string::npos) << ended.err;
  EXPECT_FALSE(hasPartials());
}

TEST_F(RenderInterrupted, interruptedFilmIsCompletedByASecondRun) {
  ASSERT_EQ(careen({"render", "scene.json", "--out", "whole", "--fps", "100"}).exitCode, 0);
  struct Case {
    int signal;
    std::string jobs;
  };
  for (const Case& each : {Case{SIGINT, "1"}, {SIGTERM, "1"}, {SIGINT, "3"}, {SIGTERM, "3"}}) {
    std::filesystem::remove_all(folder_ / "film");
    Process process(longFilm(each.jobs), folder_.path());
    waitUntilInTheMiddle();
    const std::vector<pid_t> workers = childrenOf(process.id());
    EXPECT_EQ(std::to_string(workers.size()), each.jobs);
    process.send(each.signal);
    const Ended ended = process.wait();
    EXPECT_EQ(ended.signal, each.signal) << ended.exitCode << ended.err;
    EXPECT_TRUE(ended.err.ends_with("careen: interrupted; --resume completes the film\n")) << ended.err;
    for (const pid_t worker : workers) {
      EXPECT_NE(kill(worker, 0), 0);
    }
    EXPECT_FALSE(hasPartials());
    const std::size_t written = framesIn("film").size();
    EXPECT_GT(written, 0U);
    EXPECT_LT(written, 100U);
    EXPECT_EQ(careen({"verify", "film"}).exitCode, 1);

    const Ended second = careen({"render", "scene.json", "--out", "film", "--fps", "100", "--resume"});
    ASSERT_EQ(second.exitCode, 0) << second.err;
    expectSameFilm("film", "whole");
    EXPECT_EQ(careen({"verify", "film"}).exitCode, 0);
  }
}

// An ffmpeg that takes no frame and does not end.
TEST_F(RenderInterrupted, interruptedFilmEndsAnEncoderThatHangs) {
  std::filesystem::create_directory(folder_ / "bin");
  folder_.write("bin/ffmpeg", "#!/bin/sh\nexec sleep 1000\n");
  std::filesystem::permissions(folder_ / "bin/ffmpeg", std::filesystem::perms::owner_all);
  Process process(
      {"bash", "-c", "PATH=$PWD/bin:$PATH exec \"$0\" render scene.json --out film --video film.mp4",
       CAREEN_BINARY},
      folder_.path());
  waitUntilInTheMiddle();
  const std::vector<pid_t> programs = childrenOf(process.id());
  EXPECT_FALSE(programs.empty());
  process.send(SIGINT);
  EXPECT_EQ(process.wait().signal, SIGINT);
  for (const pid_t program : programs) {
    EXPECT_NE(kill(program, 0), 0);
  }
  EXPECT_FALSE(hasPartials());
  EXPECT_FALSE(std::filesystem::exists(folder_ / "film.mp4"));
}

TEST_F(RenderInterrupted, killedFilmIsCompletedByASecondRun) {
  ASSERT_EQ(careen({"render", "scene.json", "--out", "whole", "--fps", "100"}).exitCode, 0);
  Process process(longFilm("3"), folder_.path());
  waitUntilInTheMiddle();
  process.send(SIGKILL);
  EXPECT_EQ(process.wait().signal, SIGKILL);
  const Ended second = careen({"render", "scene.json", "--out", "film", "--fps", "100", "--resume"});
  ASSERT_EQ(second.exitCode, 0) << second.err;
  EXPECT_FALSE(hasPartials());
  expectSameFilm("film", "whole");
}

// Only one at a time is let in. The others wait a moment or are refused; when those have tried again the film
// is whole, and its manifest tells of all of it.
TEST_F(RenderInterrupted, processesThatMeetInOneFolderLoseNothing) {
  ASSERT_EQ(careen({"render", "scene.json", "--out", "whole", "--fps", "40"}).exitCode, 0);
  ASSERT_EQ(framesIn("whole").size(), 40U);
  const auto start = [this](const std::string& frames) {
    return std::make_unique<Process>(
        std::vector<std::string>{CAREEN_BINARY, "render", "scene.json", "--out", "film", "--fps", "40",
                                 "--jobs", "1", "--resume", "--frames", frames},
        folder_.path());
  };
  std::vector<std::string> waiting = {"0-9", "10-19", "20-29", "30-39"};
  while (!waiting.empty()) {
    std::vector<std::unique_ptr<Process>> processes;
    std::transform(waiting.begin(), waiting.end(), std::back_inserter(processes), start);
    std::vector<std::string> again;
    for (std::size_t i = 0; i < processes.size(); ++i) {
      const Ended ended = processes[i]->wait();
      if (ended.exitCode != 0) {
        EXPECT_EQ(ended.exitCode, 2) << ended.err;
        EXPECT_NE(ended.err.find("another careen is writing there"), std::string::npos) << ended.err;
        again.push_back(waiting[i]);
      }
    }
    ASSERT_LT(again.size(), waiting.size());
    waiting = again;
  }
  const Ended verified = careen({"verify", "film"});
  EXPECT_EQ(verified.exitCode, 0) << verified.out;
  EXPECT_TRUE(verified.out.starts_with("40 frames, 0 missing")) << verified.out;
  expectSameFilm("film", "whole");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "film/.careen.lock"));
}

TEST_F(RenderInterrupted, workerThatDiesEndsTheFilmWithNothingHalfWritten) {
  std::vector<std::string> command = longFilm("3");
  command.insert(command.end(), {"--video", "film.mp4"});
  Process process(command, folder_.path());
  waitUntilInTheMiddle();
  std::vector<pid_t> children = childrenOf(process.id());
  ASSERT_EQ(children.size(), 4U);  // ffmpeg is the fourth, started last
  kill(children[1], SIGKILL);
  const Ended ended = process.wait();
  EXPECT_EQ(ended.exitCode, 3) << ended.err;
  EXPECT_NE(ended.err.find("a process that draws frames died: killed by signal 9 (Killed)"),
            std::string::npos)
      << ended.err;
  for (const pid_t child : children) {
    EXPECT_NE(kill(child, 0), 0);
  }
  EXPECT_FALSE(hasPartials());
  EXPECT_FALSE(std::filesystem::exists(folder_ / "film.mp4"));
  for (const std::string& frame : framesIn("film")) {
    EXPECT_TRUE(textOf(folder_ / "film" / frame).ends_with("IEND\xae\x42\x60\x82")) << frame;
  }
}

TEST_F(RenderInterrupted, resumeDoesNotMixTwoFilms) {
  ASSERT_EQ(careen({"render", "scene.json", "--out", "film", "--frames", "0-2"}).exitCode, 0);
  const Ended ended = careen({"render", "scene.json", "--out", "film", "--size", "80x60", "--resume"});
  EXPECT_EQ(ended.exitCode, 2) << ended.err;
  EXPECT_EQ(framesIn("film").size(), 3U);
}

}  // namespace
}  // namespace careen
