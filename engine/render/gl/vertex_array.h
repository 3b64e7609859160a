#pragma once

#include <cstddef>
#include <initializer_list>
#include <span>
#include <vector>

#include "core/math/linear_algebra.h"

namespace careen {

struct Gl;

/// One attribute of a vertex shader: so many floats of each record, in the order of the shader's locations.
struct Attribute {
  unsigned location = 0;
  int floats = 0;
};

/// A buffer of records of floats, one record for each vertex or for each instance.
class VertexBuffer {
 public:
  enum class Step { kVertex, kInstance };

  /// Becomes part of the vertex array that is bound.
  VertexBuffer(const Gl& gl, std::initializer_list<Attribute> attributes, Step step);
  void fill(std::span<const float> records);
  int count() const { return count_; }

 private:
  const Gl& gl_;
  unsigned buffer_ = 0;
  std::size_t floatsPerRecord_ = 0;
  int count_ = 0;
};

/// Adds three floats to a record.
void append(std::vector<float>& records, const Vec3& v);

unsigned makeVertexArray(const Gl& gl);

}  // namespace careen
