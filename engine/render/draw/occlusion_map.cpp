#include <GL/glcorearb.h>

#include "render/draw/occlusion_map.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/error.h"
#include "render/gl/gl.h"
#include "render/gl/shader.h"

namespace careen {
namespace {

constexpr int kNearWidth = 2;  // [px] of the picture that a pixel of a map is wide
constexpr int kFarWidth = 8;
static_assert(OcclusionMap::kReach == kNearWidth);  // by bilinear interpolation
constexpr double kFarReach = kNearWidth + kFarWidth;
constexpr double kFarSize = 2.2;     // [1] of half a box's diagonal: no near part farther away
constexpr double kFarPixels = 40;    // [px] at least, for the map of what is far knows nothing finer
constexpr double kBlended = 0.6;     // [1] of that distance, from where the near part fades
constexpr double kEverywhere = 1e9;  // [m]

enum Kind { kFarPart, kNearPart, kCopyPart };

// How a box counts.
struct Part {
  double from = 0;  // [m2] squares of the distances from its centre between which its near part becomes its
  double to = 0;    // far part
  double share = 1;
};

Part partOf(const DrawnBox& box, double share, const OcclusionView& view) {
  const double pixel = view.pixelAngle * (box.pose.position - view.eye).norm();
  const double to = share < 1 ? kEverywhere : std::max(kFarSize * box.halfExtents.norm(), kFarPixels * pixel);
  return {.from = kBlended * kBlended * to * to, .to = to * to, .share = share};
}

void appendDecal(Decals& decals, const std::vector<Vec3>& outline, const DrawnBox& box,
                 const Surface& surface, const Vec3& eye, const Part& part) {
  const Mat3 bodyFromWorld = box.pose.worldFromBody.transpose();
  const Vec3 normal = bodyFromWorld * surface.normal;
  for (const Vec3& corner : outline) {
    append(decals.vertices, corner - eye);
    append(decals.vertices, bodyFromWorld * (corner - box.pose.position));
    append(decals.vertices, normal);
    append(decals.vertices, box.halfExtents);
    append(decals.vertices, box.returned);
    decals.vertices.push_back(static_cast<float>(part.from));
    decals.vertices.push_back(static_cast<float>(part.to));
    decals.vertices.push_back(static_cast<float>(part.share));
  }
  decals.addFan(outline.size());
}

// [1] Of each box what it counts beside other copies of its body: where n are in the same place, 1 / n each.
std::vector<double> sharesOf(std::span<const DrawnBox> boxes) {
  std::vector<double> shares(boxes.size(), 1);
  if (!haveCopies(boxes)) {
    return shares;
  }
  std::vector<std::vector<std::size_t>> copies;  // of each body
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    copies.resize(std::max(copies.size(), boxes[i].shown + 1));
    copies[boxes[i].shown].push_back(i);
  }
  for (const std::vector<std::size_t>& each : copies) {
    for (const std::size_t a : each) {
      double same = 0;  // itself included
      for (const std::size_t b : each) {
        const double apart = (boxes[a].pose.position - boxes[b].pose.position).norm();
        same += a == b ? 1 : std::max(0.0, 1 - apart / (2 * boxes[a].halfExtents.norm()));
      }
      shares[a] = 1 / same;
    }
  }
  return shares;
}

}  // namespace

OcclusionMap::Target::Target(const Gl& gl, int ofWidth, int ofHeight) : width(ofWidth), height(ofHeight) {
  gl.GenTextures(1, &texture);
  gl.BindTexture(GL_TEXTURE_2D, texture);
  // 16 bits: 8 would lose what many boxes far away cover, each less than half a step.
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA16, width, height, 0, GL_RGBA, GL_UNSIGNED_SHORT, nullptr);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  gl.GenFramebuffers(1, &framebuffer);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
  GLuint depth = 0;
  gl.GenRenderbuffers(1, &depth);
  gl.BindRenderbuffer(GL_RENDERBUFFER, depth);
  gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, 0, GL_DEPTH_COMPONENT32F, width, height);
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
  checkGl(gl, "the map of occlusion");
  if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw MachineError("GL makes no map of occlusion (" + gl.description + ")");
  }
}

OcclusionMap::OcclusionMap(const Gl& gl, const std::filesystem::path& shaders, int width, int height)
    : gl_(gl),
      near_(gl, (width + kNearWidth - 1) / kNearWidth, (height + kNearWidth - 1) / kNearWidth),
      far_(gl, (width + kFarWidth - 1) / kFarWidth, (height + kFarWidth - 1) / kFarWidth),
      array_(makeVertexArray(gl)),
      vertices_(gl, {{0, 3}, {1, 3}, {2, 3}, {3, 3}, {4, 3}, {5, 3}}, VertexBuffer::Step::kVertex),
      indices_(gl),
      nearProgram_(linkProgram(gl, shaders, {"occlusion.vert", "occlusion.frag", "occlusion_of_box.frag"})),
      copiesProgram_(
          linkProgram(gl, shaders, {"occlusion.vert", "occlusion.frag", "occlusion_of_copy.frag"})),
      farProgram_(linkProgram(gl, shaders, {"occlusion.vert", "far_occlusion.frag"})),
      copyArray_(makeVertexArray(gl)),
      copyProgram_(linkProgram(gl, shaders, {"far_part.vert", "far_part.frag"})) {}

