#include <cfenv>

#include <gtest/gtest.h>

namespace {

class FloatingPointTraps : public testing::Environment {
  void SetUp() override { feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW); }
};

const testing::Environment* const kTraps = testing::AddGlobalTestEnvironment(new FloatingPointTraps);

}  // namespace
