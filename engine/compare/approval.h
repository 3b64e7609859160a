#pragma once

#include <filesystem>
#include <stop_token>

#include "compare/reference.h"
#include "core/system/atomic_folder.h"

namespace careen {

/// A film that is drawn beside the reference, and takes its place whole if it differs.
class Approval {
 public:
  /// InputError if this process works in the reference's folder, which would be gone.
  explicit Approval(const Reference& reference);

  /// Where the new film is drawn.
  const std::filesystem::path& folder() const { return film_.path(); }
  /// Where it will be.
  const std::filesystem::path& place() const { return place_; }
  /// Compares the two, and puts the new film in place of the reference if they differ. What else is in the
  /// reference's folder stays there.
  Comparison approve(ComparisonSettings settings, const ComparisonTold& tell,
                     const std::stop_token& stop = {});

 private:
  void takeAlong() const;

  Reference reference_;
  std::filesystem::path place_;
  AtomicFolder film_;
};

}  // namespace careen
