#include "core/csv.h"

namespace careen {
namespace {

bool isFormula(std::string_view text) {
  if (text.empty()) {
    return false;
  }
  const char first = text[0];
  const bool calls = text.find_first_of("(|!") != std::string_view::npos;
  return first == '=' || first == '@' || static_cast<unsigned char>(first) < 0x20 ||
         ((first == '+' || first == '-') && calls);
}

}  // namespace

std::string csvCell(std::string_view text) {
  std::string cell = isFormula(text) ? "'" : "";
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
    return cell.append(text);
  }
  for (const char c : text) {
    cell += c == '"' ? "\"\"" : std::string(1, c);
  }
  return '"' + cell + '"';
}

}  // namespace careen
