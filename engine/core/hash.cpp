#include "core/hash.h"

namespace careen {

std::string Hash::text() const {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text(16, '0');
  std::uint64_t rest = value_;
  for (auto digit = text.rbegin(); digit != text.rend(); ++digit, rest >>= 4U) {
    *digit = kDigits[rest & 0xfU];
  }
  return text;
}

}  // namespace careen
