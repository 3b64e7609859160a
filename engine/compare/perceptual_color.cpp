#include "compare/perceptual_color.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace careen {
namespace {

constexpr float kPiFloat = std::numbers::pi_v<float>;

float labRoot(float t) {
  constexpr float kDelta = 6.0F / 29.0F;
  return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0F / 29.0F;
}

float square(float x) { return x * x; }

float length(float a, float b) { return std::sqrt(a * a + b * b); }

// C^7 / (C^7 + 25^7) and its root weight large chroma in the formula.
float shareOfLargeChroma(float chroma) {
  const float power = chroma * square(chroma * chroma * chroma);
  constexpr float k25To7 = 6103515625.0F;
  return std::sqrt(power / (power + k25To7));
}

float hueOf(float a, float b) {
  const float angle = a == 0 && b == 0 ? 0.0F : std::atan2(b, a);
  return angle < 0 ? angle + 2 * kPiFloat : angle;
}

constexpr float radians(float degrees) { return degrees * kPiFloat / 180; }

}  // namespace

float lightOfSrgb(float encoded) {
  return encoded <= 0.04045F ? encoded / 12.92F : std::pow((encoded + 0.055F) / 1.055F, 2.4F);
}

Lab labOfXyz(const std::array<float, 3>& xyz) {
  const float x = labRoot(xyz[0]);
  const float y = labRoot(xyz[1]);
  const float z = labRoot(xyz[2]);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

Lab labOfLight(const std::array<float, 3>& rgb) {
  // Rows of IEC 61966-2-1's matrix, each divided by its sum, so that X, Y and Z of white are 1.
  const auto [r, g, b] = rgb;
  return labOfXyz({(0.4124F * r + 0.3576F * g + 0.1805F * b) / (0.4124F + 0.3576F + 0.1805F),
                   0.2126F * r + 0.7152F * g + 0.0722F * b,
                   (0.0193F * r + 0.1192F * g + 0.9505F * b) / (0.0193F + 0.1192F + 0.9505F)});
}

// Equations (2) to (22) of the paper.
float ciede2000(const Lab& one, const Lab& other) {
  const float meanChroma = (length(one.a, one.b) + length(other.a, other.b)) / 2;
  const float stretch = 1 + 0.5F * (1 - shareOfLargeChroma(meanChroma));
  const float a1 = stretch * one.a;
  const float a2 = stretch * other.a;
  const float chroma1 = length(a1, one.b);
  const float chroma2 = length(a2, other.b);
  const float hue1 = hueOf(a1, one.b);
  const float hue2 = hueOf(a2, other.b);
  const bool grey = chroma1 * chroma2 == 0;

  float hueStep = grey ? 0 : hue2 - hue1;
  float hue = hue1 + hue2;
  if (!grey) {
    const bool across = std::abs(hueStep) > kPiFloat;
    hue = !across ? hue / 2 : hue < 2 * kPiFloat ? hue / 2 + kPiFloat : hue / 2 - kPiFloat;
    hueStep += !across ? 0 : hueStep > 0 ? -2 * kPiFloat : 2 * kPiFloat;
  }
  const float dL = other.L - one.L;
  const float dC = chroma2 - chroma1;
  const float dH = 2 * std::sqrt(chroma1 * chroma2) * std::sin(hueStep / 2);

  const float lightness = square((one.L + other.L) / 2 - 50);
  const float chroma = (chroma1 + chroma2) / 2;
  const float t = 1 - 0.17F * std::cos(hue - radians(30)) + 0.24F * std::cos(2 * hue) +
                  0.32F * std::cos(3 * hue + radians(6)) - 0.20F * std::cos(4 * hue - radians(63));
  const float weightL = 1 + 0.015F * lightness / std::sqrt(20 + lightness);
  const float weightC = 1 + 0.045F * chroma;
  const float weightH = 1 + 0.015F * chroma * t;
  const float turn = radians(30) * std::exp(-square((hue - radians(275)) / radians(25)));
  const float rotation = -2 * shareOfLargeChroma(chroma) * std::sin(2 * turn);
  const float l = dL / weightL;
  const float c = dC / weightC;
  const float h = dH / weightH;
  return std::sqrt(std::max(0.0F, l * l + c * c + h * h + rotation * c * h));
}

}  // namespace careen
