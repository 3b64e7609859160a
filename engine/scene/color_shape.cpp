#include "scene/color_shape.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

namespace careen {
namespace {

std::optional<Color> colorOfDigits(std::string_view text) {
  std::array<std::uint8_t, 3> channels{};
  bool good = text.size() == 7;
  for (std::size_t i = 0; good && i < channels.size(); ++i) {
    const char* const digits = text.data() + 1 + 2 * i;
    good = std::from_chars(digits, digits + 2, channels[i], 16).ptr == digits + 2;
  }
  return good ? std::optional(Color{.red = channels[0], .green = channels[1], .blue = channels[2]})
              : std::nullopt;
}

}  // namespace

Color readColor(const JsonValue& value) {
  const std::string expected = "a colour \"#rrggbb\" or its name";
  const std::string& text = value.string(expected);
  if (text.starts_with('#')) {
    const std::optional<Color> color = colorOfDigits(text);
    return color ? *color : (value.fail("a colour \"#rrggbb\""), Color());
  }
  std::vector<std::string_view> names;
  std::transform(kNamedColors.begin(), kNamedColors.end(), std::back_inserter(names),
                 [](const NamedColor& each) { return each.name; });
  return kNamedColors.at(value.word(names, "colour")).color;
}

ColorPair readColorPair(const JsonValue& value) {
  if (!value.is(JsonNode::Kind::kArray)) {
    const Color color = readColor(value);
    return {.above = color, .below = color};
  }
  const std::vector<JsonValue> both = value.elements("a colour or [above, below]", 2);
  return {.above = readColor(both[0]), .below = readColor(both[1])};
}

}  // namespace careen
