#include <GL/glcorearb.h>

#include "render/overlay/batch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "render/gl/gl.h"
#include "render/gl/shader.h"
#include "render/gl/texture_units.h"

namespace careen {
namespace {

// Values as in overlay.frag.
enum class Kind { kStroke, kPlate, kGlyph, kRibbon };

constexpr double kSoft = 1;             // [px] beyond an edge that are still partly covered, for antialiasing
constexpr double kSharpestBend = 0.2;   // cosine; at sharper bends a ribbon is split
constexpr double kShortestPiece = 0.5;  // [px] of a ribbon's segments
constexpr int kHighestAtlas = 2048;     // [px]

using Values = std::array<double, 4>;

class Triangles {
 public:
  explicit Triangles(std::vector<float>& floats) : floats_(floats) {}

  void begin(Kind kind, const Values& where, const Values& shape) {
    where_ = where;
    shape_ = shape;
    shape_[3] = static_cast<double>(kind);
  }
  /// Corners are in order around the quad. For ribbons: position across, and half width there.
  struct Corner {
    Vec2 at;
    Ink ink;
    double across = 0;
    double halfWidth = 0;
  };
  void addQuad(const std::array<Corner, 4>& corners) {
    for (const std::size_t index : {0, 1, 2, 0, 2, 3}) {
      const Corner& corner = corners.at(index);
      append({corner.at.x(), corner.at.y(), corner.ink.color.red / 255.0, corner.ink.color.green / 255.0,
              corner.ink.color.blue / 255.0, corner.ink.alpha});
      append(where_);
      append(shape_);
      append({corner.across, corner.halfWidth});
    }
  }
  void addRectangle(const Vec2& min, const Vec2& max, const Ink& ink) {
    addQuad({{{min, ink}, {Vec2(max.x(), min.y()), ink}, {max, ink}, {Vec2(min.x(), max.y()), ink}}});
  }

 private:
  template <class List>
  void append(const List& values) {
    for (const double value : values) {
      floats_.push_back(static_cast<float>(value));
    }
  }
  void append(std::initializer_list<double> values) { append<std::initializer_list<double>>(values); }

