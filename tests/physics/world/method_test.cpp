#include "physics/world/method.h"

#include <gtest/gtest.h>

namespace careen {
namespace {

TEST(Methods, areFoundByTheirNames) {
  for (const MethodTraits& known : kMethods) {
    EXPECT_EQ(methodNamed(known.name), known.method);
    EXPECT_EQ(traitsOf(known.method).name, known.name);
  }
  EXPECT_EQ(methodNamed("listing1"), Method::kListing1);
  EXPECT_EQ(methodNamed("listing2"), std::nullopt);
}

}  // namespace
}  // namespace careen
