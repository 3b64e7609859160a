#pragma once

#include <set>
#include <string>

namespace careen {

/// Names that a scene can have, of boxes and walls or of joints: no two alike, none of a room's walls, not
/// "world", and fit for tables.
class MjcfNames {
 public:
  /// The name given, or one like it; if it is empty, the other.
  std::string unique(const std::string& given, const std::string& whenEmpty);
  /// "\"a\" is \"a-2\", …"
  const std::string& renamed() const { return renamed_; }

 private:
  std::set<std::string> names_;
  std::string renamed_;
};

}  // namespace careen
