#include "physics/joint_freedom.h"

#include <Eigen/Sparse>
#include <cstddef>
#include <vector>

#include "physics/contact/contact_system.h"
#include "physics/contact/joint_rows.h"

namespace careen {
namespace {

/// [1] of a row that moves a body's corners as much as its middle: what is no more follows from others.
constexpr double kFollows = 1e-9;

class HeldRows {
 public:
  explicit HeldRows(const World& world) : columns_(world.bodies.size() + 1, kNone) {
    for (const Body& body : world.bodies) {
      bodies_.push_back({.body = &body,
                         .position = body.initial.pose.position,
                         .worldFromBody = Quat(body.initial.pose.worldFromBody)});
    }
    bodies_.push_back(touchingBody(nowhere()));
    const auto placeOf = [&](const JointEnd& end) {
      return end.body ? *end.body : static_cast<int>(world.bodies.size());
    };
    for (const ContactFeature& feature : jointFeatures(world, 0, placeOf)) {
      add(feature);
    }
  }

  JointFreedom freedom() const {
    const int columns = 6 * freedom_.bodies;
    Eigen::SparseMatrix<double> matrix(freedom_.rows, columns);
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    if (freedom_.rows < columns) {
      matrix = Eigen::SparseMatrix<double>(matrix.transpose());
    }
    matrix.makeCompressed();
    Eigen::SparseQR<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>> factors;
    factors.setPivotThreshold(kFollows);
    JointFreedom freedom = freedom_;
    if (freedom_.rows > 0 && columns > 0) {
      factors.compute(matrix);
      const int rank = static_cast<int>(factors.rank());
      freedom.redundant = freedom_.rows - rank;
      freedom.degrees = columns - rank;
    } else {
      freedom.degrees = columns;
    }
    return freedom;
  }

 private:
  static constexpr int kNone = -1;

  const TouchingBody& body(int place) const { return bodies_[static_cast<std::size_t>(place)]; }

  void add(const ContactFeature& feature) {
    for (const int place : {feature.a, feature.b}) {
      int& column = columns_[static_cast<std::size_t>(place)];
      if (column == kNone && !body(place).isHeld()) {
        column = 6 * freedom_.bodies++;
      }
    }
    if (!feature.holds()) {
      return;
    }
    const TouchingBody& a = body(feature.a);
    const TouchingBody& b = body(feature.b);
    const ContactState state =
        jointState(feature, a.kinematics(), a.shape(feature.boxA), b.kinematics(), b.shape(feature.boxB));
    for (std::size_t row = 0; row < 3; ++row) {
      if (state.rows->a.linear[row].isZero(0) && state.rows->a.turning[row].isZero(0)) {
        continue;
      }
      addSide(feature.a, state.rows->a, row);
      addSide(feature.b, state.rows->b, row);
      ++freedom_.rows;
    }
  }

  void addSide(int place, const RowSide& side, std::size_t row) {
    const int column = columns_[static_cast<std::size_t>(place)];
    if (column == kNone) {
      return;
    }
    const double radius = radiusOf(*body(place).body);
    for (int k = 0; k < 3; ++k) {
      entries_.emplace_back(freedom_.rows, column + k, side.linear[row][k]);
      entries_.emplace_back(freedom_.rows, column + 3 + k, side.turning[row][k] / radius);
    }
  }

  std::vector<TouchingBody> bodies_;  // and the world
  std::vector<int> columns_;          // by body: the first of its six, or kNone
  std::vector<Eigen::Triplet<double>> entries_;
  JointFreedom freedom_;
};

}  // namespace

JointFreedom jointFreedom(const World& world) { return HeldRows(world).freedom(); }

}  // namespace careen
