#include "core/names.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace careen {
namespace {

constexpr std::array<std::string_view, 3> kNames = {"exact", "listing1", "exactly"};

TEST(Names, areListedWithCommas) {
  EXPECT_EQ(listed(kNames), "exact, listing1, exactly");
  EXPECT_EQ(listed(std::span(kNames).first(1)), "exact");
  EXPECT_EQ(listed({}), "");
}

TEST(Names, haveTheirPlaces) {
  for (std::size_t place = 0; place < kNames.size(); ++place) {
    EXPECT_EQ(indexAmong(kNames.at(place), kNames), place);
  }
}

TEST(Names, thatAreUnknownAreToldWithThoseThereAre) {
  for (const char* name : {"", "exac", "Exact", "exactly "}) {
    try {
      indexAmong(name, kNames);
      ADD_FAILURE() << name;
    } catch (const InputError& error) {
      EXPECT_EQ(error.what(), "found '" + std::string(name) + "', expected one of: exact, listing1, exactly");
    }
  }
}

struct Named {
  std::string name;
};

// By hand. Capitals come before small letters, and of two that are called alike the first comes first.
TEST(OrderByName, isThatOfTheLettersThenThatOfTheList) {
  const std::vector<Named> named = {{"b"}, {"a"}, {"B"}, {"a"}, {""}};
  EXPECT_EQ(orderByName(named), (std::vector<std::size_t>{4, 2, 1, 3, 0}));
}

}  // namespace
}  // namespace careen
