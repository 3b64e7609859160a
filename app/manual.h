#pragma once

#include <array>
#include <string_view>

namespace careen {

/// The pages of the manual, assets/manual/NAME.md, in reading order: what users need comes first, what
/// developers need last. They are built into the program.
inline constexpr std::array kManualPages = {
    "tutorial",        "install",  "scenes", "film",       "commands",     "methods",
    "troubleshooting", "glossary", "joints", "control",    "questions",    "forces",
    "window",          "export",   "truth",  "sweeps",     "comparing",    "foreign-runs",
    "machines",        "web",      "audit",  "validation", "study",        "reproducibility",
    "theory",          "changes",  "python", "library",    "dependencies", "developing"};

/// Markdown of a page, by its file's name; empty if there is none of that name.
std::string_view manualPage(std::string_view name);

}  // namespace careen
