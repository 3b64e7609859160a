#pragma once

#include <filesystem>
#include <stop_token>

#include "compare/comparison.h"

namespace careen {

/// Compares two folders of frames as compareFolders() does. Where both hold films of this program, what their
/// manifests say of motion, scene, renderer and settings explains what differs. InputError as there.
Comparison compareFilms(const std::filesystem::path& expected, const std::filesystem::path& actual,
                        const ComparisonSettings& settings, const std::stop_token& stop = {});

}  // namespace careen
