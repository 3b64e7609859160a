#include "audit/promises.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/brief.h"
#include "physics/world/method.h"

namespace careen {
namespace {

std::string pageOfTheManual() {
  std::ifstream stream(std::filesystem::path(CAREEN_SOURCE_DIR) / "assets/manual/audit.md");
  std::stringstream text;
  text << stream.rdbuf();
  return text.str();
}

// "1e-09 + 4 tolerances", "1e-07 + 100 tolerances/size", "0", "nothing"
std::string textOf(AuditKind kind, const std::optional<Promise>& promise) {
  if (!promise) {
    return "nothing";
  }
  std::string text = brief(promise->absolute);
  if (promise->tolerances > 0) {
    text.append(" + ").append(brief(promise->tolerances)).append(" tolerances");
    text.append(traitsOf(kind).unit == "1" ? "/size" : "");
  }
  if (promise->crowdTolerances > 0) {
    text.append(" + ").append(brief(promise->crowdTolerances)).append(" tolerances of crowds");
  }
  return text;
}

TEST(Promises, manualHasTheSameTable) {
  const std::string text = pageOfTheManual();
  for (const AuditKindTraits& traits : kAuditKinds) {
    std::string row = "| `" + std::string(traits.name) + "` |";
    const auto cell = [&](Method method, bool crowd) {
      row += " " + textOf(traits.kind, promisesOf(method, crowd)[indexOf(traits.kind)]) + " |";
    };
    cell(Method::kExact, false);
    cell(Method::kExact, true);
    cell(Method::kListing1, false);
    cell(Method::kStrang, false);
    EXPECT_NE(text.find(row + "\n"), std::string::npos) << row;
  }
}

TEST(Promises, everyMethodPromisesNumbers) {
  for (const MethodTraits& method : kMethods) {
    for (const bool crowd : {false, true}) {
      const Promises promises = promisesOf(method.method, crowd);
      EXPECT_TRUE(promises[indexOf(AuditKind::kNotFinite)].has_value()) << method.name;
      EXPECT_TRUE(promises[indexOf(AuditKind::kOrthogonality)].has_value()) << method.name;
      // A stepper comes to the same moment in two ways, which differ by its own error.
      const bool stepper = method.steps() && method.method != Method::kListing1;
      EXPECT_NE(promises[indexOf(AuditKind::kContinuity)].has_value(), stepper) << method.name;
    }
  }
}

TEST(Promises, depthIsThatOfTheToleranceThatCounts) {
  RunSettings settings{.tolerance = 1e-5, .crowds = {.tolerance = 2e-4}};
  EXPECT_DOUBLE_EQ(promisedDepth(settings, false).value(), 1e-9 + 4e-5);
  EXPECT_DOUBLE_EQ(promisedDepth(settings, true).value(), 1e-9 + 6e-4);
  settings.method = Method::kListing1;
  EXPECT_FALSE(promisedDepth(settings, false));
}

TEST(Promises, toleranceCountsInMetresOrPartsOfASize) {
  const RunSettings settings{.tolerance = 1e-4};
  EXPECT_DOUBLE_EQ(allowed({.tolerances = 4}, settings, 1), 4e-4);
  EXPECT_DOUBLE_EQ(allowed({.absolute = 1e-3, .tolerances = 2}, settings, 0.1), 3e-3);
  EXPECT_DOUBLE_EQ(allowed({.crowdTolerances = 3}, settings, 0.1), 9e-4);
}

}  // namespace
}  // namespace careen
