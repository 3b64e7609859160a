#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

#include "core/math/linear_algebra.h"

namespace careen {

struct Gl;

/// One attribute of a vertex shader: `floats` consecutive floats of each record, in the order of the
/// locations.
struct Attribute {
  unsigned location = 0;
  int floats = 0;
};

/// A buffer of float records, one for each vertex or each instance.
class VertexBuffer {
 public:
  enum class Step { kVertex, kInstance };

  /// Attaches the buffer to the bound vertex array.
  VertexBuffer(const Gl& gl, std::initializer_list<Attribute> attributes, Step step);
  void fill(std::span<const float> records);
  int count() const { return count_; }

 private:
  const Gl& gl_;
  unsigned buffer_ = 0;
  std::size_t floatsPerRecord_ = 0;
  int count_ = 0;
};

/// Indices of vertices, in threes.
class IndexBuffer {
 public:
  /// Attaches the buffer to the bound vertex array.
  explicit IndexBuffer(const Gl& gl);
  /// The vertex array that it is attached to must be bound.
  void fill(std::span<const std::uint32_t> indices);
  int count() const { return count_; }

 private:
  const Gl& gl_;
  unsigned buffer_ = 0;
  int count_ = 0;
};

/// Appends three floats to the records.
void append(std::vector<float>& records, const Vec3& v);

unsigned makeVertexArray(const Gl& gl);

}  // namespace careen
