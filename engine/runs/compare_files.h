#pragma once

#include <filesystem>
#include <stop_token>

#include "compare/comparison.h"
#include "runs/source.h"

namespace careen {

/// Compares two pictures, two folders of frames, or two runs. A table of poses is a run; without a scene it
/// is one of the scene of the other run, and the second one is audited. InputError if they are not of one
/// kind, or a setting is for another kind.
Comparison compareFiles(const std::filesystem::path& expected, const std::filesystem::path& actual,
                        const ComparisonSettings& settings, const RunReading& tables,
                        const std::stop_token& stop = {});

/// InputError for a folder that a report of that comparison would mix with: one in what is compared, or one
/// that holds a film.
void refuseReportIn(const std::filesystem::path& report, const std::filesystem::path& expected,
                    const std::filesystem::path& actual);

}  // namespace careen
