#pragma once

#include <array>

namespace careen {

/// CIE 1976 L*a*b*, white point D65.
struct Lab {
  float L = 0;
  float a = 0;
  float b = 0;
};

/// Linear light [0 … 1] of an sRGB value [0 … 1]: IEC 61966-2-1.
float lightOfSrgb(float encoded);

/// From X, Y and Z relative to white.
Lab labOfXyz(const std::array<float, 3>& xyz);

/// From linear light of the sRGB primaries [0 … 1]. White is that of the matrix, so that grey has no chroma.
Lab labOfLight(const std::array<float, 3>& rgb);

/// The CIEDE2000 difference of two colours, k_L = k_C = k_H = 1: G. Sharma, W. Wu, E. N. Dalal, "The
/// CIEDE2000 color-difference formula: implementation notes, supplementary test data, and mathematical
/// observations", Color Research and Application 30 (2005). About 1 is just visible side by side, 2.3 is
/// noticeable.
float ciede2000(const Lab& one, const Lab& other);

}  // namespace careen
