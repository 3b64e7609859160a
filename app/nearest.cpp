#include "nearest.h"

#include <algorithm>
#include <numeric>

namespace careen {
namespace {

// Letters to insert, remove or replace.
std::size_t editDistance(const std::string& from, const std::string& to) {
  std::vector<std::size_t> row(to.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < from.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < to.size(); ++j) {
      const std::size_t replaced = diagonal + (from[i] == to[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string didYouMean(const std::string& typed, const std::vector<std::string>& names) {
  constexpr std::size_t kLongest = 40;  // what is longer is no misspelt name
  if (typed.size() > kLongest) {
    return "";
  }
  std::size_t least = kLongest;
  std::string nearest;
  for (const std::string& name : names) {
    const std::size_t distance = editDistance(typed, name);
    if (distance < least && 3 * distance <= std::max(name.size(), std::size_t{3})) {
      least = distance;
      nearest = name;
    }
  }
  return nearest.empty() ? "" : "; did you mean '" + nearest + "'?";
}

}  // namespace careen
