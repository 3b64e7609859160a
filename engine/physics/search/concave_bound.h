#pragma once

#include <array>
#include <cstddef>

namespace careen {

/// First δ > 0 with height + rate·δ − ½ fall·δ² = 0, for height > 0; `none` if there is no such δ. Each
/// branch adds terms of equal sign only (no cancellation).
double firstRoot(double height, double rate, double fall, double none);

/// F(δ) = level + rate·δ − ½ curvature·δ² − Σ weightₖ |qₖ + rateₖ·δ|, curvature ≥ 0: a concave lower bound of
/// a gap, valid for `reach` from now. Lengths, speeds and accelerations share any one unit of length.
class ConcaveBound {
 public:
  ConcaveBound(double level, double rate, double curvature)
      : level_(level), rate_(rate), curvature_(curvature) {}

  /// Kink where the lowest vertex changes along an edge of half length `weight`.
  void addKink(double weight, double value, double rate) {
    kinks_[count_] = {.weight = weight, .value = value, .rate = rate};
    ++count_;
  }

  /// Kinks added from here on are summed separately: swapping the two boxes gives the same bits.
  void beginSecondBox() { first_ = count_; }

  double value() const;
  /// F'(0+); kinks whose term is within `tie` of zero count with the sign that makes the rate lower.
  double rateAhead(double tie) const;
  double curvature() const { return curvature_; }
  /// First δ in (0, most] where F(δ) = floor, given F(0) > floor; `most` if F stays above.
  ///
  /// Each vertex alone gives a parabola above F, whose root is an upper bound; the vertex lowest there gives
  /// a smaller one, until the lowest vertex at the root is the one whose root it is. Ends after at most all
  /// vertices, nearly always after one or two.
  double firstReach(double floor, double most) const;

 private:
  struct Kink {
    double weight = 0;
    double value = 0;
    double rate = 0;
  };
  static constexpr std::size_t kMostKinks = 6;

  /// Σ term(kink), summed separately for the two boxes.
  template <class Term>
  double sum(const Term& term) const {
    double first = 0;
    double second = 0;
    std::size_t k = 0;
    for (; k < count_ && k < first_; ++k) {
      first += term(kinks_[k]);
    }
    for (; k < count_; ++k) {
      second += term(kinks_[k]);
    }
    return first + second;
  }

  /// Root of the parabola of the vertex that is lowest at `at`.
  double vertexRoot(double floor, double at, double most) const;

  double level_;
  double rate_;
  double curvature_;
  std::array<Kink, kMostKinks> kinks_;
  std::size_t count_ = 0;
  std::size_t first_ = kMostKinks;
};

}  // namespace careen
