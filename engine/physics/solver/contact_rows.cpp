#include "physics/solver/contact_rows.h"

namespace careen {

RowSide pointSide(const std::array<Vec3, 3>& axes, const Vec3& arm, double sign) {
  RowSide side;
  for (std::size_t row = 0; row < 3; ++row) {
    side.linear[row] = sign * axes[row];
    side.turning[row] = sign * arm.cross(axes[row]);
  }
  return side;
}

BodyImpulse impulseOf(const RowSide& side, const ContactProblem::Triple& impulse) {
  BodyImpulse sum;
  for (std::size_t row = 0; row < 3; ++row) {
    sum.push += impulse[row] * side.linear[row];
    sum.twist += impulse[row] * side.turning[row];
  }
  return sum;
}

void setSide(ContactProblem::Contact& contact, std::size_t side, const RowSide& rows,
             const Mat3& worldFromPrincipal) {
  for (std::size_t row = 0; row < 3; ++row) {
    const Vec3 turning = worldFromPrincipal.transpose() * rows.turning[row];
    double* values = &contact.rows[row][side * ContactProblem::kAxes];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      values[k] = rows.linear[row][axis];
      values[3 + k] = turning[axis];
    }
  }
}

}  // namespace careen
