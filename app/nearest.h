#pragma once

#include <string>
#include <vector>

namespace careen {

/// "; did you mean 'render'?" with the one of `names` that is nearest to what was typed, by at most a third
/// of its letters (edit distance, V. Levenshtein 1965); else empty.
std::string didYouMean(const std::string& typed, const std::vector<std::string>& names);

}  // namespace careen
