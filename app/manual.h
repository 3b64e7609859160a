#pragma once

#include <array>
#include <string_view>

namespace careen {

/// The pages of the manual, assets/manual/NAME.md, in reading order; they are built into the program.
inline constexpr std::array kManualPages = {
    "tutorial",        "install",         "commands",     "scenes",       "film",       "window",
    "methods",         "audit",           "comparing",    "foreign-runs", "validation", "study",
    "machines",        "sweeps",          "export",       "truth",        "library",    "python",
    "reproducibility", "troubleshooting", "dependencies", "developing",   "changes"};

/// Markdown of a page, by its file's name; empty if there is none of that name.
std::string_view manualPage(std::string_view name);

}  // namespace careen
