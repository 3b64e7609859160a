#pragma once

#include <filesystem>
#include <span>

#include "render/gl/edge_blend.h"

namespace careen {

struct Gl;

/// What is behind everything, by its height in the picture.
class Background {
 public:
  Background(const Gl& gl, const std::filesystem::path& shaders);
  /// In these parts of the picture, where nothing is drawn yet.
  void draw(std::span<const PixelRectangle> parts) const;
  /// Black in its place.
  void drawBlack(std::span<const PixelRectangle> parts);

 private:
  void drawBy(unsigned program, std::span<const PixelRectangle> parts) const;

  const Gl& gl_;
  std::filesystem::path shaders_;
  unsigned array_;
  unsigned program_;
  unsigned blackProgram_ = 0;  // made when first used
};

}  // namespace careen
