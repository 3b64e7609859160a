#pragma once

#include <filesystem>
#include <stop_token>

#include "compare.h"
#include "core/error.h"
#include "core/system/atomic_folder.h"
#include "reference.h"

namespace careen {

/// `render --approve`: a film that is drawn beside the reference, and takes its place whole if it differs.
class Approval {
 public:
  /// InputError if this process works in the reference's folder, which would be gone.
  explicit Approval(const Reference& reference);

  /// Where the new film is drawn.
  const std::filesystem::path& folder() const { return film_.path(); }
  /// Compares the two, prints the result, and puts the new film in place of the reference unless they are the
  /// same. What else is in the reference's folder stays there.
  ExitCode approve(CompareOptions options, bool logsFrames, const std::stop_token& stop);

 private:
  void takeAlong() const;

  Reference reference_;
  std::filesystem::path place_;
  AtomicFolder film_;
};

}  // namespace careen
