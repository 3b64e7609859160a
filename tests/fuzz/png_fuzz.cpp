// PNG files. Chunks of a mutated file get checksums that fit.

#include <libdeflate.h>

#include <algorithm>
#include <array>

#include "fuzz/fuzz.h"
#include "image/png.h"

namespace careen {
namespace {

constexpr std::size_t kSignature = 8;
constexpr std::size_t kAround = 12;  // length, type, checksum of a chunk

std::uint32_t bigEndian(const std::uint8_t* at) {
  return static_cast<std::uint32_t>(at[0]) << 24U | static_cast<std::uint32_t>(at[1]) << 16U |
         static_cast<std::uint32_t>(at[2]) << 8U | at[3];
}

void sealChunks(std::uint8_t* data, std::size_t size) {
  std::size_t at = kSignature;
  while (at + kAround <= size && bigEndian(data + at) <= size - at - kAround) {
    const std::size_t length = bigEndian(data + at);
    const std::uint32_t sum = libdeflate_crc32(0, data + at + 4, length + 4);
    for (unsigned k = 0; k < 4; ++k) {
      data[at + 8 + length + k] = static_cast<std::uint8_t>(sum >> (24 - 8 * k));
    }
    at += kAround + length;
  }
}

}  // namespace
}  // namespace careen

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t maxSize,
                                               unsigned seed) {
  const std::size_t mutated = LLVMFuzzerMutate(data, size, maxSize);
  if (seed % 8 != 0) {
    careen::sealChunks(data, mutated);
  }
  return mutated;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace careen;
  fuzz::refusesOrReads([&] { decodePng(fuzz::textOf(data, size), "picture"); });
  return 0;
}
