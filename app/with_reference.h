#pragma once

#include <stop_token>
#include <string>

#include "compare.h"
#include "compare/approval.h"
#include "compare/reference.h"
#include "picture_options.h"

namespace careen {

/// Takes what the command line left open from the reference instead of the scene: size, rate, look,
/// antialiasing, shutter, overlays, and which frames. If frames are given, they are compared with those of
/// the same numbers.
void takeFromReference(const Reference& reference, PictureOptions& picture, std::string& frames,
                       CompareOptions& compare);

/// Compares the film just made with the reference, and tells what was found and what is kept.
ExitCode compareAndTell(const Reference& reference, const std::filesystem::path& film,
                        const CompareOptions& options, bool logsFrames, const std::stop_token& stop);
/// Puts it in place of the reference if they differ, and tells so.
ExitCode approveAndTell(Approval& approval, const CompareOptions& options, bool logsFrames,
                        const std::stop_token& stop);

}  // namespace careen
