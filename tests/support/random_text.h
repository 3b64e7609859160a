#pragma once

#include <random>
#include <string>

#include "core/brief.h"

namespace careen {

/// What writers of random files share.
class RandomText {
 protected:
  explicit RandomText(unsigned seed) : random_(seed) {}

  bool chance(unsigned of) { return random_() % of == 0; }
  double real(double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random_);
  }
  std::string numbers(int count, double most) {
    std::string text;
    for (int i = 0; i < count; ++i) {
      text += (i == 0 ? "" : " ") + inFull(real(-most, most));
    }
    return text;
  }
  std::string vector(double most) { return numbers(3, most); }

  std::mt19937 random_;
};

/// Changes one place of a file, as if it had been damaged.
inline void damage(std::string& text, std::mt19937& random) {
  const std::size_t at = random() % text.size();
  switch (random() % 5) {
    case 0:
      text[at] = static_cast<char>(random() % 256);
      break;
    case 1:
      text.erase(at, 1 + random() % 20);
      break;
    case 2:
      text.insert(at, text.substr(random() % text.size(), random() % 50));
      break;
    case 3:
      text[at] = static_cast<char>('0' + random() % 10);
      break;
    default:
      text.resize(at + 1);
  }
}

}  // namespace careen
