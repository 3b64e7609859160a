#include "exchange/gltf_buffer.h"

#include <gtest/gtest.h>

#include "support/glb.h"

namespace careen {
namespace {

TEST(GltfBuffer, packsWhatTheSpecificationAsksFor) {
  GltfBuffer buffer;
  EXPECT_EQ(buffer.addIndices({1, 2, 3}), 0U);  // six bytes: the next view is aligned
  EXPECT_EQ(buffer.addFloats(GltfBuffer::Kind::kVec3, {1, 5, -3, 4, 2, 0}, true, 34962), 1U);
  EXPECT_EQ(buffer.addFloats(GltfBuffer::Kind::kScalar, {0, 0.5F}, false), 2U);
  const Glb glb(buffer.pack({{"asset", {{"version", "2.0"}}}}));
  EXPECT_EQ(glb.json.at("asset").at("version"), "2.0");
  EXPECT_EQ(glb.json.at("buffers").at(0).at("byteLength"), glb.binary.size());
  EXPECT_EQ(glb.json.at("bufferViews").at(1).at("byteOffset"), 8);
  EXPECT_EQ(glb.json.at("bufferViews").at(1).at("target"), 34962);
  EXPECT_FALSE(glb.json.at("bufferViews").at(2).contains("target"));
  EXPECT_EQ(glb.json.at("accessors").at(1).at("min"), nlohmann::json({1, 2, -3}));
  EXPECT_EQ(glb.json.at("accessors").at(1).at("max"), nlohmann::json({4, 5, 0}));
  EXPECT_FALSE(glb.json.at("accessors").at(2).contains("min"));
  EXPECT_EQ(glb.floats(1), (std::vector<float>{1, 5, -3, 4, 2, 0}));
  EXPECT_EQ(glb.floats(2), (std::vector<float>{0, 0.5F}));
}

TEST(GltfBuffer, quaternionsEndWithTheirScalar) {
  std::vector<float> numbers;
  appendFloats(numbers, Vec3(1, 2, 3));
  appendFloats(numbers, Quat(0.5, -0.5, 0.25, 0.125));
  EXPECT_EQ(numbers, (std::vector<float>{1, 2, 3, -0.5F, 0.25F, 0.125F, 0.5F}));
}

TEST(GltfBuffer, keepsAFileWholeWhoseNamesAreNoText) {
  GltfBuffer buffer;
  buffer.addFloats(GltfBuffer::Kind::kScalar, {0}, true);
  const Glb glb(buffer.pack({{"name", "\xFF\"\n"}}));
  EXPECT_EQ(glb.json.at("name"), "\xEF\xBF\xBD\"\n");
}

}  // namespace
}  // namespace careen
