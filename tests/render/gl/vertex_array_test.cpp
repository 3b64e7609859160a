#include <GL/glcorearb.h>

#include "render/gl/vertex_array.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "render/gl/gl.h"
#include "render/gl/rendering_backend.h"

namespace careen {
namespace {

TEST(VertexArray, recordsTakeThreeFloatsAVector) {
  std::vector<float> records = {9};
  append(records, Vec3(1, 2.5, -3));
  EXPECT_EQ(records, (std::vector<float>{9, 1, 2.5F, -3}));
}

// Records of 3 + 4 floats.
TEST(VertexArray, countsWholeRecords) {
  const std::unique_ptr<GlContext> context = openContext({});
  const Gl gl(*context);
  const unsigned first = makeVertexArray(gl);
  EXPECT_EQ(gl.integer(GL_VERTEX_ARRAY_BINDING), static_cast<int>(first));
  VertexBuffer buffer(gl, {{0, 3}, {1, 4}}, VertexBuffer::Step::kInstance);
  EXPECT_EQ(buffer.count(), 0);
  buffer.fill(std::vector<float>(21));
  EXPECT_EQ(buffer.count(), 3);
  buffer.fill({});
  EXPECT_EQ(buffer.count(), 0);
  EXPECT_NE(makeVertexArray(gl), first);
  EXPECT_NO_THROW(checkGl(gl, "filling"));
}

}  // namespace
}  // namespace careen
