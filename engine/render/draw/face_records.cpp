#include "render/draw/face_records.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <map>
#include <numbers>
#include <utility>

namespace careen {
namespace {

constexpr double kFrame = 0.7;
// Occlusion changes most beside an edge that another box touches.
constexpr std::array<double, 4> kFineLines = {-1, -0.6, 0.6, 1};
constexpr std::size_t kFewBoxes = 50;  // more have no grid, for its price

constexpr std::size_t kTexelsPerBox = 5;
constexpr std::size_t kFarCount = 64;                     // in a length: near ones + kFarCount * far ones
constexpr std::size_t kFaceRecord = 27;                   // numbers of a vertex, see box.vert
constexpr std::size_t kListPlace = 22;                    // which of them tells where its list is
constexpr std::array<int, 6> kPips = {1, 6, 2, 5, 3, 4};  // by side; opposite faces add up to seven

// Does something with the points of a face's grid: calls with the point and its place on the face, −1 … 1.
// Neighbouring faces have the very same points on the edge between them, so that there are no cracks.
template <class Do>
void forGrid(const DrawnBox& box, const DrawnFace& face, FaceGrid grid, const Do& doWith) {
  const int axis = face.side / 2;
  const auto doAt = [&](double u, double v) {
    Vec3 place;
    place[axis] = face.side % 2 == 0 ? 1 : -1;
    place[(axis + 1) % 3] = u;
    place[(axis + 2) % 3] = v;
    doWith(box.pose.worldPoint(box.halfExtents.cwiseProduct(place)), u, v);
  };
  if (grid == FaceGrid::kFine) {
    for (const double v : kFineLines) {
      for (const double u : kFineLines) {
        doAt(u, v);
      }
    }
    return;
  }
  for (const double size : {1.0, kFrame}) {
    if (size == 1 || grid == FaceGrid::kFramed) {
      for (const auto& [u, v] : {std::pair(-1, -1), std::pair(1, -1), std::pair(-1, 1), std::pair(1, 1)}) {
        doAt(u * size, v * size);
      }
    }
  }
}

// Where the eye is above the plane of a face [m], across and along; and the part of the way there by which
// the opposite face, seen in that plane, lies from this one.
Vec3 eyeFoot(const DrawnBox& box, int axis, const Vec3& eye) {
  const Vec3 from = box.pose.worldFromBody.transpose() * (eye - box.pose.position);
  return {from[(axis + 1) % 3], from[(axis + 2) % 3],
          2 * box.halfExtents[axis] / (std::abs(from[axis]) + box.halfExtents[axis])};
}

// An outline of a face and of all places that box_shrunk.vert may move it to.
std::vector<Vec3> shrinkingOutline(const DrawnFace& face, const Vec3& eye, double angle) {
  const std::array<Vec3, 4> at = outlineOf(face);
  std::vector<Vec3> outline(at.begin(), at.end());
  if (angle > 0) {  // all edges of a prism
    const auto moved = [&](std::size_t i) {
      return Vec3(at.at(i) - angle * (at.at(i) - eye).norm() * face.normal);
    };
    for (std::size_t i = 0; i < at.size(); ++i) {
      const std::size_t next = (i + 1) % at.size();
      outline.insert(outline.end(), {at.at(i), moved(i), moved(next), at.at(next)});
    }
  }
  return outline;
}

}  // namespace

void VertexRecords::addFace(FaceGrid grid, bool mirrored) {
  const auto addQuad = [&](std::vector<std::uint32_t>& to, const std::array<std::uint32_t, 4>& corners) {
    const std::uint32_t first = count + corners[mirrored ? 3 : 1];
    const std::uint32_t last = count + corners[mirrored ? 1 : 3];
    const std::uint32_t from = count + corners[0];
    const std::uint32_t across = count + corners[2];
    to.insert(to.end(), {from, first, across, from, across, last});
  };
  if (grid == FaceGrid::kFine) {
    constexpr auto kWidth = static_cast<std::uint32_t>(kFineLines.size());
    for (std::uint32_t v = 0; v + 1 < kWidth; ++v) {
      for (std::uint32_t at = v * kWidth; at + 1 < (v + 1) * kWidth; ++at) {
        addQuad(triangles, {at, at + 1, at + kWidth + 1, at + kWidth});
        addQuad(outlines, {at, at + 1, at + kWidth + 1, at + kWidth});
      }
    }
    count += kWidth * kWidth;
    return;
  }
  addQuad(outlines, {0, 1, 3, 2});
  if (grid == FaceGrid::kAtCorners) {
    addQuad(triangles, {0, 1, 3, 2});
    count += 4;
    return;
  }
  for (const std::array<std::uint32_t, 4>& corners : std::initializer_list<std::array<std::uint32_t, 4>>{
           {4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}}) {
    addQuad(triangles, corners);
  }
  count += 8;
}

void VertexRecords::addTriangle() {
  for (int corner = 0; corner < 3; ++corner) {
    triangles.push_back(count);
    outlines.push_back(count);
    ++count;
  }
}

void VertexRecords::endLayer() {
  triangleEnds.push_back(triangles.size());
  outlineEnds.push_back(outlines.size());
}

FaceRecords::FaceRecords(const PlacedBoxes& placed)
    : in_(placed),
      isFine_(placed.boxes.size()),
      isShaded_(placed.faces.size()),
      pieces_(placed.faces.size()),
      zonogons_(placed.boxes.size()) {
  if (in_.boxes.size() <= kFewBoxes) {
    findFine();
  }
  for (const ShadowPair& pair : in_.shadows.pairs) {
    isShaded_[pair.face] = true;
  }
}

void FaceRecords::add() {
  std::vector<ShadowPair> pairs = in_.shadows.pairs;
  std::stable_sort(pairs.begin(), pairs.end(), [&](const ShadowPair& a, const ShadowPair& b) {
    return momentOf(a.face) > momentOf(b.face);
  });
  auto pair = pairs.begin();
  for (std::size_t i = 0; i < in_.faces.size();) {
    const std::size_t moment = momentOf(i);
    for (; i < in_.faces.size() && momentOf(i) == moment; ++i) {
      if (!isMesh(i)) {
        addFace(i);
      } else if (i == 0 || in_.faces[i - 1].box != in_.faces[i].box) {
        addMesh(i);
      }
    }
    for (; pair != pairs.end() && momentOf(pair->face) == moment; ++pair) {
      if (!isMesh(pair->face)) {
        addShadow(*pair);
      }
    }
    for (VertexRecords* const records : {&lit, &dark, &shaded, &cast}) {
      records->endLayer();
    }
  }
}

// All faces of a box have the same points on their edges.
void FaceRecords::findFine() {
  for (std::size_t i = 0; i < in_.faces.size(); ++i) {
    if (hasList(i)) {
      isFine_[in_.faces[i].box] = true;
    }
  }
}

FaceGrid FaceRecords::gridOf(std::size_t face) const {
  return isFine_[in_.faces[face].box] ? FaceGrid::kFine
         : hasList(face)              ? FaceGrid::kFramed
                                      : FaceGrid::kAtCorners;
}

bool FaceRecords::hasList(std::size_t face) const {
  return in_.neighbors != nullptr && in_.neighbors->lists[face].near + in_.neighbors->lists[face].far > 0;
}

void FaceRecords::appendAbout(std::vector<float>& vertices, double pips, std::size_t face,
                              bool withList) const {
  vertices.push_back(static_cast<float>(pips));
  vertices.push_back(static_cast<float>(in_.faces[face].width));
  const FaceNeighbors::List list = withList ? in_.neighbors->lists[face] : FaceNeighbors::List();
  vertices.push_back(0);  // see placeList
  vertices.push_back(static_cast<float>(list.near + kFarCount * list.far));
}

// Of what a list says, wherever it is and whichever places its boxes have.
std::uint64_t FaceRecords::listDigest(std::size_t face) const {
  const FaceNeighbors::List& list = in_.neighbors->lists[face];
  const std::size_t lists = 4 * kTexelsPerBox * in_.boxes.size();
  std::uint64_t all = digest(in_.texels.subspan(lists + 4 * (list.begin + list.near), 4 * list.far));
  for (const FaceNeighbors::Entry& entry : in_.neighbors->near(face)) {
    const auto weight = static_cast<float>(entry.weight);
    all = digest(in_.texels.subspan(4 * kTexelsPerBox * entry.box, 4 * kTexelsPerBox),
                 digest(std::span(&weight, 1), all));
  }
  return all;
}

// Of all vertices from `begun` on; where its list is does not count.
void FaceRecords::addPiece(VertexRecords& records, std::size_t begun, std::size_t i) {
  const std::uint64_t program = &records == &lit ? 0 : &records == &dark ? 1 : 2;
  const std::uint64_t before = hasList(i) ? listDigest(i) + program : program;
  const std::span<const float> vertices = std::span(records.vertices).subspan(begun);
  const std::vector<Vec3> outline = shrinkingOutline(in_.faces[i], in_.eye, in_.shrunk);
  pieces_[i] = in_.inputs->add(outline, in_.reach, digest(vertices, before));
  records.pieces.add(pieces_[i], records.count);
}

void FaceRecords::placeList(VertexRecords& records, std::size_t begun, std::size_t face,
                            bool withList) const {
  const std::size_t list = withList ? in_.neighbors->lists[face].begin : 0;
  const std::size_t place = kTexelsPerBox * in_.boxes.size() + list;
  for (std::size_t at = begun + kListPlace; at < records.vertices.size(); at += kFaceRecord) {
    records.vertices[at] = static_cast<float>(place);
  }
}

void FaceRecords::addFace(std::size_t i) {
  const DrawnFace& face = in_.faces[i];
  const DrawnBox& box = in_.boxes[face.box];
  const int axis = face.side / 2;
  const Vec3 across = box.pose.worldFromBody.col((axis + 1) % 3);
  const Vec3 along = box.pose.worldFromBody.col((axis + 2) % 3);
  const double width = box.halfExtents[(axis + 1) % 3];
  const double height = box.halfExtents[(axis + 2) % 3];
  VertexRecords& records = in_.shadows.isDark[i] ? dark : isShaded_[i] ? shaded : lit;
  const Vec3 foot = eyeFoot(box, axis, in_.eye);
  const std::size_t begun = records.vertices.size();
  records.addFace(gridOf(i), face.side % 2 != 0);
  forGrid(box, face, gridOf(i), [&](const Vec3& point, double u, double v) {
    std::vector<float>& vertices = records.vertices;
    append(vertices, point - in_.eye);
    append(vertices, face.normal);
    append(vertices, across);
    append(vertices, along);
    for (const double value : {u * width, v * height, width, height}) {
      vertices.push_back(static_cast<float>(value));
    }
    append(vertices, box.color);
    vertices.push_back(box.marked ? 1.0F : 0.0F);
    appendAbout(vertices, kPips.at(static_cast<std::size_t>(face.side)), i, hasList(i));
    append(vertices, foot);
  });
  if (in_.inputs != nullptr) {
    addPiece(records, begun, i);
  }
  placeList(records, begun, i, hasList(i));
}

const Zonogon& FaceRecords::zonogonOfCaster(std::size_t caster) {
  std::optional<Zonogon>& zonogon = zonogons_[caster];
  zonogon = zonogon ? zonogon : zonogonOf(in_.boxes[caster], *in_.towardsLight);
  return *zonogon;
}

void FaceRecords::addShadow(const ShadowPair& pair) {
  const DrawnFace& face = in_.faces[pair.face];
  const Zonogon& zonogon = zonogonOfCaster(pair.caster);
  const FaceGrid grid = isFine_[face.box] ? FaceGrid::kFine : FaceGrid::kAtCorners;
  const std::size_t begun = cast.vertices.size();
  cast.addFace(grid, face.side % 2 != 0);
  forGrid(in_.boxes[face.box], face, grid, [&](const Vec3& point, double, double) {
    appendShadow(cast.vertices, zonogon, point, offsetOf(point, in_.eye), pair.weight);
  });
  if (in_.inputs != nullptr) {
    const std::span<const float> vertices = std::span(cast.vertices).subspan(begun);
    cast.pieces.add(in_.inputs->addAt(pieces_[pair.face], digest(vertices)), cast.count);
  }
}

// In place of a box's faces, which are `first` and those that follow it. The boxes that shade or occlude
// one of them do so with the mesh: each triangle is occluded as the face that it looks most like.
void FaceRecords::addMesh(std::size_t first) {
  const DrawnBox& box = in_.boxes[in_.faces[first].box];
  std::size_t end = first;
  while (end < in_.faces.size() && in_.faces[end].box == in_.faces[first].box) {
    ++end;
  }
  std::map<std::size_t, double> casters;
  for (const ShadowPair& pair : in_.shadows.pairs) {
    if (pair.face >= first && pair.face < end) {
      casters[pair.caster] = std::max(casters[pair.caster], pair.weight);
    }
  }
  for (const MeshFace& face : meshFacesTowards(*box.mesh, box.pose, in_.eye)) {
    std::size_t alike = first;
    const auto likeness = [&](std::size_t i) { return in_.faces[i].normal.dot(face.normal); };
    for (std::size_t i = first; i < end; ++i) {
      alike = likeness(i) > likeness(alike) ? i : alike;
    }
    const bool isDark = in_.towardsLight && !(face.normal.dot(*in_.towardsLight) > 0);
    VertexRecords& records = isDark ? dark : casters.empty() ? lit : shaded;
    addTriangle(records, face, box.color, alike, likeness(alike) > 0 && hasList(alike));
    if (!isDark) {
      for (const auto& [caster, weight] : casters) {
        addShadow(face, zonogonOfCaster(caster), weight);
      }
    }
  }
}

void FaceRecords::addTriangle(VertexRecords& records, const MeshFace& face, const Vec3& color,
                              std::size_t alike, bool withList) {
  const std::size_t begun = records.vertices.size();
  records.addTriangle();
  for (std::size_t corner = 0; corner < 3; ++corner) {
    std::vector<float>& vertices = records.vertices;
    append(vertices, face.corners.at(corner) - in_.eye);
    append(vertices, face.normal);
    append(vertices, face.outward[0]);
    append(vertices, face.outward[1]);
    for (const double value :
         {face.place.at(corner)[0], face.place.at(corner)[1], face.height[0], face.height[1]}) {
      vertices.push_back(static_cast<float>(value));
    }
    append(vertices, color);
    vertices.push_back(0);  // no marks
    appendAbout(vertices, 0, alike, withList);
    vertices.insert(vertices.end(), 3, 0.0F);  // its edges are on the outline
  }
  placeList(records, begun, alike, withList);
}

void FaceRecords::addShadow(const MeshFace& face, const Zonogon& zonogon, double weight) {
  cast.addTriangle();
  for (const Vec3& corner : face.corners) {
    appendShadow(cast.vertices, zonogon, corner, offsetOf(corner, in_.eye), weight);
  }
}

std::vector<float> neighborTexels(std::span<const DrawnBox> boxes, const FaceNeighbors& neighbors,
                                  const Vec3& eye) {
  std::vector<float> texels;
  texels.reserve(4 * (kTexelsPerBox * boxes.size() + neighbors.entries.size()));
  for (const DrawnBox& box : boxes) {
    const Vec3 centre = box.pose.worldFromBody.transpose() * (box.pose.position - eye);
    for (int axis = 0; axis < 3; ++axis) {
      append(texels, box.pose.worldFromBody.col(axis));
      texels.push_back(static_cast<float>(-centre[axis]));
    }
    append(texels, box.halfExtents);
    texels.push_back(0);
    append(texels, kReturnedToBoxes * box.returned);
    texels.push_back(0);
  }
  for (std::size_t face = 0; face < neighbors.lists.size(); ++face) {
    for (const FaceNeighbors::Entry& entry : neighbors.near(face)) {
      texels.insert(texels.end(),
                    {static_cast<float>(kTexelsPerBox * entry.box), static_cast<float>(entry.weight), 0, 0});
    }
    for (const FaceNeighbors::Entry& entry : neighbors.far(face)) {
      const DrawnBox& box = boxes[entry.box];
      const Vec3& half = box.halfExtents;
      const double size = 2 * half.dot(Vec3(half.y(), half.z(), half.x()));  // [m2] the mean silhouette
      append(texels, box.pose.position - eye);
      texels.push_back(static_cast<float>(entry.weight * size / std::numbers::pi));
    }
  }
  return texels;
}

}  // namespace careen
