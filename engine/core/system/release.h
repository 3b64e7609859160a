#pragma once

#include <string>
#include <string_view>

namespace careen {

/// The Debian packages that draw without a display, for messages: OSMesa's, or EGL's from release 14 on, as
/// Mesa has no OSMesa any more. `osRelease`: the text of /etc/os-release; without a number in VERSION_ID it
/// counts as the newest.
std::string_view drawingPackages(std::string_view osRelease);
/// Those of this machine.
std::string_view drawingPackages();

/// "glibc 2.36": whose functions the program uses.
std::string cLibrary();

}  // namespace careen