  std::vector<float>& floats_;
  Values where_{};
  Values shape_{};
};

Vec2 leftOf(const Vec2& direction) { return {-direction.y(), direction.x()}; }

Vec2 directionOf(const Vec2& from, const Vec2& to) {
  const Vec2 line = to - from;
  const double length = line.norm();
  return length > 0 ? Vec2(line / length) : Vec2::UnitX();
}

void add(Triangles& triangles, const Stroke& stroke) {
  const Vec2 along = directionOf(stroke.from, stroke.to);
  const Vec2 aside = leftOf(along);
  const double reach = 0.5 * std::max(stroke.width, stroke.head) + stroke.halo + kSoft;
  const Vec2 start = stroke.from - reach * along;
  const Vec2 end = stroke.to + reach * along;
  triangles.begin(Kind::kStroke, {stroke.from.x(), stroke.from.y(), stroke.to.x(), stroke.to.y()},
                  {0.5 * stroke.width, stroke.head, stroke.halo, 0});
  triangles.addQuad({{{start - reach * aside, stroke.ink},
                      {end - reach * aside, stroke.ink},
                      {end + reach * aside, stroke.ink},
                      {start + reach * aside, stroke.ink}}});
}

void add(Triangles& triangles, const Plate& plate) {
  const double rounding = std::min(plate.rounding, 0.5 * (plate.max - plate.min).minCoeff());
  triangles.begin(Kind::kPlate, {plate.min.x(), plate.min.y(), plate.max.x(), plate.max.y()},
                  {rounding, plate.hatching, 0, 0});
  triangles.addRectangle(plate.min - Vec2::Constant(kSoft), plate.max + Vec2::Constant(kSoft), plate.ink);
}

void add(Triangles& triangles, const AtlasGlyph& glyph, const Ink& ink) {
  triangles.begin(
      Kind::kGlyph,
      {static_cast<double>(glyph.column - glyph.x), static_cast<double>(glyph.row - glyph.y), 0, 0}, {});
  const Vec2 min(glyph.x, glyph.y);
  triangles.addRectangle(min, min + Vec2(glyph.width, glyph.height), ink);
}

// Drops points too close to the previous one to define a direction, but keeps the last point.
std::vector<RibbonPoint> spread(const std::vector<RibbonPoint>& points) {
  std::vector<RibbonPoint> result;
  for (const RibbonPoint& point : points) {
    if (result.empty() || (point.at - result.back().at).norm() >= kShortestPiece) {
      result.push_back(point);
    }
  }
  if (result.size() > 1) {
    result.back() = points.back();
  }
  return result;
}

// Segments share edges along the bisectors of the bends, so that no pixel is covered twice.
void add(Triangles& triangles, const Ribbon& ribbon) {
  triangles.begin(Kind::kRibbon, {}, {});
  const std::vector<RibbonPoint> points = spread(ribbon.points);
  const auto directionFrom = [&](std::size_t i) { return directionOf(points[i].at, points[i + 1].at); };
  // Half width at a joint, including the soft edge, along the line where the segments meet.
  const auto edgeAt = [&](std::size_t joint, std::size_t piece) -> Vec2 {
    Vec2 own = leftOf(directionFrom(piece));
    const bool isFirst = joint == piece;
    if (isFirst ? joint == 0 : joint + 1 == points.size()) {
      return own;
    }
    const Vec2 other = leftOf(directionFrom(isFirst ? piece - 1 : piece + 1));
    if (own.dot(other) < kSharpestBend) {
      return own;
    }
    return 2 * (own + other) / (own + other).squaredNorm();
  };
  const auto cornerAt = [&](std::size_t joint, std::size_t piece, double side) {
    const double strength = std::clamp(points[joint].strength, 0.0, 1.0);
    const double half = 0.5 * ribbon.width * (0.4 + 0.6 * strength);
    const double across = side * (half + kSoft);
    return Triangles::Corner{.at = points[joint].at + across * edgeAt(joint, piece),
                             .ink = {ribbon.ink.color, ribbon.ink.alpha * strength * points[joint].alpha},
                             .across = across,
                             .halfWidth = half};
  };
  for (std::size_t piece = 0; piece + 1 < points.size(); ++piece) {
    triangles.addQuad({{cornerAt(piece, piece, -1), cornerAt(piece + 1, piece, -1),
                        cornerAt(piece + 1, piece, 1), cornerAt(piece, piece, 1)}});
  }
}

}  // namespace

std::vector<float> overlayVertices(const OverlayShapes& shapes, GlyphAtlas& atlas) {
  std::vector<float> floats;
  Triangles triangles(floats);
  for (const OverlayShape& shape : shapes) {
    if (const Label* const label = std::get_if<Label>(&shape)) {
      for (const AtlasGlyph& glyph : atlas.glyphsOf(*label)) {
        add(triangles, glyph, label->ink);
      }
    } else if (const Stroke* const stroke = std::get_if<Stroke>(&shape)) {
      add(triangles, *stroke);
    } else if (const Plate* const plate = std::get_if<Plate>(&shape)) {
      add(triangles, *plate);
    } else {
      add(triangles, std::get<Ribbon>(shape));
    }
  }
  return floats;
}

OverlayBatch::OverlayBatch(const Gl& gl, const std::filesystem::path& shaders, int width, int height)
    : gl_(gl),
      width_(width),
      height_(height),
      array_(makeVertexArray(gl)),
      vertices_(gl, {{0, 2}, {1, 4}, {2, 4}, {3, 4}, {4, 2}}, VertexBuffer::Step::kVertex),
      program_(linkProgram(gl, shaders, {"overlay.vert", "overlay.frag"})) {
  gl.UseProgram(program_);
  gl.Uniform1i(gl.GetUniformLocation(program_, "atlas"), kGlyphUnit);
  gl.Uniform2f(gl.GetUniformLocation(program_, "pictureSize"), static_cast<float>(width),
               static_cast<float>(height));
  gl.ActiveTexture(GL_TEXTURE0 + kGlyphUnit);
  gl.GenTextures(1, &texture_);
  gl.BindTexture(GL_TEXTURE_2D, texture_);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  gl.ActiveTexture(GL_TEXTURE0);

  gl.GenFramebuffers(1, &layer_);
  gl.BindFramebuffer(GL_FRAMEBUFFER, layer_);
  GLuint buffer = 0;
  gl.GenRenderbuffers(1, &buffer);
  gl.BindRenderbuffer(GL_RENDERBUFFER, buffer);
  gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, 0, GL_RGBA8, width, height);
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffer);
  rgba_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
  checkGl(gl, "preparing overlays");
}

