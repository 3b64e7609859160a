#include "core/system/standard_streams.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/system/worker.h"

namespace careen {
namespace {

struct Streams {
  bool areOpen = false;
  bool nextIsBehind = false;
};

// In a process of its own, because the test's own streams are needed.
TEST(StandardStreams, thatAreClosedAreOpenedOnNothing) {
  Worker worker([](const Channel& channel) {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
      close(stream);
    }
    openStandardStreams();
    struct stat nothing {};
    stat("/dev/null", &nothing);
    Streams found{.areOpen = true, .nextIsBehind = open("/dev/null", O_RDONLY) > STDERR_FILENO};
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
      struct stat opened {};
      found.areOpen = found.areOpen && fstat(stream, &opened) == 0 && opened.st_rdev == nothing.st_rdev;
    }
    channel.send(found);
  });
  Streams found;
  ASSERT_TRUE(worker.channel().receive(found));
  EXPECT_TRUE(found.areOpen);
  EXPECT_TRUE(found.nextIsBehind);
}

TEST(StandardStreams, thatAreOpenStayAsTheyAre) {
  struct stat before {};
  struct stat after {};
  ASSERT_EQ(fstat(STDOUT_FILENO, &before), 0);
  openStandardStreams();
  ASSERT_EQ(fstat(STDOUT_FILENO, &after), 0);
  EXPECT_EQ(before.st_ino, after.st_ino);
}

}  // namespace
}  // namespace careen
