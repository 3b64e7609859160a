#include <GL/glcorearb.h>

#include "render/gl/vertex_array.h"

#include <cstdint>

#include "render/gl/gl.h"

namespace careen {

VertexBuffer::VertexBuffer(const Gl& gl, std::initializer_list<Attribute> attributes, Step step) : gl_(gl) {
  for (const Attribute& attribute : attributes) {
    floatsPerRecord_ += static_cast<std::size_t>(attribute.floats);
  }
  gl.GenBuffers(1, &buffer_);
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer_);
  const std::size_t stride = floatsPerRecord_ * sizeof(float);
  std::uintptr_t place = 0;
  for (const Attribute& attribute : attributes) {
    // GL takes the offset into the buffer as a pointer.
    const void* const offset = reinterpret_cast<const void*>(place);  // NOLINT(performance-no-int-to-ptr)
    gl.EnableVertexAttribArray(attribute.location);
    gl.VertexAttribPointer(attribute.location, attribute.floats, GL_FLOAT, GL_FALSE,
                           static_cast<GLsizei>(stride), offset);
    gl.VertexAttribDivisor(attribute.location, step == Step::kInstance ? 1 : 0);
    place += static_cast<std::uintptr_t>(attribute.floats) * sizeof(float);
  }
}

void VertexBuffer::fill(std::span<const float> records) {
  gl_.BindBuffer(GL_ARRAY_BUFFER, buffer_);
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(records.size_bytes()), records.data(),
                 GL_STREAM_DRAW);
  count_ = static_cast<int>(records.size() / floatsPerRecord_);
}

IndexBuffer::IndexBuffer(const Gl& gl) : gl_(gl) {
  gl.GenBuffers(1, &buffer_);
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer_);
}

void IndexBuffer::fill(std::span<const std::uint32_t> indices) {
  gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer_);
  gl_.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size_bytes()), indices.data(),
                 GL_STREAM_DRAW);
  count_ = static_cast<int>(indices.size());
}

void append(std::vector<float>& records, const Vec3& v) {
  for (const double value : v) {
    records.push_back(static_cast<float>(value));
  }
}

unsigned makeVertexArray(const Gl& gl) {
  GLuint array = 0;
  gl.GenVertexArrays(1, &array);
  gl.BindVertexArray(array);
  return array;
}

}  // namespace careen
