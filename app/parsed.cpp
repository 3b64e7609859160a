#include "parsed.h"

#include <charconv>

namespace careen {

double numberIn(const char* option, const std::string& text, const std::string& expected, double least,
                double most) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || !(number >= least && number <= most)) {
    throw InputError(std::string(option) + ": found '" + text + "', expected " + expected);
  }
  return number;
}

}  // namespace careen
