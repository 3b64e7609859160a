// Trajectory files. A mutation is made in the unpacked record and packed again, with a checksum that fits:
// what a hostile file has.

#include <algorithm>
#include <cstring>
#include <optional>

#include "core/hash.h"
#include "fuzz/fuzz.h"
#include "trajectory/compression.h"
#include "trajectory/trajectory_file.h"

namespace careen {
namespace {

constexpr std::size_t kWord = sizeof(std::uint64_t);
constexpr std::size_t kHeader = 3 * kWord;  // magic word, version, size of the record
constexpr std::size_t kLargest = 1 << 20;   // [bytes] of a record to mutate

std::string word(std::uint64_t value) {
  std::string bytes(kWord, '\0');
  std::memcpy(bytes.data(), &value, kWord);
  return bytes;
}

std::optional<std::string> recordOf(std::string_view file) {
  if (file.size() < kHeader + kWord) {
    return std::nullopt;
  }
  std::uint64_t size = 0;
  std::memcpy(&size, file.data() + 2 * kWord, kWord);
  return size > kLargest ? std::nullopt
                         : decompressed(file.substr(kHeader, file.size() - kHeader - kWord), size);
}

std::string fileOf(std::string_view beginning, std::string_view record) {
  std::string file = std::string(beginning) + word(record.size()) + compressed(record);
  Hash hash;
  hash.add(file);
  return file + word(hash.value());
}

}  // namespace
}  // namespace careen

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t maxSize,
                                               unsigned seed) {
  using namespace careen;
  const std::string_view file = fuzz::textOf(data, size);
  std::optional<std::string> record = recordOf(file);
  if (!record || seed % 8 == 0) {
    return LLVMFuzzerMutate(data, size, maxSize);
  }
  const std::size_t before = record->size();
  record->resize(before + kHeader);
  record->resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(record->data()), before, record->size()));
  const std::string mutated = fileOf(file.substr(0, 2 * kWord), *record);
  if (mutated.size() > maxSize) {
    return size;
  }
  std::copy(mutated.begin(), mutated.end(), data);
  return mutated.size();
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace careen;
  fuzz::refusesOrReads([&] {
    const Trajectory run = decodeTrajectory(std::string(fuzz::textOf(data, size)), "run");
    for (int k = 0; k <= 4; ++k) {
      run.poses(run.settings.duration * k / 4);
    }
  });
  return 0;
}
