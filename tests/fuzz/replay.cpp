// Drives a fuzzer without libFuzzer, in every build: all files of its corpus, then mutations of them for some
// seconds. The sequence of inputs is the same every time. A crash, an exception that is no Error or 10 s for
// an input ends it; the input is then in the file NAME.input of the working folder.
//
//   careen_NAME_fuzz SECONDS FOLDER…

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "fuzz/fuzz.h"

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
// Only some fuzzers have their own mutations.
extern "C" __attribute__((weak)) std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                                                     std::size_t maxSize, unsigned seed);

namespace {

constexpr std::size_t kLargest = 1 << 16;  // [bytes] as tests/fuzz/run tells libFuzzer
constexpr unsigned kPatience = 10;         // [s]
constexpr rlim_t kMemory = rlim_t{2} << 30U;

std::mt19937 dice;  // NOLINT(cert-msc51-cpp): the same sequence every time

std::size_t below(std::size_t count) {
  return std::uniform_int_distribution<std::size_t>(0, count - 1)(dice);
}

Bytes contentOf(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<Bytes> corpusOf(int count, char** folders) {
  std::vector<fs::path> paths;
  for (int k = 0; k < count; ++k) {
    for (const fs::directory_entry& entry : fs::directory_iterator(folders[k])) {
      if (entry.is_regular_file()) {
        paths.push_back(entry.path());
      }
    }
  }
  std::sort(paths.begin(), paths.end());
  std::vector<Bytes> corpus;
  std::transform(paths.begin(), paths.end(), std::back_inserter(corpus), contentOf);
  return corpus;
}

void run(const Bytes& input, const fs::path& copy) {
  std::ofstream(copy, std::ios::binary)
      .write(reinterpret_cast<const char*>(input.data()), static_cast<std::streamsize>(input.size()));
  alarm(kPatience);
  LLVMFuzzerTestOneInput(input.data(), input.size());
  alarm(0);
}

Bytes mutated(Bytes input) {
  const std::size_t size = std::min(input.size(), kLargest);
  input.resize(kLargest);
  const std::size_t left =
      LLVMFuzzerCustomMutator != nullptr && below(4) > 0
          ? LLVMFuzzerCustomMutator(input.data(), size, kLargest, static_cast<unsigned>(dice()))
          : LLVMFuzzerMutate(input.data(), size, kLargest);
  input.resize(left);
  return input;
}

}  // namespace

// A few changes: a byte, a number's digit, a piece removed, a piece said twice.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t maxSize) {
  for (std::size_t change = 0; change <= below(4) && size > 0; ++change) {
    const std::size_t at = below(size);
    const std::size_t length = 1 + below(std::min<std::size_t>(size - at, 16));
    switch (below(5)) {
      case 0:
        data[at] = static_cast<std::uint8_t>(below(256));
        break;
      case 1:
        data[at] = static_cast<std::uint8_t>("0123456789e-.\"[]{},:"[below(20)]);
        break;
      case 2:
        data[at] = static_cast<std::uint8_t>(data[at] ^ (1U << below(8)));
        break;
      case 3:
        std::copy(data + at + length, data + size, data + at);
        size -= length;
        break;
      default:
        if (size + length <= maxSize) {
          std::copy_backward(data + at, data + size, data + size + length);
          size += length;
        }
    }
  }
  return size;
}

int main(int argc, char** argv) {
#ifndef __SANITIZE_ADDRESS__
  const rlimit memory = {.rlim_cur = kMemory, .rlim_max = kMemory};
  setrlimit(RLIMIT_AS, &memory);
#endif
  const std::chrono::duration<double> seconds(std::atof(argv[1]));
  const std::vector<Bytes> corpus = corpusOf(argc - 2, argv + 2);
  if (corpus.empty()) {
    std::cerr << "no corpus\n";
    return 1;
  }
  const fs::path copy = fs::path(argv[0]).filename().string() + ".input";
  for (const Bytes& input : corpus) {
    run(input, copy);
  }
  std::size_t runs = corpus.size();
  for (const auto start = std::chrono::steady_clock::now();
       std::chrono::steady_clock::now() - start < seconds; ++runs) {
    run(mutated(corpus[below(corpus.size())]), copy);
  }
  fs::remove(copy);
  std::cout << corpus.size() << " files of the corpus, " << runs << " inputs\n";
  return 0;
}
