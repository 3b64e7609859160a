#include "scene/mesh_mass.h"

#include <gtest/gtest.h>

#include <string>

#include "scene/plan.h"
#include "scene/scene_reader.h"
#include "support/input_error.h"
#include "support/meshes.h"
#include "support/process.h"

namespace careen {
namespace {

class MeshMass : public testing::Test {
 protected:
  // A scene of one box with these members.
  void writeScene(const std::string& members) const {
    folder_.write("scene.json", R"({ "careen": 1, "duration": 1, "boxes": [
      { "half_extents": [0.3, 0.2, 0.1], )" +
                                    members + " } ] }");
  }
  Scene read() const { return readScene(folder_ / "scene.json"); }
  // Without the path of the folder.
  std::string message() const {
    std::string text = inputErrorOf([this] { read(); });
    const std::string folder = folder_.path().string() + "/";
    for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder)) {
      text.erase(at, folder.size());
    }
    return text;
  }
  std::string messageOf(const TriangleMesh& mesh) const {
    folder_.write("part.obj", asObj(mesh));
    writeScene(R"("density": 2, "mass_from": "part.obj")");
    return message();
  }

  TemporaryFolder folder_;
};

TEST_F(MeshMass, ofASolidBoxIsThatOfTheBox) {
  const Vec3 half(0.3, 0.2, 0.1);
  folder_.write("part.obj", asObj(boxMesh(half, Vec3::Zero())));
  writeScene(R"("density": 2, "mass_from": "part.obj")");
  const Scene scene = read();
  const MassProperties expected = solidBox(half, 2 * 8 * half.prod());
  EXPECT_NEAR(scene.boxes[0].mass, expected.mass, 1e-16);
  const World world = assemble(scene, plan(scene));
  EXPECT_LT((world.bodies[0].mass.inertiaBody - expected.inertiaBody).norm(), 1e-17);
  EXPECT_NEAR(world.bodies[0].mass.mass, expected.mass, 1e-16);
}

// The shell of a box 0.6 × 0.4 × 0.2 m with walls of 2 cm: larger moments for its mass.
TEST_F(MeshMass, ofAHollowBoxIsTheDifference) {
  const Vec3 outer(0.3, 0.2, 0.1);
  const Vec3 inner(0.28, 0.18, 0.08);
  TriangleMesh shell = boxMesh(outer, Vec3::Zero());
  append(shell, insideOut(boxMesh(inner, Vec3::Zero())));
  EXPECT_EQ(messageOf(shell), "no error");
  const MassProperties solid = solidBox(outer, 2 * 8 * outer.prod());
  const MassProperties hole = solidBox(inner, 2 * 8 * inner.prod());
  const Scene scene = read();
  EXPECT_NEAR(scene.boxes[0].mass, solid.mass - hole.mass, 1e-16);
  EXPECT_LT((scene.boxes[0].inertia->diagonal() - (solid.inertiaBody - hole.inertiaBody)).norm(), 1e-17);
}

// A box of 3 × 2 × 1 dm turned by atan 3/4 about z, off the middle.
TEST_F(MeshMass, hasACentreAndAxesOfItsOwn) {
  const Vec3 half(0.15, 0.1, 0.05);
  const Vec3 middle(0.05, -0.01, 0.04);
  Mat3 turn;
  turn << 0.8, -0.6, 0, 0.6, 0.8, 0, 0, 0, 1;
  TriangleMesh turned = boxMesh(half, Vec3::Zero());
  for (Vec3& point : turned.points) {
    point = middle + turn * point;
  }
  EXPECT_EQ(messageOf(turned), "no error");
  const MassProperties expected = solidBox(half, 2 * 8 * half.prod());
  const Scene scene = read();
  const World world = assemble(scene, plan(scene));
  const Body& body = world.bodies[0];
  EXPECT_LT((body.boxCenter + middle).norm(), 1e-16);
  EXPECT_LT((body.initial.pose.position - middle).norm(), 1e-16);
  EXPECT_NEAR(body.mass.mass, expected.mass, 1e-17);
  EXPECT_LT(
      (body.mass.inertiaTensor() - turn * Mat3(expected.inertiaBody.asDiagonal()) * turn.transpose()).norm(),
      1e-17);
}

