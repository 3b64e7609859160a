#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace careen {

/// A GLB file taken apart as the specification of glTF 2.0 says, by code that shares nothing with the writer.
struct Glb {
  nlohmann::json json;
  std::string binary;

  explicit Glb(const std::string& bytes) {
    if (bytes.size() < 20 || bytes.substr(0, 4) != "glTF" || word(bytes, 4) != 2 ||
        word(bytes, 8) != bytes.size() || bytes.substr(16, 4) != "JSON") {
      throw std::runtime_error("no GLB");
    }
    const std::uint32_t length = word(bytes, 12);
    json = nlohmann::json::parse(bytes.substr(20, length));
    const std::size_t second = 20 + length;
    if (length % 4 != 0 || bytes.substr(second + 4, 4) != std::string("BIN\0", 4) ||
        second + 8 + word(bytes, second) != bytes.size()) {
      throw std::runtime_error("no binary chunk");
    }
    binary = bytes.substr(second + 8);
  }

  std::vector<float> floats(std::size_t accessor) const {
    const nlohmann::json& found = json.at("accessors").at(accessor);
    const nlohmann::json& view = json.at("bufferViews").at(found.at("bufferView").get<std::size_t>());
    const std::size_t components = found.at("type") == "SCALAR" ? 1 : found.at("type") == "VEC3" ? 3 : 4;
    const std::size_t count = found.at("count").get<std::size_t>() * components;
    if (found.at("componentType") != 5126 || view.at("byteLength") != 4 * count) {
      throw std::runtime_error("no floats");
    }
    std::vector<float> numbers(count);
    std::memcpy(numbers.data(), binary.substr(view.at("byteOffset"), 4 * count).data(), 4 * count);
    return numbers;
  }

 private:
  static std::uint32_t word(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes.at(at + i))) << (8 * i);
    }
    return value;
  }
};

}  // namespace careen
