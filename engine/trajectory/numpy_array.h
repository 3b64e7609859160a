#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "trajectory/zip_archive.h"

namespace careen {

/// An array of NumPy: numbers or texts, the last index running fastest.
struct NumpyArray {
  std::vector<std::size_t> shape;
  std::vector<double> numbers;  ///< if it is not of texts
  std::vector<std::string> texts;
  bool isText = false;

  static NumpyArray of(std::vector<double> numbers, std::vector<std::size_t> shape);
  static NumpyArray of(std::vector<std::string> texts, std::vector<std::size_t> shape);

  std::size_t size() const { return isText ? texts.size() : numbers.size(); }
};

/// The bytes of a .npy file, format 1.0 (NumPy Enhancement Proposal 1): '<f8', or '<U' for texts, C order.
std::string encodeNumpy(const NumpyArray& array);

/// Arrays of numbers of four and one bytes, '<f4', '<i4' and '|u1': for pictures, which are large.
std::string encodeNumpy(std::span<const float> numbers, const std::vector<std::size_t>& shape);
std::string encodeNumpy(std::span<const std::int32_t> numbers, const std::vector<std::size_t>& shape);
std::string encodeNumpy(std::span<const std::uint8_t> numbers, const std::vector<std::size_t>& shape);

/// Reads formats 1 to 3, floats of 2, 4 and 8 bytes, integers, booleans, texts '<U', '>U' and '|S', of either
/// byte order, in C or Fortran order. InputError, which `name` begins, for everything else.
NumpyArray decodeNumpy(std::string_view bytes, const std::string& name);

/// Arrays with names and units, as NumPy loads them.
class NumpyArchive {
 public:
  void add(const std::string& name, const std::string& unit, const NumpyArray& array);
  /// An NPZ archive; its last array, `units`, has the name and unit of each. To be called once.
  std::string bytes();

 private:
  std::vector<ZipEntry> entries_;
  std::vector<std::string> units_;  // name, unit, name, unit …
};

}  // namespace careen
