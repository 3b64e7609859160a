#include "scene/obj_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <string_view>
#include <tuple>
#include <vector>

#include "core/error.h"
#include "scene/json_shape.h"
#include "scene/json_tree.h"

namespace careen {
namespace {

constexpr std::string_view kBlanks = " \t\r";

// The words of a line, up to a comment.
std::vector<std::string_view> wordsOf(std::string_view line) {
  line = line.substr(0, line.find('#'));
  std::vector<std::string_view> words;
  for (std::size_t at = line.find_first_not_of(kBlanks); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(kBlanks, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(kBlanks, end);
  }
  return words;
}

class ObjReader {
 public:
  explicit ObjReader(const std::string& name) : name_(name) {}

  void read(std::string_view line) {
    ++line_;
    const std::vector<std::string_view> words = wordsOf(line);
    if (!words.empty() && words[0] == "v") {
      readVertex(words);
    } else if (!words.empty() && words[0] == "f") {
      readFace(words);
    }
  }
  TriangleMesh take() { return std::move(mesh_); }

 private:
  [[noreturn]] void fail(std::string_view found, const std::string& expected) const {
    throw InputError(name_ + ":" + std::to_string(line_) + ": found " + inQuotes(found) + ", expected " +
                     expected);
  }

  // x y z, and perhaps a weight or a colour.
  void readVertex(const std::vector<std::string_view>& words) {
    Vec3 point;
    for (std::size_t k = 0; k < 3; ++k) {
      if (words.size() < 4) {
        fail(words.back(), "v and three coordinates [m]");
      }
      const std::string_view word = words[k + 1];
      double& value = point[static_cast<Eigen::Index>(k)];
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (error != std::errc() || end != word.data() + word.size() || !(std::fabs(value) <= kLargestNumber)) {
        fail(word, "a coordinate [m]");
      }
    }
    point += Vec3::Zero();  // no -0: it is the same place
    const auto [known, isNew] =
        known_.try_emplace(std::tuple(point.x(), point.y(), point.z()), mesh_.points.size());
    if (isNew) {
      mesh_.points.push_back(point);
    }
    vertices_.push_back(known->second);
  }

  // 3, 3/1, 3//2 or 3/1/2; counted from 1, or back from the last vertex if negative.
  std::size_t vertexOf(std::string_view word) const {
    const std::string_view number = word.substr(0, word.find('/'));
    long long index = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), index);
    const auto count = static_cast<long long>(vertices_.size());
    const bool fits = error == std::errc() && end == number.data() + number.size() &&
                      ((index >= 1 && index <= count) || (index <= -1 && index >= -count));
    if (!fits) {
      fail(word, "one of the " + std::to_string(count) + " vertices before this line");
    }
    return vertices_[static_cast<std::size_t>(index > 0 ? index - 1 : count + index)];
  }

  void readFace(const std::vector<std::string_view>& words) {
    if (words.size() < 4) {
      fail(words.back(), "f and at least three vertices");
    }
    std::vector<std::size_t> corners;
    for (std::size_t k = 1; k < words.size(); ++k) {
      corners.push_back(vertexOf(words[k]));
    }
    for (std::size_t k = 2; k < corners.size(); ++k) {
      const std::array<std::size_t, 3> triangle = {corners[0], corners[k - 1], corners[k]};
      // One without area adds nothing; its edges cancel.
      if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0]) {
        mesh_.triangles.push_back(triangle);
      }
    }
  }

  const std::string& name_;
  std::size_t line_ = 0;
  TriangleMesh mesh_;
  std::vector<std::size_t> vertices_;  // of the file → points of the mesh
  std::map<std::tuple<double, double, double>, std::size_t> known_;
};

}  // namespace

TriangleMesh parseObj(const std::string& text, const std::string& name) {
  ObjReader reader(name);
  const std::string_view all = text;
  for (std::size_t at = 0; at < all.size();) {
    const std::size_t end = std::min(all.find('\n', at), all.size());
    reader.read(all.substr(at, end - at));
    at = end + 1;
  }
  return reader.take();
}

}  // namespace careen
