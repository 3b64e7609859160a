#include "audit/moments.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace careen {

std::vector<double> goldenMoments(double duration, std::size_t count) {
  constexpr double kGolden = 0.61803398874989484820;  // (√5 − 1)/2
  std::vector<double> moments = {0, duration};
  moments.reserve(count + 2);
  for (std::size_t i = 1; i <= count; ++i) {
    const double turns = static_cast<double>(i) * kGolden;
    moments.push_back((turns - std::floor(turns)) * duration);
  }
  std::sort(moments.begin(), moments.end());
  return moments;
}

std::vector<double> momentsOfRows(const Trajectory& run, std::size_t count) {
  std::vector<double> common;
  std::vector<double> all;
  bool isFirst = true;
  for (std::size_t body = 0; body < run.tracks.size(); ++body) {
    if (isImmovable(run.world.bodies[body].mass)) {
      continue;
    }
    std::vector<double> times;
    for (const Segment& segment : run.tracks[body].segments) {
      times.push_back(segment.start);
    }
    times.push_back(run.settings.duration);
    std::vector<double> both;
    std::set_intersection(common.begin(), common.end(), times.begin(), times.end(), std::back_inserter(both));
    common = isFirst ? times : both;
    std::vector<double> either;
    std::set_union(all.begin(), all.end(), times.begin(), times.end(), std::back_inserter(either));
    all = std::move(either);
    isFirst = false;
  }
  // 0 and the end are common to all.
  const std::vector<double>& rows = common.size() > 2 ? common : all;
  const std::size_t stride = 1 + (rows.size() - 1) / (count + 1);
  std::vector<double> moments;
  for (std::size_t k = 0; k < rows.size(); k += stride) {
    moments.push_back(rows[k]);
  }
  if (moments.back() < rows.back()) {
    moments.push_back(rows.back());
  }
  return moments;
}

}  // namespace careen
