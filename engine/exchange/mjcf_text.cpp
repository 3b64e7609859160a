#include "exchange/mjcf_text.h"

#include "core/brief.h"

namespace careen {
namespace {

std::string escaped(const std::string& text) {
  std::string result;
  for (const char letter : text) {
    switch (letter) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += letter;
    }
  }
  return result;
}

}  // namespace

std::string mjcfNumbers(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) {
    text += (text.empty() ? "" : " ") + inFull(value);
  }
  return text;
}
std::string mjcfNumbers(const Vec3& v) { return mjcfNumbers({v.x(), v.y(), v.z()}); }
std::string mjcfNumbers(const Quat& q) { return mjcfNumbers({q.w(), q.x(), q.y(), q.z()}); }

std::string mjcfAttribute(const char* name, const std::string& value) {
  return std::string(" ") + name + "=\"" + escaped(value) + "\"";
}

}  // namespace careen
