#include "trajectory/zip_archive.h"

#include <gtest/gtest.h>
#include <libdeflate.h>

#include <cstdint>
#include <string>
#include <vector>

#include "support/input_error.h"

namespace careen {
namespace {

const std::vector<ZipEntry> kEntries = {
    {"a.npy", "some bytes"}, {"b.npy", std::string(100'000, 'x')}, {"c", ""}};

void append(std::string& bytes, std::uint32_t value, int count) {
  for (int i = 0; i < count; ++i) {
    bytes += static_cast<char>(value >> (8 * i));
  }
}

// By hand, as APPNOTE.TXT of PKWARE has it: `count` entries of 2²⁰ zeros each.
std::string bombOf(int count) {
  constexpr std::uint32_t kSize = 1 << 20;
  const std::string zeros(kSize, '\0');
  std::string deflated(4096, '\0');
  libdeflate_compressor* const compressor = libdeflate_alloc_compressor(12);
  deflated.resize(
      libdeflate_deflate_compress(compressor, zeros.data(), zeros.size(), deflated.data(), deflated.size()));
  libdeflate_free_compressor(compressor);
  const std::uint32_t checksum = libdeflate_crc32(0, zeros.data(), zeros.size());
  std::string file;
  std::string directory;
  for (int k = 0; k < count; ++k) {
    std::string common;
    append(common, 20, 2);  // version needed
    append(common, 0, 2);   // flags
    append(common, 8, 2);   // deflated
    append(common, 0, 2);   // time
    append(common, 0x21, 2);
    append(common, checksum, 4);
    append(common, static_cast<std::uint32_t>(deflated.size()), 4);
    append(common, kSize, 4);
    append(common, 3, 2);  // length of the name
    append(common, 0, 2);  // of extras
    const std::string name = "a" + std::to_string(10 + k);
    directory += std::string("PK\x01\x02", 4);
    append(directory, 20, 2);
    directory += common;
    append(directory, 0, 2);  // comment
    append(directory, 0, 2);  // disk
    append(directory, 0, 2);  // attributes
    append(directory, 0, 4);
    append(directory, static_cast<std::uint32_t>(file.size()), 4);
    directory += name;
    file += "PK\x03\x04" + common + name + deflated;
  }
  const auto begin = static_cast<std::uint32_t>(file.size());
  file += directory + std::string("PK\x05\x06\0\0\0\0", 8);
  append(file, static_cast<std::uint32_t>(count), 2);
  append(file, static_cast<std::uint32_t>(count), 2);
  append(file, static_cast<std::uint32_t>(directory.size()), 4);
  append(file, begin, 4);
  append(file, 0, 2);
  return file;
}

TEST(ZipArchive, entriesComeBack) {
  const std::string archive = zipOf(kEntries);
  EXPECT_TRUE(looksLikeZip(archive));
  EXPECT_EQ(unzipped(archive, "z"), kEntries);
  EXPECT_EQ(zipOf(kEntries), archive);  // whatever the time of day
}

TEST(ZipArchive, whatIsCutShortOrDamagedIsRefused) {
  const std::string archive = zipOf(kEntries);
  for (std::size_t size = 0; size < archive.size(); size += 997) {
    EXPECT_NE(inputErrorOf([&] { unzipped(archive.substr(0, size), "z"); }), "no error") << size;
  }
  std::string damaged = archive;
  damaged[damaged.find("some bytes")] = 'S';
  EXPECT_NE(inputErrorOf([&] { unzipped(damaged, "z"); }).find("z: is damaged"), std::string::npos);
}

// A mebibyte of zeros as DEFLATE stores it at best, in 40 entries: 1029 times its size.
TEST(ZipArchive, whatWouldFillTheMemoryIsRefused) {
  const std::string bomb = bombOf(40);
  EXPECT_LT(bomb.size(), 60'000U);
  EXPECT_NE(inputErrorOf([&] { unzipped(bomb, "z"); }).find("unpacks to more than 64 times"),
            std::string::npos);
  EXPECT_EQ(unzipped(bombOf(2), "z").size(), 2U);  // what is small may be packed as well as it can
}

TEST(ZipArchive, tablesAreNone) { EXPECT_FALSE(looksLikeZip("time,box,x")); }

}  // namespace
}  // namespace careen