void OverlayBatch::sendAtlas() {
  gl_.ActiveTexture(GL_TEXTURE0 + kGlyphUnit);
  gl_.BindTexture(GL_TEXTURE_2D, texture_);  // another batch may have bound its own
  gl_.ActiveTexture(GL_TEXTURE0);
  if (atlas_.revision() == sentRevision_ || atlas_.coverage().empty()) {
    return;
  }
  sentRevision_ = atlas_.revision();
  gl_.ActiveTexture(GL_TEXTURE0 + kGlyphUnit);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_R8, GlyphAtlas::kWidth, atlas_.height(), 0, GL_RED, GL_UNSIGNED_BYTE,
                 atlas_.coverage().data());
  gl_.ActiveTexture(GL_TEXTURE0);
}

void OverlayBatch::drawLayer(const OverlayShapes& shapes) {
  atlas_.keepBelow(kHighestAtlas);
  vertices_.fill(overlayVertices(shapes, atlas_));
  sendAtlas();
  gl_.BindFramebuffer(GL_FRAMEBUFFER, layer_);
  gl_.Viewport(0, 0, width_, height_);
  gl_.ClearColor(0, 0, 0, 0);
  gl_.Clear(GL_COLOR_BUFFER_BIT);
  gl_.UseProgram(program_);
  gl_.BindVertexArray(array_);
  // Inks are blended in sRGB, so that they look as chosen.
  gl_.Disable(GL_FRAMEBUFFER_SRGB);
  gl_.Disable(GL_CULL_FACE);
  gl_.Enable(GL_BLEND);
  gl_.BlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  gl_.DrawArrays(GL_TRIANGLES, 0, vertices_.count());
  gl_.Disable(GL_BLEND);
  gl_.Enable(GL_CULL_FACE);
  gl_.Enable(GL_FRAMEBUFFER_SRGB);
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl_.ReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, rgba_.data());
  checkGl(gl_, "drawing overlays");
}

void OverlayBatch::drawOver(Picture& picture, const OverlayShapes& shapes) {
  drawLayer(shapes);
  const auto columns = static_cast<std::size_t>(width_);
  const auto rows = static_cast<std::size_t>(height_);
  for (std::size_t row = 0; row < rows; ++row) {
    const std::uint8_t* from = &rgba_[(rows - 1 - row) * columns * 4];
    std::uint8_t* to = &picture.rgb[row * picture.rowBytes()];
    for (std::size_t column = 0; column < columns; ++column, from += 4, to += 3) {
      if (from[3] == 0) {
        continue;
      }
      unsigned whole = 255;  // of colour times alpha
      unsigned left = 255U - from[3];
      if (!picture.alpha.empty()) {
        std::uint8_t& alpha = picture.alpha[row * columns + column];
        left = (left * alpha + 127U) / 255U;
        whole = from[3] + left;
        alpha = static_cast<std::uint8_t>(whole);
      }
      for (std::size_t channel = 0; channel < 3; ++channel) {
        const unsigned mixed = (255U * from[channel] + left * to[channel] + whole / 2) / whole;
        to[channel] = static_cast<std::uint8_t>(std::min(mixed, 255U));
      }
    }
  }
}

}  // namespace careen
