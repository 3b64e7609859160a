#include "scene/obj_file.h"

#include <gtest/gtest.h>

#include <string>

#include "support/input_error.h"
#include "support/meshes.h"

namespace careen {
namespace {

TEST(ObjFile, holdsVerticesAndFaces) {
  const TriangleMesh mesh = parseObj(asObj(tetrahedron()), "a.obj");
  EXPECT_EQ(mesh.points, tetrahedron().points);
  EXPECT_EQ(mesh.triangles, tetrahedron().triangles);
}

// A square with textures and normals, vertices counted from the end, comments and lines of other kinds.
TEST(ObjFile, mayHoldMuchElse) {
  const TriangleMesh mesh = parseObj(
      "# a square\r\nmtllib a.mtl\no square\nv 0 0 0 1 1 1\nv\t1 0 0 # red\nv 1 1 0\r\nv 0 1 0\nvn 0 0 1\nvt "
      "0 0\n"
      "s off\n\nf 1/1/1 2//1 -2/1 -1",
      "a.obj");
  ASSERT_EQ(mesh.points.size(), 4U);
  using Triangles = std::vector<std::array<std::size_t, 3>>;
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
}

// Programs that give each face its own vertices still write a closed mesh.
TEST(ObjFile, joinsVerticesAtTheSamePlace) {
  const TriangleMesh mesh = parseObj(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv -0 0 0\nv 1.0 0e5 -0\nv 0 0 1\nf 1 2 3\nf 5 4 6\nf 1 4 2", "a.obj");
  EXPECT_EQ(mesh.points.size(), 4U);
  using Triangles = std::vector<std::array<std::size_t, 3>>;
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {1, 0, 3}}));  // the third has no area
}

TEST(ObjFile, saysWhichLineIsWrong) {
  const auto errorOf = [](const std::string& text) { return inputErrorOf([&] { parseObj(text, "a.obj"); }); };
  EXPECT_EQ(errorOf("v 0 0 0\nv 1 x 0\n"), "a.obj:2: found \"x\", expected a coordinate [m]");
  EXPECT_EQ(errorOf("v 0 nan 0\n"), "a.obj:1: found \"nan\", expected a coordinate [m]");
  EXPECT_EQ(errorOf("v 0 0 1e61\n"), "a.obj:1: found \"1e61\", expected a coordinate [m]");
  EXPECT_EQ(errorOf("v 0 0\n"), "a.obj:1: found \"0\", expected v and three coordinates [m]");
  EXPECT_EQ(errorOf("v"), "a.obj:1: found \"v\", expected v and three coordinates [m]");
  EXPECT_EQ(errorOf("v 0 0 0\nf 1 1"), "a.obj:2: found \"1\", expected f and at least three vertices");
  for (const char* const index : {"0", "2", "-2", "1x", "9999999999999999999", "/1"}) {
    EXPECT_EQ(
        errorOf("v 0 0 0\nf 1 1 " + std::string(index)),
        "a.obj:2: found \"" + std::string(index) + "\", expected one of the 1 vertices before this line");
  }
}

}  // namespace
}  // namespace careen
