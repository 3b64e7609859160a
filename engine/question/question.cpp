#include "question/question.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>

#include "core/characters.h"
#include "core/error.h"
#include "core/names.h"

namespace careen {
namespace {

constexpr std::size_t kMostNames = 12;  // that a message lists

struct Word {
  std::string text;
  std::size_t at = 0;  // bytes before it
  bool isQuoted = false;
  bool isEnd = false;

  bool is(std::string_view plain) const { return !isQuoted && !isEnd && text == plain; }
};

class QuestionReader {
 public:
  QuestionReader(const std::string& text, const World& world) : text_(text), world_(world) { take(); }

  Question read();

 private:
  enum class Whom { kBox, kBoxOrWall };

  Word wordFrom(std::size_t at, std::size_t& end) const;
  Word take();
  [[noreturn]] void fail(const Word& found, const std::string& expected) const;
  void expect(std::string_view mark);
  std::string known(Whom whom) const;
  Partner takeNamed(Whom whom);
  double takeNumber();
  void readComparison(const Word& quantity);
  void readContact();

  const std::string& text_;
  const World& world_;
  std::size_t end_ = 0;  // of the word that is next
  Word next_;
  Question question_;
};

Word QuestionReader::wordFrom(std::size_t at, std::size_t& end) const {
  constexpr std::string_view kBlanks = " \t\r\n";
  constexpr std::string_view kMarks = "(),<>";
  at = std::min(text_.find_first_not_of(kBlanks, at), text_.size());
  Word word{.text = {}, .at = at};
  end = at;
  if (at == text_.size()) {
    word.isEnd = true;
  } else if (text_[at] == '"' || text_[at] == '\'') {
    end = text_.find(text_[at], at + 1);
    if (end == std::string::npos) {
      word.text = text_.substr(at);
      fail(word, std::string("another ") + text_[at] + " where the name ends");
    }
    word.text = text_.substr(at + 1, end - at - 1);
    word.isQuoted = true;
    ++end;
  } else {
    end = kMarks.find(text_[at]) != std::string_view::npos
              ? at + 1
              : std::min(text_.find_first_of(" \t\r\n(),<>\"'", at), text_.size());
    word.text = text_.substr(at, end - at);
  }
  return word;
}

Word QuestionReader::take() {
  Word taken = std::move(next_);
  next_ = wordFrom(end_, end_);
  return taken;
}

void QuestionReader::fail(const Word& found, const std::string& expected) const {
  const std::size_t column = charactersOf(std::string_view(text_).substr(0, found.at)).size() + 1;
  throw InputError("question '" + text_ + "', column " + std::to_string(column) + ": found " +
                   (found.isEnd ? "its end" : "'" + found.text + "'") + ", expected " + expected);
}

void QuestionReader::expect(std::string_view mark) {
  if (!next_.is(mark)) {
    fail(next_, "'" + std::string(mark) + "'");
  }
  take();
}

std::string QuestionReader::known(Whom whom) const {
  std::vector<std::string_view> names;
  for (const Body& body : world_.bodies) {
    names.emplace_back(body.name);
  }
  for (std::size_t wall = 0; wall < world_.walls.size() && whom == Whom::kBoxOrWall; ++wall) {
    names.emplace_back(world_.walls[wall].name);
  }
  const std::size_t count = names.size();
  names.resize(std::min(count, kMostNames));
  return std::string(whom == Whom::kBox ? "a box" : "a box or wall") + ": " + listed(names) +
         (count > kMostNames ? " and " + std::to_string(count - kMostNames) + " more" : "");
}

Partner QuestionReader::takeNamed(Whom whom) {
  const auto placeIn = [&](const auto& things) -> std::optional<std::size_t> {
    const auto found = std::find_if(things.begin(), things.end(),
                                    [&](const auto& thing) { return thing.name == next_.text; });
    return found == things.end() ? std::nullopt
                                 : std::optional(static_cast<std::size_t>(found - things.begin()));
  };
  std::optional<Partner> named;
  if (const std::optional<std::size_t> body = placeIn(world_.bodies); body && !next_.isEnd) {
    named = Partner::ofBody(static_cast<int>(*body));
  } else if (const std::optional<std::size_t> wall = placeIn(world_.walls);
             wall && !next_.isEnd && whom == Whom::kBoxOrWall) {
    named = Partner::ofWall(*wall);
  }
  if (!named) {
    fail(next_, known(whom));
  }
  take();
  return *named;
}

double QuestionReader::takeNumber() {
  double number = 0;
  const std::string& text = next_.text;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (next_.isQuoted || error != std::errc() || end != text.data() + text.size() || !std::isfinite(number)) {
    fail(next_, "a number");
  }
  take();
  return number;
}

// After its name: (a) < 3
void QuestionReader::readComparison(const Word& quantity) {
  const auto name = std::find(kQuantityNames.begin(), kQuantityNames.end(), quantity.text);
  if (name == kQuantityNames.end()) {
    fail(quantity, "one of: " + listed(kQuantityNames) + ", rest");
  }
  question_.quantity = static_cast<Quantity>(name - kQuantityNames.begin());
  expect("(");
  question_.of.push_back(takeNamed(Whom::kBox));
  if (question_.quantity == Quantity::kDistance) {
    expect(",");
    question_.of.push_back(takeNamed(Whom::kBox));
  }
  expect(")");
  if (!next_.is("<") && !next_.is(">")) {
    fail(next_, "'<' or '>'");
  }
  question_.kind = take().text == "<" ? Question::Kind::kBelow : Question::Kind::kAbove;
  question_.level = takeNumber();
}

void QuestionReader::readContact() {
  question_.of.push_back(takeNamed(Whom::kBoxOrWall));
  if (!next_.is("touches") && !next_.is("leaves")) {
    fail(next_, "'touches' or 'leaves'");
  }
  question_.kind = take().text == "touches" ? Question::Kind::kTouches : Question::Kind::kLeaves;
  if (next_.is("anything")) {
    take();
    return;
  }
  if (next_.isEnd) {
    return;
  }
  const Word second = next_;
  question_.of.push_back(takeNamed(question_.of.front().isWall() ? Whom::kBox : Whom::kBoxOrWall));
  if (question_.of[0] == question_.of[1]) {
    fail(second, "another than itself");
  }
  if (question_.of[0].isWall()) {
    std::swap(question_.of[0], question_.of[1]);
  }
}

Question QuestionReader::read() {
  question_.text = text_;
  std::size_t end = end_;
  const Word after = wordFrom(end_, end);
  if (next_.is("rest") && (after.is("(") || after.isEnd)) {
    take();
    if (!next_.isEnd) {
      expect("(");
      question_.of.push_back(takeNamed(Whom::kBox));
      expect(")");
    }
  } else if (!next_.isQuoted && after.is("(")) {
    readComparison(take());
  } else {
    if (next_.isEnd) {
      fail(next_, "a statement, such as 'a touches b', 'height(a) < 0.5' or 'rest'");
    }
    readContact();
  }
  if (!next_.isEnd) {
    fail(next_, "its end");
  }
  return question_;
}

}  // namespace

Question readQuestion(const std::string& text, const World& world) {
  return QuestionReader(text, world).read();
}

const std::string& nameOf(Partner partner, const World& world) {
  return partner.isWall() ? world.walls.at(partner.wall()).name
                          : world.bodies.at(static_cast<std::size_t>(partner.body())).name;
}

}  // namespace careen
