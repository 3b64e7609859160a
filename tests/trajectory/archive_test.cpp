#include "trajectory/archive.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "support/input_error.h"

namespace careen {
namespace {

enum class Fruit { kApple, kPear };
constexpr std::array<std::string_view, 2> kFruits = {"apple", "pear"};
using Either = std::variant<int, double>;

/// What reading the bytes into `value` says.
template <class Read>
std::string messageOf(const std::string& bytes, Read read) {
  return inputErrorOf([&] {
    ArchiveReader reader(bytes, "a file");
    read(reader);
  });
}

TEST(Archive, isLittleEndian) {
  ArchiveWriter writer;
  writer.visit(std::uint32_t{0x01020304});
  writer.visit(-2.0);  // 0xc000000000000000
  writer.visit(std::string("ab"));
  using std::string_literals::operator""s;
  EXPECT_EQ(writer.bytes(), "\4\3\2\1"s + "\0\0\0\0\0\0\0\xc0"s + "\2\0\0\0\0\0\0\0ab"s);
}

TEST(Archive, readsWhatItWrote) {
  ArchiveWriter writer;
  const std::vector<double> numbers = {0.1, -0.0, 1e-320};
  const std::optional<double> none;
  const std::optional<double> one = 3;
  const Fruit fruit = Fruit::kPear;
  const Either either = 7.0;
  visitAll(writer, numbers);
  visitOptional(writer, none);
  visitOptional(writer, one);
  visitNamed(writer, fruit, kFruits);
  visitVariant(writer, either);

  ArchiveReader reader(writer.bytes(), "a file");
  std::vector<double> numbersAgain = {4};
  std::optional<double> noneAgain = 4;
  std::optional<double> oneAgain;
  Fruit fruitAgain = Fruit::kApple;
  Either eitherAgain = 1;
  visitAll(reader, numbersAgain);
  visitOptional(reader, noneAgain);
  visitOptional(reader, oneAgain);
  visitNamed(reader, fruitAgain, kFruits);
  visitVariant(reader, eitherAgain);
  EXPECT_EQ(numbersAgain, numbers);
  EXPECT_TRUE(std::signbit(numbersAgain[1]));
  EXPECT_EQ(noneAgain, none);
  EXPECT_EQ(oneAgain, one);
  EXPECT_EQ(fruitAgain, fruit);
  EXPECT_EQ(eitherAgain, either);
  EXPECT_TRUE(reader.atEnd());
}

TEST(Archive, refusesBytesThatEndTooEarly) {
  ArchiveWriter writer;
  writer.visit(std::string("text"));
  for (std::size_t size = 0; size < writer.bytes().size(); ++size) {
    std::string text;
    EXPECT_EQ(messageOf(writer.bytes().substr(0, size), [&](ArchiveReader& reader) { reader.visit(text); }),
              "a file: this trajectory file is cut short")
        << size;
  }
}

// 2⁵⁹ elements would not fit into memory: it must end at the first that is missing.
TEST(Archive, makesNoElementsForAFalseCount) {
  ArchiveWriter writer;
  writer.visit(std::uint64_t{1} << 59U);
  writer.visit(1.5);
  std::vector<double> numbers;
  EXPECT_EQ(messageOf(writer.bytes(), [&](ArchiveReader& reader) { visitAll(reader, numbers); }),
            "a file: this trajectory file is cut short");
  EXPECT_EQ(numbers.size(), 2U);
}

TEST(Archive, refusesANameOrAnAlternativeItDoesNotKnow) {
  ArchiveWriter name;
  name.visit(std::string("plum"));
  Fruit fruit = Fruit::kApple;
  EXPECT_EQ(messageOf(name.bytes(), [&](ArchiveReader& reader) { visitNamed(reader, fruit, kFruits); }),
            "a file: this trajectory file has 'plum', expected one of apple, pear");
  Either either = 1;
  EXPECT_EQ(messageOf(std::string(1, '\2'), [&](ArchiveReader& reader) { visitVariant(reader, either); }),
            "a file: this trajectory file has an unknown kind of record");
}

}  // namespace
}  // namespace careen
