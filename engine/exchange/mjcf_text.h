#pragma once

#include <initializer_list>
#include <string>

#include "core/math/linear_algebra.h"

namespace careen {

/// Numbers as MJCF has them: all digits, blanks between them.
std::string mjcfNumbers(std::initializer_list<double> values);
std::string mjcfNumbers(const Vec3& v);
std::string mjcfNumbers(const Quat& q);  ///< w first

/// ` name="value"`, the value escaped.
std::string mjcfAttribute(const char* name, const std::string& value);

}  // namespace careen
