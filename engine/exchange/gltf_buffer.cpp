#include "exchange/gltf_buffer.h"

#include <algorithm>
#include <bit>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/error.h"

namespace careen {
namespace {

constexpr int kFloat = 5126;
constexpr int kUnsignedShort = 5123;
constexpr int kIndexTarget = 34963;
constexpr std::size_t kMostBytes = std::size_t{1} << 31U;

template <class Integer>
void append(std::string& bytes, Integer value) {
  for (std::size_t i = 0; i < sizeof(Integer); ++i) {
    bytes.push_back(static_cast<char>(value >> (8 * i)));
  }
}

void pad(std::string& bytes, char filler) { bytes.resize((bytes.size() + 3) / 4 * 4, filler); }

void appendChunk(std::string& bytes, std::uint32_t type, const std::string& chunk) {
  append(bytes, static_cast<std::uint32_t>(chunk.size()));
  append(bytes, type);
  bytes += chunk;
}

}  // namespace

std::array<float, 3> floatsOf(const Vec3& value) {
  return {static_cast<float>(value.x()), static_cast<float>(value.y()), static_cast<float>(value.z())};
}

std::array<float, 4> floatsOf(const Quat& value) {
  return {static_cast<float>(value.x()), static_cast<float>(value.y()), static_cast<float>(value.z()),
          static_cast<float>(value.w())};
}

std::size_t GltfBuffer::addView(std::size_t offset, int target) {
  views_.push_back({.offset = offset, .length = bytes_.size() - offset, .target = target});
  pad(bytes_, '\0');
  return views_.size() - 1;
}

std::size_t GltfBuffer::addFloats(Kind kind, const std::vector<float>& numbers, bool bounded, int target) {
  const std::size_t components = kind == Kind::kScalar ? 1 : kind == Kind::kVec3 ? 3 : 4;
  const std::size_t offset = bytes_.size();
  if (offset + 4 * numbers.size() > kMostBytes) {
    throw InputError("found an animation of more than 2 GiB, expected a shorter run or a larger --within");
  }
  for (const float number : numbers) {
    append(bytes_, std::bit_cast<std::uint32_t>(number));
  }
  Accessor accessor{.view = addView(offset, target),
                    .componentType = kFloat,
                    .count = numbers.size() / components,
                    .type = kind == Kind::kScalar ? "SCALAR"
                            : kind == Kind::kVec3 ? "VEC3"
                                                  : "VEC4",
                    .min = {},
                    .max = {}};
  if (bounded) {
    accessor.min.assign(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(components));
    accessor.max = accessor.min;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      float& least = accessor.min[i % components];
      float& most = accessor.max[i % components];
      least = std::min(least, numbers[i]);
      most = std::max(most, numbers[i]);
    }
  }
  accessors_.push_back(std::move(accessor));
  return accessors_.size() - 1;
}

std::size_t GltfBuffer::addIndices(const std::vector<std::uint16_t>& indices) {
  const std::size_t offset = bytes_.size();
  for (const std::uint16_t index : indices) {
    append(bytes_, index);
  }
  accessors_.push_back({.view = addView(offset, kIndexTarget),
                        .componentType = kUnsignedShort,
                        .count = indices.size(),
                        .type = "SCALAR",
                        .min = {},
                        .max = {}});
  return accessors_.size() - 1;
}

std::string GltfBuffer::pack(nlohmann::ordered_json document) const {
  document["buffers"] = {{{"byteLength", bytes_.size()}}};
  for (const View& view : views_) {
    nlohmann::ordered_json& written = document["bufferViews"].emplace_back();
    written = {{"buffer", 0}, {"byteOffset", view.offset}, {"byteLength", view.length}};
    if (view.target != 0) {
      written["target"] = view.target;
    }
  }
  for (const Accessor& accessor : accessors_) {
    nlohmann::ordered_json& written = document["accessors"].emplace_back();
    written = {{"bufferView", accessor.view},
               {"componentType", accessor.componentType},
               {"count", accessor.count},
               {"type", accessor.type}};
    if (!accessor.min.empty()) {
      written["min"] = accessor.min;
      written["max"] = accessor.max;
    }
  }
  std::string json = document.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  pad(json, ' ');
  if (json.size() + bytes_.size() > kMostBytes) {
    throw InputError("found an animation of more than 2 GiB, expected a shorter run or a larger --within");
  }
  constexpr std::uint32_t kMagic = 0x46546C67;  // "glTF"
  constexpr std::uint32_t kJson = 0x4E4F534A;
  constexpr std::uint32_t kBinary = 0x004E4942;
  std::string file;
  append(file, kMagic);
  append(file, std::uint32_t{2});
  append(file, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + bytes_.size()));
  appendChunk(file, kJson, json);
  appendChunk(file, kBinary, bytes_);
  return file;
}

}  // namespace careen
