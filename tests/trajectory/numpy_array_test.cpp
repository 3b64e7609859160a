#include "trajectory/numpy_array.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "support/input_error.h"

namespace careen {
namespace {

// A file as NumPy 1.24.2 writes it: magic word, version 1.0, length of the header, header up to 128 bytes.
std::string file(std::string header, const std::string& data) {
  header.resize(117, ' ');
  header += '\n';
  return std::string("\x93NUMPY\x01\x00\x76\x00", 10) + header + data;
}

std::string headerOf(const std::string& type, const std::string& shape, bool fortran = false) {
  return "{'descr': '" + type + "', 'fortran_order': " + (fortran ? "True" : "False") +
         ", 'shape': " + shape + ", }";
}

std::string bytes(std::initializer_list<int> values) {
  std::string text;
  for (const int value : values) {
    text += static_cast<char>(value);
  }
  return text;
}

TEST(NumpyArray, bytesAreThoseOfNumpy) {
  const NumpyArray array = NumpyArray::of(std::vector<double>{1.5, -2}, {2});
  // np.save(f, np.array([1.5, -2])), but for a comma that NumPy writes after a single length only.
  EXPECT_EQ(encodeNumpy(array),
            file(headerOf("<f8", "(2,)"), bytes({0, 0, 0, 0, 0, 0, 0xF8, 0x3F, 0, 0, 0, 0, 0, 0, 0, 0xC0})));
}

TEST(NumpyArray, everyTypeOfNumberIsRead) {
  struct Case {
    std::string type;
    std::string data;
    double first;
  };
  const std::vector<Case> cases = {{"<f8", bytes({0, 0, 0, 0, 0, 0, 0xF8, 0x3F}), 1.5},
                                   {">f8", bytes({0x3F, 0xF8, 0, 0, 0, 0, 0, 0}), 1.5},
                                   {"<f4", bytes({0, 0, 0x20, 0xC0}), -2.5},
                                   {">f4", bytes({0xC0, 0x20, 0, 0}), -2.5},
                                   {"<f2", bytes({0x55, 0x35}), 0.333251953125},
                                   {">f2", bytes({0xC0, 0x00}), -2},
                                   {"<i8", bytes({0xFE, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF}), -2},
                                   {"<i4", bytes({0xFE, 0xFF, 0xFF, 0xFF}), -2},
                                   {"<u4", bytes({0xFE, 0xFF, 0xFF, 0xFF}), 4294967294.0},
                                   {"|i1", bytes({0xFE}), -2},
                                   {"|b1", bytes({1}), 1}};
  for (const Case& each : cases) {
    const NumpyArray array = decodeNumpy(file(headerOf(each.type, "(1,)"), each.data), "a");
    EXPECT_EQ(array.numbers, std::vector<double>{each.first}) << each.type;
    EXPECT_EQ(array.shape, std::vector<std::size_t>{1});
    EXPECT_FALSE(array.isText);
  }
}

// The bits of a half, 13 places up, are those of a float 2¹¹² times as small, which the product makes exact.
TEST(NumpyArray, everyHalfIsReadExactly) {
  std::string data;
  for (unsigned bits = 0; bits < 65536; ++bits) {
    data += bytes({static_cast<int>(bits & 0xFFU), static_cast<int>(bits >> 8U)});
  }
  const std::vector<double> read = decodeNumpy(file(headerOf("<f2", "(65536,)"), data), "a").numbers;
  ASSERT_EQ(read.size(), 65536U);
  int others = 0;
  for (unsigned bits = 0; bits < 65536; ++bits) {
    const unsigned size = bits & 0x7FFFU;
    EXPECT_EQ(std::signbit(read[bits]), bits >= 0x8000U) << bits;
    if (size >= 0x7C00U) {
      EXPECT_EQ(size == 0x7C00U ? std::isinf(read[bits]) : std::isnan(read[bits]), true) << bits;
      ++others;
      continue;
    }
    const double expected = static_cast<double>(std::bit_cast<float>(size << 13U)) * std::ldexp(1.0, 112);
    EXPECT_EQ(std::fabs(read[bits]), expected) << bits;
  }
  EXPECT_EQ(others, 2048);
  EXPECT_EQ(read[0x3C00], 1);
  EXPECT_EQ(read[0x0001], std::ldexp(1.0, -24));
  EXPECT_EQ(read[0x7BFF], 65504);
}

TEST(NumpyArray, textsComeBackInEveryEncoding) {
  const std::vector<std::string> texts = {"crate", "", "Würfel", "箱", "🎲"};
  const NumpyArray array = decodeNumpy(encodeNumpy(NumpyArray::of(texts, {5})), "a");
  EXPECT_TRUE(array.isText);
  EXPECT_EQ(array.texts, texts);
  EXPECT_EQ(decodeNumpy(file(headerOf("|S3", "(2,)"), bytes({'a', 'b', 0, 'c', 'd', 'e'})), "a").texts,
            (std::vector<std::string>{"ab", "cde"}));
  EXPECT_EQ(decodeNumpy(file(headerOf(">U2", "(1,)"), bytes({0, 0, 0, 'x', 0, 0, 0, 0})), "a").texts,
            std::vector<std::string>{"x"});
}

TEST(NumpyArray, fortranOrderIsTurnedRound) {
  // [[1, 2, 3], [4, 5, 6]] by columns.
  const std::string data = bytes({1, 4, 2, 5, 3, 6});
  const NumpyArray array = decodeNumpy(file(headerOf("|u1", "(2, 3)", true), data), "a");
  EXPECT_EQ(array.shape, (std::vector<std::size_t>{2, 3}));
  EXPECT_EQ(array.numbers, (std::vector<double>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(decodeNumpy(file(headerOf("|u1", "(2, 3)"), data), "a").numbers,
            (std::vector<double>{1, 4, 2, 5, 3, 6}));
}

TEST(NumpyArray, whatIsNoneIsRefused) {
  const std::string good = file(headerOf("<f8", "(2,)"), std::string(16, '\0'));
  const auto refusal = [](const std::string& text) { return inputErrorOf([&] { decodeNumpy(text, "a"); }); };
  EXPECT_EQ(refusal(good), "no error");
  EXPECT_EQ(refusal(good.substr(0, 140)), "a: is cut short: 12 bytes, expected 2 elements of 8");
  EXPECT_EQ(refusal(good + "x"), "a: has bytes after its end");
  EXPECT_EQ(refusal(good.substr(0, 60)), "a: is cut short");
  EXPECT_EQ(refusal("hello, this is no array"), "a: is no NumPy array, expected one in the format .npy");
  EXPECT_EQ(refusal(file(headerOf("<f8", "(99999999999, 99999999999)"), "")),
            "a: is cut short: its shape asks for more than it has");
  EXPECT_EQ(refusal(file(headerOf("<c16", "(1,)"), std::string(16, '\0'))),
            "a: has elements of the type '<c16', expected numbers or texts");
  EXPECT_EQ(refusal(file("{'descr': [('x', '<f8')], 'fortran_order': False, 'shape': (1,), }", "12345678")),
            "a: has elements of several parts, expected numbers or texts");
  EXPECT_EQ(refusal(file("{'fortran_order': False}", "")), "a: has a header without 'descr'");
}

TEST(NumpyArray, damagedFilesNeverDoHarm) {
  const std::string good = encodeNumpy(NumpyArray::of(std::vector<double>{1, 2, 3, 4}, {2, 2}));
  std::size_t refused = 0;
  for (std::size_t at = 0; at < good.size(); ++at) {
    for (const char c : {'\0', '\xFF', '9', '('}) {
      std::string damaged = good;
      damaged[at] = c;
      refused += inputErrorOf([&] { decodeNumpy(damaged, "a"); }) == "no error" ? 0U : 1U;
    }
  }
  EXPECT_GT(refused, 100U);  // measured 205
}

TEST(NumpyArray, writesSmallNumbersThatItReadsBack) {
  const std::vector<float> floats = {1.5F, -0.1F, 3e38F, -0.0F};
  const std::vector<std::int32_t> integers = {1, -2, 2147483647, -2147483647};
  const std::vector<std::uint8_t> bytes = {0, 1, 255, 128};
  EXPECT_EQ(decodeNumpy(encodeNumpy(floats, {2, 2}), "test").numbers,
            std::vector<double>(floats.begin(), floats.end()));
  EXPECT_EQ(decodeNumpy(encodeNumpy(integers, {2, 2}), "test").numbers,
            std::vector<double>(integers.begin(), integers.end()));
  const NumpyArray read = decodeNumpy(encodeNumpy(bytes, {4, 1}), "test");
  EXPECT_EQ(read.numbers, std::vector<double>(bytes.begin(), bytes.end()));
  EXPECT_EQ(read.shape, (std::vector<std::size_t>{4, 1}));
}

}  // namespace
}  // namespace careen
