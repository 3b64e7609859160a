#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "compare/comparison.h"

namespace careen {

/// What was found, for whoever has to know: writes into the folder, which is made if it is not there,
/// - report.json: every number, for programs;
/// - junit.xml: a test case for each frame, or for each property of a run, for CI systems;
/// - index.html: a page that needs nothing beside it, no network either, with the pictures that tell most.
/// Each appears whole or not at all. InputError if a picture can no longer be read, MachineError if a file
/// cannot be written or the page's parts (assets/compare) are not there.
void writeReport(const std::filesystem::path& folder, const Comparison& comparison);

/// The text of report.json; `indent` < 0: on one line. Names of fields are those of Comparison, `report` is
/// the format's version. What was not measured is null; a number that is not finite is the string "Infinity",
/// "-Infinity" or "NaN": PSNR where nothing differs, a limit that allows anything. assets/compare/
/// report.schema.json tells each field with its unit.
std::string reportJson(const Comparison& comparison, int indent = 2);

/// What reportJson() has of one frame, on one line.
std::string frameJson(const FrameComparison& frame);

/// JUnit's XML as Jenkins, GitLab and others read it. A difference is a failure, a warning is written to
/// system-out. No times: how long a frame took is not measured.
std::string reportJunit(const Comparison& comparison);

/// The page; reads the pictures it shows.
std::string reportPage(const Comparison& comparison);

}  // namespace careen
