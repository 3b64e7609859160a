#include "core/error.h"

#include <gtest/gtest.h>

#include <string>
#include <type_traits>

namespace careen {
namespace {

template <class Thrown>
ExitCode codeOf() {
  try {
    throw Thrown("room.json:3:7: found \"x\"");
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "room.json:3:7: found \"x\"");
    return error.code();
  }
}

TEST(Error, ofEveryKindIsCaughtAsOneAndKnowsItsExitCode) {
  EXPECT_EQ(codeOf<InputError>(), ExitCode::kBadInput);
  EXPECT_EQ(codeOf<MachineError>(), ExitCode::kMachineFailed);
  EXPECT_EQ(codeOf<NumericalError>(), ExitCode::kNumbersFailed);
}

// What shell scripts and CI systems rely on.
TEST(Error, exitCodesAreThoseThatAreDocumented) {
  EXPECT_EQ(static_cast<int>(ExitCode::kDone), 0);
  EXPECT_EQ(static_cast<int>(ExitCode::kDifferent), 1);
  EXPECT_EQ(static_cast<int>(ExitCode::kBadInput), 2);
  EXPECT_EQ(static_cast<int>(ExitCode::kMachineFailed), 3);
  EXPECT_EQ(static_cast<int>(ExitCode::kNumbersFailed), 4);
}

// Whoever handles an Error must not take a wish for a fault.
TEST(Error, isNotWhatAnInterruptThrows) {
  EXPECT_FALSE((std::is_base_of_v<Error, Interrupted>));
  EXPECT_TRUE((std::is_base_of_v<std::exception, Interrupted>));
  EXPECT_STREQ(Interrupted().what(), "interrupted");
}

}  // namespace
}  // namespace careen
