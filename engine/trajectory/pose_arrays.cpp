#include "trajectory/pose_arrays.h"

#include <array>
#include <map>
#include <utility>

#include "core/error.h"
#include "trajectory/numpy_array.h"
#include "trajectory/zip_archive.h"

namespace careen {
namespace {

using Arrays = std::map<std::string, NumpyArray>;

constexpr std::string_view kExtension = ".npy";

// What encodeNpz() writes beside the poses.
bool isOfPoses(const std::string& array) {
  return array != "units" && array != "joint" && !array.starts_with("impact_") &&
         !array.starts_with("joint_") && !array.starts_with("energy_");
}

Arrays arraysIn(const std::string& bytes, const std::string& name) {
  Arrays arrays;
  for (const auto& [entry, content] : unzipped(bytes, name)) {
    std::string array = entry;
    if (array.ends_with(kExtension)) {
      array.resize(array.size() - kExtension.size());
    }
    if (isOfPoses(array)) {
      arrays[array] = decodeNumpy(content, name + ": array " + array);
    }
  }
  return arrays;
}

std::string shapeOf(const NumpyArray& array) {
  std::string text;
  for (const std::size_t length : array.shape) {
    text += (text.empty() ? "" : " x ") + std::to_string(length);
  }
  return text.empty() ? "a single value" : text;
}

}  // namespace

PoseTable readPoseArrays(const std::string& bytes, const std::string& name) {
  const Arrays arrays = arraysIn(bytes, name);
  std::vector<std::string> names;
  for (const auto& [array, content] : arrays) {
    names.push_back(array);
  }
  PoseTable table;
  table.name = name;
  table.placeFormat = "row";
  PoseTableBuilder builder(std::move(table), names, name + ": ");

  const NumpyArray& times = arrays.at("time");
  const std::vector<std::size_t> shape = arrays.at("x").shape;
  const bool isWide = shape.size() == 2;
  const std::size_t moments = shape.empty() ? 0 : shape[0];
  const std::size_t boxes = isWide ? shape[1] : 1;
  const auto expect = [&](const std::string& array, const NumpyArray& content,
                          const std::vector<std::size_t>& due, const char* what) {
    if (content.shape != due || content.isText != (array == "box")) {
      throw InputError(name + ": array " + array + ": found " + (content.isText ? "texts, " : "numbers, ") +
                       shapeOf(content) + ", expected " + what);
    }
  };
  if (shape.empty() || shape.size() > 2) {
    throw InputError(name + ": array x: found " + shapeOf(arrays.at("x")) +
                     ", expected one index for rows, or two for times and boxes");
  }
  std::array<const NumpyArray*, kPoseColumns.size()> columns{};
  for (std::size_t k = 0; k < kPoseColumns.size(); ++k) {
    const std::string column(kPoseColumns[k]);
    const auto found = arrays.find(column);
    if (found == arrays.end()) {
      continue;
    }
    columns[k] = &found->second;
    if (column == "time") {
      expect(column, times, {moments}, "a number for each row, or for each first index of x");
    } else if (column == "box") {
      expect(column, found->second, {isWide ? boxes : moments},
             "a name for each row, or for each second index of x");
    } else {
      expect(column, found->second, shape, "numbers in the shape of x");
    }
  }
  if (isWide && boxes > 1 && !arrays.contains("box")) {
    throw InputError(name + ": found no array box, expected the names of " + std::to_string(boxes) +
                     " boxes");
  }
  std::array<double, kPoseColumns.size()> numbers{};
  for (std::size_t moment = 0; moment < moments; ++moment) {
    for (std::size_t box = 0; box < boxes; ++box) {
      const std::size_t place = moment * boxes + box;
      for (std::size_t k = 0; k < kPoseColumns.size(); ++k) {
        if (columns[k] != nullptr && !columns[k]->isText) {
          numbers[k] = columns[k]->numbers[kPoseColumns[k] == "time" ? moment : place];
        }
      }
      const NumpyArray* const names_ = columns[1];
      builder.add(moment, numbers, names_ == nullptr ? "" : names_->texts[isWide ? box : place]);
    }
  }
  return builder.finish();
}

}  // namespace careen
