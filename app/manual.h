#pragma once

#include <array>
#include <string_view>

namespace careen {

/// The pages of the manual, assets/manual/NAME.md, in reading order: what users need comes first, what
/// developers need last. They are built into the program.
inline constexpr std::array kManualPages = {
    "tutorial",  "install",  "scenes",       "joints",       "control",         "film",
    "window",    "commands", "forces",       "questions",    "troubleshooting", "sweeps",
    "comparing", "export",   "truth",        "foreign-runs", "machines",        "web",
    "methods",   "audit",    "validation",   "study",        "reproducibility", "changes",
    "python",    "library",  "dependencies", "developing"};

/// Markdown of a page, by its file's name; empty if there is none of that name.
std::string_view manualPage(std::string_view name);

}  // namespace careen
