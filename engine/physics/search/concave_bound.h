#pragma once

#include <array>
#include <cstddef>

namespace careen {

/// First δ > 0 with height + rate·δ − ½ fall·δ² = 0, for height > 0; `none` if there is no such δ. Each
/// branch adds terms of one sign only.
double firstRoot(double height, double rate, double fall, double none);

/// F(δ) = level + rate·δ − ½ curvature·δ² − Σ weightₖ |qₖ + rateₖ·δ|, curvature ≥ 0: a concave lower bound of
/// a gap, in force for `reach` from now. Lengths, speeds and accelerations of any one unit of length.
class ConcaveBound {
 public:
  ConcaveBound(double level, double rate, double curvature)
      : level_(level), rate_(rate), curvature_(curvature) {}

  /// Where an edge with half length `weight` turns over.
  void addKink(double weight, double value, double rate) {
    kinks_[count_] = {.weight = weight, .value = value, .rate = rate};
    ++count_;
  }

  /// Kinks from here on are summed apart from those before: the same bits when two boxes change places.
  void beginSecondBox() { first_ = count_; }

  double value() const;
  /// F'(0+); kinks that are less than `tie` from turning over count as lying on the worse side.
  double rateAhead(double tie) const;
  double curvature() const { return curvature_; }
  /// First δ in (0, most] where F(δ) = floor, given F(0) > floor; `most` if F stays above.
  ///
  /// Each vertex alone gives a parabola above F. Its root is an upper bound; the vertex lowest there gives a
  /// smaller one, until the lowest vertex at the root is the one whose root it is. Ends after at most all
  /// vertices, nearly always after one or two.
  double firstReach(double floor, double most) const;

 private:
  struct Kink {
    double weight = 0;
    double value = 0;
    double rate = 0;
  };
  static constexpr std::size_t kMostKinks = 6;

  /// Σ term(kink), the two boxes apart.
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