// An L, extruded along z, against its two bars by Steiner's theorem.
TEST_F(MeshMass, ofAnLIsThatOfItsBars) {
  TriangleMesh mesh;
  for (const double z : {-0.1, 0.1}) {
    for (const auto& [x, y] :
         {std::pair(-0.3, -0.2), {0.3, -0.2}, {0.3, -0.1}, {-0.2, -0.1}, {-0.2, 0.2}, {-0.3, 0.2}}) {
      mesh.points.emplace_back(x, y, z);
    }
  }
  for (const auto& [i, j, k] : {std::array<std::size_t, 3>{3, 4, 5}, {3, 5, 0}, {3, 0, 1}, {3, 1, 2}}) {
    mesh.triangles.push_back({6 + i, 6 + j, 6 + k});
    mesh.triangles.push_back({k, j, i});
  }
  for (std::size_t k = 0; k < 6; ++k) {
    const std::size_t next = (k + 1) % 6;
    mesh.triangles.push_back({k, next, 6 + next});
    mesh.triangles.push_back({k, 6 + next, 6 + k});
  }
  const Vec3 long_(0.3, 0.05, 0.1);
  const Vec3 short_(0.05, 0.15, 0.1);
  const Vec3 atLong(0, -0.15, 0);
  const Vec3 atShort(-0.25, 0.05, 0);
  EXPECT_EQ(messageOf(mesh), "no error");
  const MassProperties a = solidBox(long_, 2 * 8 * long_.prod());
  const MassProperties b = solidBox(short_, 2 * 8 * short_.prod());
  const Vec3 center = (a.mass * atLong + b.mass * atShort) / (a.mass + b.mass);
  Mat3 inertia = Mat3::Zero();
  for (const auto& [part, at] : {std::pair(a, atLong), std::pair(b, atShort)}) {
    const Vec3 arm = at - center;
    inertia += Mat3(part.inertiaBody.asDiagonal()) +
               part.mass * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
  }
  const Scene scene = read();
  EXPECT_LT((scene.boxes[0].center - center).norm(), 1e-16);
  EXPECT_LT((*scene.boxes[0].inertia - inertia).norm(), 1e-17);
}

TEST_F(MeshMass, isRefusedWhereTheBoxCannotHaveIt) {
  EXPECT_NE(
      messageOf(boxMesh(Vec3(0.3, 0.2, 0.11), Vec3::Zero()))
          .find("part.obj: found a vertex at (-0.3, -0.2, -0.11) m, outside the box of half extents (0.3, "
                "0.2, 0.1) m, expected a mesh in metres within its box"),
      std::string::npos);
}

TEST_F(MeshMass, aDrawnMeshChangesThePictureAlone) {
  folder_.write("part.obj", asObj(boxMesh(Vec3(0.3, 0.2, 0.05), Vec3(0, 0, 0.05))));
  writeScene(R"("mass": 2, "draw": "part.obj")");
  const Scene scene = read();
  const Stage stage = stageOf(scene);
  ASSERT_EQ(stage.parts.size(), 1U);
  EXPECT_EQ(stage.parts[0].body, 0U);
  EXPECT_EQ(stage.parts[0].mesh.triangles.size(), 12U);
  EXPECT_EQ(assemble(scene, plan(scene)).bodies[0].mass, solidBox(Vec3(0.3, 0.2, 0.1), 2));
  folder_.write("part.obj", asObj(boxMesh(Vec3(0.3, 0.2, 0.2), Vec3::Zero())));
  EXPECT_NE(message().find("draw of box \"box-0\": part.obj: found a vertex at"), std::string::npos);
  TriangleMesh open = boxMesh(Vec3(0.3, 0.2, 0.1), Vec3::Zero());
  open.triangles.pop_back();
  folder_.write("part.obj", asObj(open));
  EXPECT_NE(message().find("expected a closed mesh"), std::string::npos);
  writeScene(R"("mass": 2, "draw": "")");
  EXPECT_NE(message().find("the name of a mesh, .obj"), std::string::npos);
}

TEST_F(MeshMass, isRefusedWithTheEdgeThatIsOpen) {
  TriangleMesh open = boxMesh(Vec3(0.3, 0.2, 0.1), Vec3::Zero());
  open.triangles.pop_back();
  EXPECT_EQ(messageOf(open),
            "scene.json:2:69: mass_from of box \"box-0\": part.obj: found the edge from (0.3, -0.2, -0.1) to "
            "(0.3, -0.2, 0.1) of one face alone, expected a closed mesh");
}

TEST_F(MeshMass, standsWithADensityAndNothingElse) {
  folder_.write("part.obj", asObj(boxMesh(Vec3(0.3, 0.2, 0.1), Vec3::Zero())));
  const std::string start = "scene.json:2:";
  writeScene(R"("mass_from": "part.obj", "mass": 1)");
  EXPECT_EQ(message(),
            start +
                "55: found mass_from for box \"box-0\" beside mass, expected one of them: the mesh "
                "gives mass, centre and inertia");
  writeScene(R"("mass_from": "part.obj", "density": 1, "inertia": [1, 1, 1])");
  EXPECT_NE(message().find("beside inertia"), std::string::npos);
  writeScene(R"("mass_from": "part.obj", "density": 1, "fixed": true)");
  EXPECT_EQ(
      message(),
      start +
          "55: found mass_from for box \"box-0\", which is fixed, expected none, as it stays where it is");
  writeScene(R"("mass_from": "", "density": 1)");
  EXPECT_NE(message().find("the name of a mesh, .obj"), std::string::npos);
  writeScene(R"("mass_from": "none.obj", "density": 1)");
  EXPECT_EQ(message(),
            start + "55: mass_from of box \"box-0\": none.obj: found no such file, expected a mesh, .obj");
  writeScene(R"("mass_from": ".", "density": 1)");
  EXPECT_NE(message().find("found no such file"), std::string::npos);
  writeScene(R"("mass_from": "scene.json", "density": 1)");
  EXPECT_NE(message().find("scene.json: found no faces, expected a closed mesh"), std::string::npos);
}

}  // namespace
}  // namespace careen
