#include "exchange/mjcf_names.h"

#include "scene/json_tree.h"
#include "scene/scene.h"

namespace careen {
namespace {

bool isOfScene(const std::string& name) {
  for (std::size_t side = 0; side < kRoomSides.size(); ++side) {
    if (name == roomWallName(side)) {
      return true;
    }
  }
  return name == "world";
}

}  // namespace

std::string MjcfNames::unique(const std::string& given, const std::string& whenEmpty) {
  std::string name = given.empty() ? whenEmpty : given;
  for (char& letter : name) {
    const auto code = static_cast<unsigned char>(letter);
    letter = letter == ',' || letter == '"' || code < 0x20 || code == 0x7f ? '_' : letter;
  }
  const std::string first = name;
  for (int number = 2; isOfScene(name) || !names_.insert(name).second; ++number) {
    name = first + "-" + std::to_string(number);
  }
  if (!given.empty() && name != given) {
    renamed_ += (renamed_.empty() ? "" : ", ") + inQuotes(given) + " is " + inQuotes(name);
  }
  return name;
}

}  // namespace careen
