#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/error.h"

// What the fuzzers share. Each reads one kind of input from arbitrary bytes; a crash, a sanitizer's finding,
// an exception that is no Error, more than 1 GB or more than 10 s is a finding.

namespace careen::fuzz {

inline std::string_view textOf(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Refusing an input is right; any other exception ends the fuzzer.
template <class Read>
void refusesOrReads(Read read) {
  try {
    read();
  } catch (const Error&) {  // NOLINT(bugprone-empty-catch): that is what bad input gets
  }
}

}  // namespace careen::fuzz

/// Mutates data in place, up to maxSize; from libFuzzer.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t maxSize);
