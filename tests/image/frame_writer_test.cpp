#include "image/frame_writer.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <future>
#include <string>
#include <vector>

#include "core/error.h"
#include "image/png.h"
#include "pictures.h"
#include "support/process.h"

namespace careen {
namespace {

using namespace std::chrono_literals;

// As on a disk with so little room left, root or not.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{.rlim_cur = bytes, .rlim_max = before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

std::string errorOfFinish(FrameWriter& writer) {
  try {
    writer.finish();
  } catch (const MachineError& error) {
    return error.what();
  }
  return {};
}

TEST(FrameWriter, namesFramesWithSixDigitsAndMoreWhereNeeded) {
  EXPECT_EQ(frameFileName(0), "000000.png");
  EXPECT_EQ(frameFileName(119), "000119.png");
  EXPECT_EQ(frameFileName(1234567), "1234567.png");
}

TEST(FrameWriter, writesEveryFrameUnderItsNumber) {
  const TemporaryFolder folder;
  FrameWriter writer(folder.path());
  for (const std::int64_t frame : {4, 5, 6, 100}) {
    writer.push(frame, shadedTiles(120, 80, static_cast<unsigned>(frame)));
  }
  writer.finish();
  EXPECT_EQ(folder.files(),
            (std::vector<std::string>{"000004.png", "000005.png", "000006.png", "000100.png"}));
  EXPECT_EQ(readPng(folder / "000006.png").rgb, shadedTiles(120, 80, 6).rgb);
  EXPECT_GT(writer.coreSeconds(), 0);
  EXPECT_GE(writer.wallSeconds(), 0.5 * writer.coreSeconds());  // measured 1.007 and more
}

TEST(FrameWriter, failureComesToTheCallerByTheNextCall) {
  const TemporaryFolder folder;
  FrameWriter writer(folder / "no/such/folder");
  std::string said;
  for (int frame = 0; frame < 100 && said.empty(); ++frame) {
    try {
      writer.push(frame, shadedTiles(8, 8));
    } catch (const MachineError& error) {
      said = error.what();
    }
  }
  EXPECT_NE(said.find("no/such/folder/"), std::string::npos) << said;
  EXPECT_THROW(writer.push(100, shadedTiles(8, 8)), MachineError);
  EXPECT_THROW(writer.finish(), MachineError);
}

TEST(FrameWriter, fullDiskIsAnErrorAndLeavesNoFile) {
  const TemporaryFolder folder;
  const FileSizeLimit limit(2000);  // the frame's file: measured 57970
  FrameWriter writer(folder.path());
  writer.push(0, shadedTiles(400, 300));
  const std::string said = errorOfFinish(writer);
  EXPECT_NE(said.find("000000.png: cannot be written: File too large"), std::string::npos) << said;
  EXPECT_TRUE(folder.files().empty());
}

// The file of frame 0 is a pipe that nobody reads yet, so the writer's thread stands still in it.
class BlockedFrame {
 public:
  explicit BlockedFrame(const TemporaryFolder& folder)
      : path_(folder / (".000000.png." + std::to_string(getpid()) + ".partial")) {
    if (mkfifo(path_.c_str(), 0600) != 0) {
      throw std::runtime_error("no pipe");
    }
  }
  ~BlockedFrame() { close(reader_); }
  BlockedFrame(const BlockedFrame&) = delete;
  BlockedFrame& operator=(const BlockedFrame&) = delete;
  void release() { reader_ = open(path_.c_str(), O_RDONLY | O_NONBLOCK); }

 private:
  std::filesystem::path path_;
  int reader_ = -1;
};

TEST(FrameWriter, pushWaitsWhileTwoFramesWait) {
  const TemporaryFolder folder;
  BlockedFrame blocked(folder);
  FrameWriter writer(folder.path());
  writer.push(0, shadedTiles(8, 8));
  writer.push(1, shadedTiles(8, 8));
  writer.push(2, shadedTiles(8, 8));  // waits until frame 0 is taken up
  const std::future<void> fourth =
      std::async(std::launch::async, [&writer] { writer.push(3, shadedTiles(8, 8)); });
  EXPECT_EQ(fourth.wait_for(200ms), std::future_status::timeout);
  blocked.release();
  EXPECT_EQ(fourth.wait_for(10s), std::future_status::ready);
  writer.finish();
  EXPECT_TRUE(std::filesystem::exists(folder / "000003.png"));
}

TEST(FrameWriter, finishesTheFrameBegunAndDropsTheRestWhenGivenUp) {
  const TemporaryFolder folder;
  BlockedFrame blocked(folder);
  auto writer = std::make_unique<FrameWriter>(folder.path());
  for (int frame = 0; frame < 3; ++frame) {
    writer->push(frame, shadedTiles(64, 36));
  }
  const std::future<void> gone = std::async(std::launch::async, [&writer] { writer.reset(); });
  EXPECT_EQ(gone.wait_for(100ms), std::future_status::timeout);
  blocked.release();
  gone.wait();
  EXPECT_EQ(folder.files(), std::vector<std::string>{"000000.png"});
}

TEST(FrameWriter, feedsTheVideoFromWrittenFramesToo) {
  const TemporaryFolder folder;
  writePng(folder / "000000.png", shadedTiles(64, 48, 1));
  FrameWriter writer(folder.path(), std::make_unique<VideoPipe>(VideoSettings{
                                        .path = folder / "film.mp4", .width = 64, .height = 48}));
  writer.pushWritten(0);
  writer.push(1, shadedTiles(64, 48, 2));
  writer.finish();
  EXPECT_EQ(folder.files(), (std::vector<std::string>{"000000.png", "000001.png", "film.mp4"}));
  EXPECT_GT(std::filesystem::file_size(folder / "film.mp4"), 500U);  // measured 1696
}

TEST(FrameWriter, givenUpLeavesNoVideo) {
  const TemporaryFolder folder;
  {
    FrameWriter writer(folder.path(), std::make_unique<VideoPipe>(VideoSettings{
                                          .path = folder / "film.mp4", .width = 640, .height = 360}));
    writer.push(0, shadedTiles(640, 360));
  }
  for (const std::string& file : folder.files()) {
    EXPECT_EQ(file, "000000.png");
  }
}

}  // namespace
}  // namespace careen