void OcclusionMap::place(std::span<const DrawnBox> boxes, std::span<const Surface> surfaces,
                         const OcclusionView& view, const HiddenTiles& hidden, PictureCells& cells,
                         CellInputs* inputs) {
  decals_ = {};
  triangles_ = {};
  const std::vector<double> shares = sharesOf(boxes);
  for (const Surface& surface : surfaces) {
    if (surface.normal.dot(view.eye - surface.outline[0]) <= 0) {
      continue;
    }
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const DrawnBox& box = boxes[i];
      if (!box.marked) {
        continue;
      }
      const std::vector<Vec3> outline = occlusionOutline(box, surface, view.least, kEverywhere);
      if (outline.empty() || hidden.hide(outline)) {
        continue;
      }
      const Part part = partOf(box, shares[i], view);
      cells.mark(outline);
      // An outline is drawn, but only in `reached` it changes anything.
      const auto append = [&](const std::vector<Vec3>& within, const std::vector<Vec3>& reached, int kind) {
        const std::size_t begun = decals_.vertices.size();
        decals_.triangles.swap(triangles_.at(static_cast<std::size_t>(kind)));
        appendDecal(decals_, within, box, surface, view.eye, part);
        decals_.triangles.swap(triangles_.at(static_cast<std::size_t>(kind)));
        if (inputs != nullptr) {
          const std::span<const float> vertices = std::span(decals_.vertices).subspan(begun);
          const std::uint64_t records = digest(vertices, static_cast<std::uint64_t>(kind));
          decals_.pieces.add(inputs->add(reached, kind == kFarPart ? kFarReach : kReach, records),
                             decals_.count);
        }
      };
      if (part.share < 1) {
        append(outline, outline, kCopyPart);
        continue;
      }
      const std::vector<Vec3> far = farOcclusionOutline(box, surface, view.least);
      if (!far.empty()) {
        append(outline, far, kFarPart);
      }
      const std::vector<Vec3> near = occlusionOutline(box, surface, view.least, std::sqrt(part.to));
      if (!near.empty()) {
        append(near, near, kNearPart);
      }
    }
  }
}

void OcclusionMap::fill(const CellInputs* inputs, const PictureCells::Set& cells) {
  std::vector<std::uint32_t> all;
  for (const auto& [kind, end] :
       {std::pair(kFarPart, &farEnd_), std::pair(kNearPart, &nearEnd_), std::pair(kCopyPart, &copiesEnd_)}) {
    const std::vector<std::uint32_t>& of = triangles_.at(static_cast<std::size_t>(kind));
    const std::vector<std::uint32_t> triangles =
        inputs != nullptr ? decals_.pieces.trianglesIn(of, *inputs, cells) : of;
    all.insert(all.end(), triangles.begin(), triangles.end());
    *end = all.size();
  }
  gl_.BindVertexArray(array_);
  vertices_.fill(decals_.vertices);
  indices_.fill(all);
}

void OcclusionMap::begin(const Target& target) const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
  gl_.Viewport(0, 0, target.width, target.height);
  gl_.Clear(GL_DEPTH_BUFFER_BIT);
}

void OcclusionMap::drawDecals(unsigned program, std::size_t from, std::size_t to) const {
  gl_.Enable(GL_BLEND);
  gl_.BlendFuncSeparate(GL_ZERO, GL_SRC_COLOR, GL_ZERO, GL_ONE);
  gl_.DepthMask(GL_FALSE);
  gl_.Disable(GL_CULL_FACE);
  gl_.UseProgram(program);
  gl_.BindVertexArray(array_);
  const std::size_t place = from * sizeof(std::uint32_t);
  const void* const first = reinterpret_cast<const void*>(place);  // NOLINT(performance-no-int-to-ptr)
  gl_.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(to - from), GL_UNSIGNED_INT, first);
  gl_.Enable(GL_CULL_FACE);
  gl_.DepthMask(GL_TRUE);
  gl_.Disable(GL_BLEND);
}

void OcclusionMap::beginFar() const { begin(far_); }

void OcclusionMap::drawFar() const {
  gl_.ClearColor(1, 1, 1, 1);  // what was drawn before has colours, too
  gl_.Clear(GL_COLOR_BUFFER_BIT);
  drawDecals(farProgram_, 0, farEnd_);
}

void OcclusionMap::beginNear() const { begin(near_); }

void OcclusionMap::drawNear() const {
  gl_.Disable(GL_DEPTH_TEST);
  gl_.BindTexture(GL_TEXTURE_2D, far_.texture);
  gl_.UseProgram(copyProgram_);
  gl_.BindVertexArray(copyArray_);
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  gl_.Enable(GL_DEPTH_TEST);
  drawDecals(nearProgram_, farEnd_, nearEnd_);
  if (copiesEnd_ > nearEnd_) {
    drawDecals(copiesProgram_, nearEnd_, copiesEnd_);
  }
}

void OcclusionMap::bind() const { gl_.BindTexture(GL_TEXTURE_2D, near_.texture); }

}  // namespace careen
