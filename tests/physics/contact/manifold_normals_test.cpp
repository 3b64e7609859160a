#include "physics/contact/manifold_normals.h"

#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <array>
#include <vector>

#include "support/article_equations.h"

namespace careen {
namespace {

const Vec3 kHalf(0.1, 0.1, 0.1);

/// Two cubes, face on face but for a tilt of 2e-7, the upper a turned by .4, that spin fast and differently
/// about the normal: corners of either on the other's face, and crossings of edges.
struct FaceOnFace {
  Kinematics a;
  Kinematics b;
  std::vector<ContactFeature> features;

  explicit FaceOnFace(double tilt) {
    b = {.pose = {.position = Vec3::Zero(), .worldFromBody = Mat3::Identity()},
         .velocity = Vec3::Zero(),
         .angularVelocity = Vec3(5, -3, -40)};
    const Mat3 turned = axisAngle(Vec3(0.6, 0.8, 0), tilt) * axisAngle(Vec3(0, 0, 1), 0.4);
    a = {.pose = {.position = Vec3(0.07, 0.05, 0.2), .worldFromBody = turned},
         .velocity = Vec3(0.3, 0.2, 0),
         .angularVelocity = Vec3(5, -3, 35)};
    features = {{.kind = ContactFeature::Kind::kPointOnFace,
                 .a = 0,
                 .b = 1,
                 .onA = Vec3(-0.1, -0.1, -0.1),
                 .axisB = 2},
                {.kind = ContactFeature::Kind::kPointOnFace,
                 .a = 1,
                 .b = 0,
                 .onA = Vec3(0.1, 0.1, 0.1),
                 .axisB = 2,
                 .sign = -1},
                edges(0, -0.1, 1, 0.1),
                edges(1, -0.1, 0, 0.1)};
  }
  static ContactFeature edges(int axisA, double sideA, int axisB, double sideB) {
    ContactFeature feature{.kind = ContactFeature::Kind::kEdgeOnEdge,
                           .a = 0,
                           .b = 1,
                           .onA = Vec3(0, 0, -0.1),
                           .onB = Vec3(0, 0, 0.1),
                           .axisA = axisA,
                           .axisB = axisB,
                           .sign = axisA == 0 ? 1.0 : -1.0};
    feature.onA[1 - axisA] = sideA;
    feature.onB[1 - axisB] = sideB;
    return feature;
  }
  std::vector<ContactState> states() const {
    std::vector<ContactState> states;
    for (const ContactFeature& feature : features) {
      const bool isSwapped = feature.a == 1;
      states.push_back(contactState(feature, isSwapped ? b : a, {kHalf}, isSwapped ? a : b, {kHalf}));
    }
    return states;
  }
  // [m/s²] How far the four conditions d̈ = 0 contradict each other: by the combination of their rows, d̈ by
  // the bodies' accelerations, that vanishes.
  double contradiction(const std::vector<ContactState>& states) const {
    Eigen::Matrix<double, 4, 12> rows;
    Eigen::Vector4d bias;
    for (std::size_t c = 0; c < 4; ++c) {
      const ContactState& at = states[c];
      const bool isSwapped = features[c].a == 1;
      const auto k = static_cast<Eigen::Index>(c);
      rows.block<1, 3>(k, isSwapped ? 6 : 0) = at.normal.transpose();
      rows.block<1, 3>(k, isSwapped ? 9 : 3) = at.armA.cross(at.normal).transpose();
      rows.block<1, 3>(k, isSwapped ? 0 : 6) = -at.normal.transpose();
      rows.block<1, 3>(k, isSwapped ? 3 : 9) = -at.armB.cross(at.normal).transpose();
      bias[k] = at.gapBias;
    }
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rows, Eigen::ComputeFullU);
    return std::fabs(svd.matrixU().col(3).dot(bias));
  }
};

// Four conditions for three degrees of freedom, which agree exactly only with one normal: with two they do to
// the tilt times the accelerations, here of 200 m/s², and need forces that are these over the tilt.
TEST(ManifoldNormals, makeTheConditionsOfAFaceAgree) {
  const FaceOnFace scene(2e-7);
  std::vector<ContactState> states = scene.states();
  const double before = scene.contradiction(states);
  ManifoldNormals().align(scene.features, {}, states);
  EXPECT_GT(before, 1e-7);
  EXPECT_LT(scene.contradiction(states), 1e-12);  // measured 1.6e-14, of 2e-5 before
  for (std::size_t c = 0; c < states.size(); ++c) {
    const double sign = scene.features[c].a == 1 ? -1 : 1;
    EXPECT_EQ(sign * states[c].normal, states[0].normal) << c;
    EXPECT_NEAR(dot(states[c].slip, states[c].normal), 0, 1e-14) << c;
  }
}

TEST(ManifoldNormals, areThoseOfWhatPushes) {
  const FaceOnFace scene(2e-7);
  const std::vector<ContactState> before = scene.states();
  std::vector<ContactState> states = before;
  const std::vector<char> pushing{1, 0, 1, 0};
  ManifoldNormals().align(scene.features, pushing, states);
  EXPECT_EQ(states[1].normal, before[1].normal);
  EXPECT_EQ(states[3].normal, before[3].normal);
  EXPECT_EQ(states[2].normal, states[0].normal);
  EXPECT_LT((states[0].normal - (before[0].normal + before[2].normal).normalized()).norm(), 1e-15);
}

// Another face of the same boxes, or one that really leans, is another manifold.
TEST(ManifoldNormals, leaveWhatLeansAsItIs) {
  const FaceOnFace scene(1e-3);
  const std::vector<ContactState> before = scene.states();
  std::vector<ContactState> states = before;
  ManifoldNormals().align(scene.features, {}, states);
  for (std::size_t c = 0; c < states.size(); ++c) {
    EXPECT_EQ(states[c].normal, before[c].normal);
    EXPECT_EQ(states[c].gapBias, before[c].gapBias);
  }
}

}  // namespace
}  // namespace careen
