#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "compare/comparison.h"

namespace careen {

/// Writes the result of a comparison into the folder, which is created if missing:
/// - report.json: every number, for programs;
/// - junit.xml: a test case for each frame, or for each property of a run, for CI systems;
/// - index.html: a self-contained page with the most informative pictures.
/// Each appears whole or not at all. InputError if a picture can no longer be read, MachineError if a file
/// cannot be written or the page's parts (assets/compare) are missing.
void writeReport(const std::filesystem::path& folder, const Comparison& comparison);

/// The text of report.json; `indent` < 0: on one line. Field names are those of Comparison, `report` is the
/// version of the format. What was not measured is null; a number that is not finite is the string
/// "Infinity", "-Infinity" or "NaN": PSNR if nothing differs, a limit that allows anything.
/// assets/compare/report.schema.json describes each field with its unit.
std::string reportJson(const Comparison& comparison, int indent = 2);

/// The part of reportJson() for one frame, on one line.
std::string frameJson(const FrameComparison& frame);

/// The file of reportJunit() in a report's folder.
inline constexpr const char* kJunitName = "junit.xml";

/// JUnit XML as Jenkins, GitLab and others read it. A difference is a failure; a warning goes to system-out.
/// It has no times, because the time of a frame is not measured.
std::string reportJunit(const Comparison& comparison);
/// The same for a comparison that ended with an error: one test case, with that error.
std::string reportJunitOfError(const Comparison& comparison, const std::string& error);

/// The HTML page; reads the pictures that it shows.
std::string reportPage(const Comparison& comparison);

}  // namespace careen
