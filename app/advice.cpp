#include "advice.h"

#include <algorithm>
#include <array>

#include "core/system/release.h"

namespace careen {
namespace {

// The first that fits. Signs are parts of messages of the engine; tests/app/first_hour_test.cpp meets each.
constexpr std::array kAdvice = {
    Advice{"cannot be read: No such file",
           "look at the name and the folder; 'careen help scenes' has a scene to start from"},
    Advice{"is not there, expected a picture",
           "look at the names and the folder; 'careen help comparing' makes two films to compare"},
    Advice{"Permission denied", "choose a place you may write to or read from: -o FOLDER, or -o FILE"},
    Advice{"no rendering backend is available", "install one: apt install "},
    Advice{"no display", "make a film in place of a window: careen render"},
    Advice{"inside box ", "move one of them, or let --allow-overlap do it"},
    Advice{"behind wall ",
           "move it, or let --allow-overlap do it; a box's position is its middle, in metres"},
    Advice{"is a folder, expected a file", "name a file in it, such as FOLDER/scene.json"},
    Advice{"cannot be written: No such file", "make that folder first, or choose another place"},
    Advice{"cannot be made a folder", "choose another place: -o FOLDER"},
    Advice{"is no PNG", "give two pictures, two folders of frames, or two runs that 'careen simulate' wrote"},
    Advice{"found no run", "make one: careen simulate scene.json -o run.careen"},
};

// "fall.json:3:5: …" is a fault within a file.
bool namesALine(const std::string& message) {
  constexpr std::string_view kName = ".json:";
  const std::size_t at = message.find(kName);
  return at != std::string::npos && at + kName.size() < message.size() && message[at + kName.size()] >= '1' &&
         message[at + kName.size()] <= '9';
}

}  // namespace

std::span<const Advice> allAdvice() { return kAdvice; }

std::string adviceOn(const std::string& message) {
  const auto* const found = std::find_if(kAdvice.begin(), kAdvice.end(), [&](const Advice& advice) {
    return message.find(advice.sign) != std::string::npos;
  });
  if (found != kAdvice.end()) {
    const bool installs = found->next.ends_with("apt install ");
    return "next: " + std::string(found->next) + (installs ? std::string(drawingPackages()) : "");
  }
  return namesALine(message) ? "next: 'careen help scenes' explains scenes (in m, kg, s) "
                               "and says where all keys are listed"
                             : "";
}

}  // namespace careen
