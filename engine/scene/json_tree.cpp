#include "scene/json_tree.h"

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <unordered_set>
#include <utility>

#include "core/error.h"
#include "scene/json_cursor.h"

namespace careen {
namespace {

using Json = nlohmann::json;
using Kind = JsonNode::Kind;

constexpr std::size_t kDeepest = 64;
constexpr std::size_t kLongestQuote = 40;  // bytes
constexpr int kNumberOverflows = 406;      // error id of nlohmann-json

bool continuesCharacter(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

// The letters, digits and signs from `offset` on: a number, a literal, or an attempt at one.
std::string wordAt(std::string_view text, std::size_t offset) {
  std::size_t end = offset;
  while (end < text.size() && (std::isalnum(static_cast<unsigned char>(text[end])) != 0 ||
                               std::string_view("_+-.").find(text[end]) != std::string_view::npos)) {
    ++end;
  }
  return std::string(text.substr(offset, end - offset));
}

bool isNotFinite(std::string word) {
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  word.erase(0, word.find_first_not_of("+-"));
  return word == "nan" || word == "inf" || word == "infinity";
}

// Describes the text where the parser stopped.
std::string describeToken(std::string_view text, std::size_t offset) {
  if (offset >= text.size()) {
    return "the end of the file";
  }
  if (text[offset] == '"') {
    return "a string";
  }
  if (text.substr(offset).starts_with("/*")) {
    return "a comment without its end";
  }
  const std::string word = wordAt(text, offset);
  if (!word.empty()) {
    return inQuotes(word);
  }
  return static_cast<unsigned char>(text[offset]) < 0x80 ? inQuotes(text.substr(offset, 1))
                                                         : "a character outside a string";
}

// Builds the tree from the parser's events; the cursor finds the position of each token.
class TreeBuilder : public nlohmann::json_sax<Json> {
 public:
  TreeBuilder(const JsonTree& tree, JsonNode& root) : tree_(tree), root_(root), cursor_(tree.text()) {}

  bool null() override {
    leaf(Kind::kNull);
    return true;
  }
  bool boolean(bool value) override {
    leaf(Kind::kBoolean).boolean = value;
    return true;
  }
  bool number_integer(number_integer_t value) override { return number(static_cast<double>(value)); }
  bool number_unsigned(number_unsigned_t value) override { return number(static_cast<double>(value)); }
  bool number_float(number_float_t value, const string_t& /*text*/) override { return number(value); }
  bool string(string_t& value) override {
    leaf(Kind::kString).text = value;
    return true;
  }
  bool binary(binary_t& /*value*/) override { return false; }  // no token of a JSON text produces it

  bool start_object(std::size_t /*size*/) override { return open(Kind::kObject); }
  bool start_array(std::size_t /*size*/) override { return open(Kind::kArray); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override;

  bool parse_error(std::size_t bytesRead, const std::string& lastToken,
                   const nlohmann::detail::exception& error) override;

 private:
  JsonNode& leaf(Kind kind);
  bool number(double value);
  bool open(Kind kind);
  bool close();
  struct Expectation {
    enum class Token { kValue, kKey, kPunctuation } token;
    std::string text;
  };
  Expectation expectedAfter(char separator) const;
  [[noreturn]] void failInString(std::size_t start, std::size_t offset) const;

  const JsonTree& tree_;
  JsonNode& root_;
  JsonCursor cursor_;
  std::vector<JsonNode*> open_;  // from the root to the innermost, the only one that grows
  std::vector<std::unordered_set<std::string>> keys_;  // of each of them
  bool begun_ = false;
  bool keyPending_ = false;  // the innermost object's last member has no value yet
};

JsonNode& TreeBuilder::leaf(Kind kind) {
  JsonNode* node = &root_;
  if (!open_.empty()) {
    std::vector<JsonNode>& siblings = open_.back()->children;
    node = keyPending_ ? &siblings.back() : &siblings.emplace_back();
  }
  begun_ = true;
  keyPending_ = false;
  node->kind = kind;
  node->offset = cursor_.next();
  return *node;
}

bool TreeBuilder::number(double value) {
  JsonNode& node = leaf(Kind::kNumber);
  node.number = value;
  node.text = wordAt(tree_.text(), node.offset);
  return true;
}

bool TreeBuilder::open(Kind kind) {
  JsonNode& node = leaf(kind);
  if (open_.size() == kDeepest) {
    tree_.fail(node.offset, "values nested deeper than " + std::to_string(kDeepest), "a flatter file");
  }
  open_.push_back(&node);
  keys_.emplace_back();
  return true;
}

bool TreeBuilder::close() {
  cursor_.next();
  open_.pop_back();
  keys_.pop_back();
  return true;
}

bool TreeBuilder::key(string_t& name) {
  const std::size_t offset = cursor_.next();
  if (!keys_.back().insert(name).second) {
    const JsonNode* const first = open_.back()->find(name);
    tree_.fail(offset, "the key " + inQuotes(name) + " again",
               "each key once; it stands at " + tree_.place(first->keyOffset) + " already");
  }
  JsonNode& member = open_.back()->children.emplace_back();
  member.key = name;
  member.keyOffset = offset;
  keyPending_ = true;
  return true;
}

TreeBuilder::Expectation TreeBuilder::expectedAfter(char separator) const {
  using enum Expectation::Token;
  if (!begun_) {
    return {kValue, "a JSON object"};
  }
  if (open_.empty()) {
    return {kPunctuation, "the end of the file"};
  }
  const bool empty = open_.back()->children.empty();
  if (open_.back()->kind == Kind::kArray) {
    return separator == ',' ? Expectation{kValue, "a value after the comma"}
           : empty          ? Expectation{kValue, "a value or ']'"}
                            : Expectation{kPunctuation, "',' or ']'"};
  }
  if (keyPending_) {
    return separator == ':' ? Expectation{kValue, "a value"} : Expectation{kPunctuation, "':'"};
  }
  return separator == ',' ? Expectation{kKey, "a key in quotes after the comma"}
         : empty          ? Expectation{kKey, "a key in quotes or '}'"}
                          : Expectation{kPunctuation, "',' or '}'"};
}

void TreeBuilder::failInString(std::size_t start, std::size_t offset) const {
  const std::string& text = tree_.text();
  if (offset >= text.size() || text[offset] == '\n' || text[offset] == '\r') {
    tree_.fail(start, "a string without its closing quote", "'\"' on the same line");
  }
  if (static_cast<unsigned char>(text[offset]) < 0x20) {
    tree_.fail(offset, "a control character in a string", "an escape such as \\t");
  }
  if (static_cast<unsigned char>(text[offset]) >= 0x80 ||
      static_cast<unsigned char>(text[offset - 1]) >= 0x80) {
    tree_.fail(offset, "a byte that is not UTF-8", "text in UTF-8");
  }
  tree_.fail(offset, "a wrong escape in a string", R"(one of \" \\ \/ \b \f \n \r \t \u0000)");
}

bool TreeBuilder::parse_error(std::size_t bytesRead, const std::string& /*lastToken*/,
                              const nlohmann::detail::exception& error) {
  const std::string& text = tree_.text();
  // The parser stopped after this byte; the token it rejected begins there or earlier.
  const std::size_t last = std::min(std::max<std::size_t>(bytesRead, 1) - 1, text.size());
  const JsonCursor::Gap gap = cursor_.gap(last);
  const std::size_t start = std::min(gap.end, last);
  const Expectation expected = expectedAfter(gap.separator);
  const std::string word = wordAt(text, start);
  if (error.id == kNumberOverflows) {
    tree_.fail(start, inQuotes(word), "a number no larger than 1.8e308");
  }
  if (expected.token == Expectation::Token::kValue && isNotFinite(word)) {
    tree_.fail(start, inQuotes(word), "a finite number");
  }
  if (expected.token != Expectation::Token::kPunctuation && start < text.size() && text[start] == '"') {
    failInString(start, last);
  }
  tree_.fail(start, describeToken(text, start), expected.text);
}

}  // namespace

const JsonNode* JsonNode::find(std::string_view name) const {
  const auto child = std::find_if(children.begin(), children.end(),
                                  [name](const JsonNode& each) { return each.key == name; });
  return kind == Kind::kObject && child != children.end() ? &*child : nullptr;
}

JsonTree::JsonTree(std::string text, std::string name) : text_(std::move(text)), name_(std::move(name)) {
  // The parser would take a zero byte for the end of the text.
  const std::size_t zero = text_.find('\0');
  if (zero != std::string::npos) {
    fail(zero, "a zero byte", "JSON text");
  }
  TreeBuilder builder(*this, root_);
  Json::sax_parse(text_, &builder, Json::input_format_t::json, true, true);
}

std::string JsonTree::place(std::size_t offset) const { return placeIn(text_, offset); }

std::string placeIn(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, offset);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  std::string_view inLine = before.substr(before.rfind('\n') + 1);
  if (line == 1 && inLine.starts_with(kByteOrderMark)) {
    inLine.remove_prefix(kByteOrderMark.size());
  }
  const auto column =
      1 + std::count_if(inLine.begin(), inLine.end(), [](char c) { return !continuesCharacter(c); });
  return std::to_string(line) + ":" + std::to_string(column);
}

void JsonTree::fail(std::size_t offset, const std::string& found, const std::string& expected) const {
  throw InputError(name_ + ":" + place(offset) + ": found " + found + ", expected " + expected);
}

std::string describe(const JsonNode& node) {
  switch (node.kind) {
    case Kind::kNull:
      return "null";
    case Kind::kBoolean:
      return node.boolean ? "true" : "false";
    case Kind::kNumber:
      return node.text.substr(0, kLongestQuote);
    case Kind::kString:
      return inQuotes(node.text);
    case Kind::kArray:
      return "an array of " + std::to_string(node.children.size());
    case Kind::kObject:
      return "an object";
  }
  return {};
}

std::string inQuotes(std::string_view text) {
  std::string_view shown = text.substr(0, kLongestQuote);
  if (shown.size() < text.size()) {
    while (!shown.empty() && continuesCharacter(text[shown.size()])) {
      shown.remove_suffix(1);
    }
  }
  std::string result = "\"";
  for (const char c : shown) {
    result += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  }
  return result + (shown.size() < text.size() ? "…\"" : "\"");
}

}  // namespace careen
