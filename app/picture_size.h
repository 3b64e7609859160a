#pragma once

#include <string>
#include <utility>

namespace careen {

/// "1280x720": width and height [px]. InputError otherwise.
std::pair<int, int> parseSize(const std::string& text);

}  // namespace careen
