#include "stage/picture_settings.h"

#include <cstddef>

#include "core/names.h"

namespace careen {

std::string nameOf(Look look) { return std::string(kLooks.at(static_cast<std::size_t>(look))); }
std::string nameOf(Antialiasing antialiasing) {
  return std::string(kAntialiasings.at(static_cast<std::size_t>(antialiasing)));
}

Look lookNamed(std::string_view name) { return static_cast<Look>(indexAmong(name, kLooks)); }
Antialiasing antialiasingNamed(std::string_view name) {
  return static_cast<Antialiasing>(indexAmong(name, kAntialiasings));
}

}  // namespace careen
