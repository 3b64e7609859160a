// Families of scenes: read, and one run of them made.

#include "fuzz/fuzz.h"
#include "sweep/family.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace careen;
  fuzz::refusesOrReads([&] {
    const std::string text(fuzz::textOf(data, size));
    static_cast<void>(looksLikeFamily(text));
    static_cast<void>(Family(text, "family").member(3));
  });
  return 0;
}
