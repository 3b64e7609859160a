#include "stage/turn.h"

#include <cmath>
#include <numbers>

#include "core/math/rotation.h"

namespace careen {

Turn turnFrom(double degrees) {
  int quarters = 0;                                           // low bits of the quotient
  const double rest = std::remquo(degrees, 90.0, &quarters);  // exact by definition
  const double x = rest * (std::numbers::pi / 180);
  // Taylor series by Horner's rule; for |x| <= π/4 the first omitted term is below 5e-17.
  double cosine = 1;
  double sine = 1;
  for (int n = 16; n > 0; n -= 2) {
    cosine = 1 - x * x / (n * (n - 1)) * cosine;
    sine = 1 - x * x / (n * (n + 1)) * sine;
  }
  sine *= x;
  switch (static_cast<unsigned>(quarters) % 4) {
    case 0:
      return {.cosine = cosine, .sine = sine};
    case 1:
      return {.cosine = -sine, .sine = cosine};
    case 2:
      return {.cosine = -cosine, .sine = -sine};
    default:
      return {.cosine = sine, .sine = -cosine};
  }
}

Mat3 rotationAbout(const Vec3& unitAxis, const Turn& turn) {
  const Mat3 along = unitAxis * unitAxis.transpose();
  return along + turn.cosine * (Mat3::Identity() - along) + turn.sine * tilde(unitAxis);
}

}  // namespace careen
