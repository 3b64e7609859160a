#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/process.h"

namespace careen {

/// Tests of what the library does beside the program, in a folder of their own.
class BesideProgram : public testing::Test {
 protected:
  Ended ended(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), CAREEN_BINARY);
    return Process(arguments, folder_.path()).wait();
  }
  /// One that must succeed.
  Ended program(const std::vector<std::string>& arguments) const {
    const Ended done = ended(arguments);
    EXPECT_EQ(done.exitCode, 0) << done.err;
    return done;
  }

  TemporaryFolder folder_;
};

}  // namespace careen
