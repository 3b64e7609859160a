#include "sweep/family.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <utility>

#include "core/brief.h"
#include "core/error.h"
#include "core/math/elementary.h"
#include "scene/scene_reader.h"

namespace careen {
namespace {

using Kind = JsonNode::Kind;

constexpr std::array<std::string_view, 7> kDistributions = {
    "uniform", "uniform_integer", "normal", "log_uniform", "choice", "unit_vector", "rotation"};
constexpr std::int64_t kMostCopies = 10'000;
constexpr std::size_t kMostBoxesTried = 200'000;  // in all attempts at one run: a minute
constexpr double kLargest = 1e15;                 // of whole numbers

bool isDistributionKey(const std::string& key) {
  return std::find(kDistributions.begin(), kDistributions.end(), key) != kDistributions.end();
}
// Other objects have such a key too: walls have a normal.
bool isDistribution(const JsonNode& node) {
  return node.kind == Kind::kObject && node.children.size() == 1 &&
         isDistributionKey(node.children.front().key);
}

bool holdsDistribution(const JsonNode& node) {
  return isDistribution(node) || node.key == "count" ||
         std::any_of(node.children.begin(), node.children.end(), holdsDistribution);
}

std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

/// Writes the scene of one run while it draws.
class FamilyWriter {
 public:
  FamilyWriter(const JsonTree& tree, RandomStream& random, std::vector<double>* drawn,
               std::vector<Varying>* varying)
      : tree_(tree), random_(random), drawn_(drawn), varying_(varying) {}

  std::string scene() {
    if (tree_.root().kind != Kind::kObject) {
      tree_.fail(tree_.root().offset, describe(tree_.root()), "an object: a scene");
    }
    std::string text = "{";
    for (const JsonNode& member : tree_.root().children) {
      if (member.key == "sweep") {
        continue;
      }
      text += text.size() == 1 ? "\n" : ",\n";
      text += quoted(member.key) + ": ";
      if (member.key == "boxes" && member.kind == Kind::kArray) {
        text += boxes(member);
      } else {
        text += value(member, member.key);
      }
    }
    return text + "\n}\n";
  }

 private:
  std::string boxes(const JsonNode& list) {
    inBoxes_ = true;
    std::string text = "[";
    for (std::size_t i = 0; i < list.children.size(); ++i) {
      const JsonNode& box = list.children[i];
      const std::string path = "boxes[" + std::to_string(i) + "]";
      const JsonNode* const count = box.find("count");
      std::int64_t copies = count == nullptr ? 1 : countOf(*count, path + ".count");
      copies = varying_ != nullptr ? std::max<std::int64_t>(copies, 1) : copies;  // to tell what varies
      for (std::int64_t copy = 1; copy <= copies; ++copy) {
        text += text.size() == 1 ? "\n  " : ",\n  ";
        text += count == nullptr ? value(box, path) : copyOf(box, copy, path);
        quiet_ = true;  // of copies, the first says what varies
      }
      quiet_ = false;
    }
    inBoxes_ = false;
    return text + "\n]";
  }

  std::int64_t countOf(const JsonNode& node, const std::string& path) {
    const std::optional<double> number = isDistribution(node)         ? drawNumber(node, path)
                                         : node.kind == Kind::kNumber ? std::optional(node.number)
                                                                      : std::nullopt;
    if (!number || !(*number >= 0 && *number <= kMostCopies) || *number != std::floor(*number)) {
      tree_.fail(node.offset, (number ? brief(*number) : describe(node)) + " for count",
                 "a whole number from 0 to " + std::to_string(kMostCopies) + ", or a distribution of one");
    }
    return static_cast<std::int64_t>(*number);
  }

  std::string copyOf(const JsonNode& box, std::int64_t copy, const std::string& path) {
    const JsonNode* const name = box.find("name");
    const bool isNamed = name != nullptr && name->kind == Kind::kString;
    std::string text = "{";
    for (const JsonNode& member : box.children) {
      if (member.key == "count") {
        continue;
      }
      text += text.size() == 1 ? "" : ", ";
      text += quoted(member.key) + ": ";
      text += &member == name && isNamed ? quoted(name->text + "-" + std::to_string(copy))
                                         : value(member, path + "." + member.key);
    }
    return text + "}";
  }

  std::string value(const JsonNode& node, const std::string& path) {
    switch (node.kind) {
      case Kind::kNull:
        return "null";
      case Kind::kBoolean:
        return node.boolean ? "true" : "false";
      case Kind::kNumber:
        return node.text;
      case Kind::kString:
        return quoted(node.text);
      case Kind::kArray: {
        std::string text = "[";
        for (std::size_t i = 0; i < node.children.size(); ++i) {
          text += (i == 0 ? "" : ", ") + value(node.children[i], path + "[" + std::to_string(i) + "]");
        }
        return text + "]";
      }
      case Kind::kObject:
        break;
    }
    if (isDistribution(node)) {
      return draw(node, path);
    }
    std::string text = "{";
    for (const JsonNode& member : node.children) {
      text +=
          (text.size() == 1 ? "" : ", ") + quoted(member.key) + ": " + value(member, path + "." + member.key);
    }
    return text + "}";
  }

  // ---- Distributions

  void note(const std::string& path, const std::string& range) {
    if (varying_ != nullptr && !quiet_) {
      varying_->push_back({.path = path, .range = range, .inBoxes = inBoxes_});
    }
  }
  std::string kept(const std::string& path, double number, const std::string& range) {
    note(path, range);
    if (drawn_ != nullptr && !inBoxes_) {
      drawn_->push_back(number);
    }
    return inFull(number);
  }

  std::pair<double, double> pairOf(const JsonNode& node, const char* expected) const {
    if (node.kind != Kind::kArray || node.children.size() != 2 || node.children[0].kind != Kind::kNumber ||
        node.children[1].kind != Kind::kNumber) {
      tree_.fail(node.offset, describe(node) + " for " + node.key, expected);
    }
    return {node.children[0].number, node.children[1].number};
  }
  [[noreturn]] void failPair(const JsonNode& node, const char* expected) const {
    tree_.fail(node.offset, "[" + node.children[0].text + ", " + node.children[1].text + "] for " + node.key,
               expected);
  }

  // The number of a distribution that has one; none of one that has vectors or other values.
  std::optional<double> drawNumber(const JsonNode& node, const std::string& path) {
    const JsonNode& is = node.children.front();
    if (is.key == "uniform") {
      const auto [from, to] = pairOf(is, "[least, most]");
      if (from > to) {
        failPair(is, "the smaller number first");
      }
      const double number = random_.uniform(from, to);
      kept(path, number, "uniform " + brief(from) + " to " + brief(to));
      return number;
    }
    if (is.key == "uniform_integer") {
      const auto [from, to] = pairOf(is, "[least, most]");
      if (!(from <= to) || from != std::floor(from) || to != std::floor(to) || std::abs(from) > kLargest ||
          std::abs(to) > kLargest || to - from > 4e9) {
        failPair(is, "two whole numbers, the smaller one first");
      }
      const auto number = static_cast<double>(
          random_.integer(static_cast<std::int64_t>(from), static_cast<std::int64_t>(to)));
      kept(path, number, "whole number " + brief(from) + " to " + brief(to));
      return number;
    }
    if (is.key == "normal") {
      const auto [mean, deviation] = pairOf(is, "[mean, standard deviation]");
      if (!(deviation >= 0)) {
        failPair(is, "a standard deviation not below 0");
      }
      const double number = mean + deviation * random_.normal();
      kept(path, number, "normal " + brief(mean) + " ± " + brief(deviation));
      return number;
    }
    if (is.key == "log_uniform") {
      const auto [from, to] = pairOf(is, "[least, most]");
      if (!(from > 0 && from <= to)) {
        failPair(is, "two numbers above 0, the smaller one first");
      }
      const double low = elementary::log(from);
      const double number =
          std::clamp(elementary::exp(low + random_.unit() * (elementary::log(to) - low)), from, to);
      kept(path, number, "log-uniform " + brief(from) + " to " + brief(to));
      return number;
    }
    return std::nullopt;
  }

  std::string draw(const JsonNode& node, const std::string& path) {
    const JsonNode& is = node.children.front();
    if (const std::optional<double> number = drawNumber(node, path)) {
      return inFull(*number);
    }
    if (is.key == "choice") {
      if (is.kind != Kind::kArray || is.children.empty()) {
        tree_.fail(is.offset, describe(is) + " for choice", "an array of one or more values");
      }
      // All of them are drawn, so that what follows does not depend on which is taken.
      const std::int64_t taken = random_.integer(0, static_cast<std::int64_t>(is.children.size()) - 1);
      kept(path, static_cast<double>(taken), "one of " + std::to_string(is.children.size()));
      std::string chosen;
      for (std::size_t i = 0; i < is.children.size(); ++i) {
        std::string each = value(is.children[i], path + ".choice[" + std::to_string(i) + "]");
        if (static_cast<std::int64_t>(i) == taken) {
          chosen = std::move(each);
        }
      }
      return chosen;
    }
    if (is.key == "unit_vector") {
      const std::optional<double> length = is.kind == Kind::kNumber ? std::optional(is.number)
                                           : isDistribution(is)     ? drawNumber(is, path + ".length")
                                                                    : std::nullopt;
      if (!length) {
        tree_.fail(is.offset, describe(is) + " for unit_vector",
                   "its length, a number or a distribution of one");
      }
      const Vec3 vector = *length * random_.direction();
      std::string text;
      for (int k = 0; k < 3; ++k) {
        text += (k == 0 ? "[" : ", ") +
                kept(path + "[" + std::to_string(k) + "]", vector[k], "of a vector in any direction");
      }
      return text + "]";
    }
    if (is.kind != Kind::kString || is.text != "uniform") {
      tree_.fail(is.offset, describe(is) + " for rotation", "\"uniform\"");
    }
    const Quat q = random_.rotation();
    std::string text;
    int part = 0;
    for (const double number : {q.w(), q.x(), q.y(), q.z()}) {
      text += (part == 0 ? "[" : ", ") +
              kept(path + "[" + std::to_string(part) + "]", number, "of any orientation");
      ++part;
    }
    return text + "]";
  }

  const JsonTree& tree_;
  RandomStream& random_;
  std::vector<double>* drawn_;
  std::vector<Varying>* varying_;
  bool inBoxes_ = false;
  bool quiet_ = false;
};

Family::Family(std::string text, std::string name) : tree_(std::move(text), name), name_(std::move(name)) {
  readSettings();
  RandomStream random(seed_, 0, 0);
  FamilyWriter(tree_, random, nullptr, &varying_).scene();
  static_cast<void>(member(0));
}

void Family::readSettings() {
  const JsonNode* const settings = tree_.root().find("sweep");
  if (settings == nullptr) {
    return;
  }
  if (settings->kind != Kind::kObject) {
    tree_.fail(settings->offset, describe(*settings) + " for sweep", "an object");
  }
  for (const JsonNode& member : settings->children) {
    const double most = member.key == "seed" ? 9007199254740992.0 : 1e6;
    if (member.key != "seed" && member.key != "tries") {
      tree_.fail(member.keyOffset, "the unknown key " + quoted(member.key) + " in sweep", "seed or tries");
    }
    if (member.kind != Kind::kNumber || member.number != std::floor(member.number) ||
        !(member.number >= (member.key == "seed" ? 0 : 1) && member.number <= most)) {
      tree_.fail(member.offset, describe(member) + " for " + member.key,
                 member.key == "seed" ? "a whole number from 0 to 2^53" : "a whole number from 1 to 1000000");
    }
    if (member.key == "seed") {
      seed_ = static_cast<std::uint64_t>(member.number);
    } else {
      tries_ = static_cast<int>(member.number);
    }
  }
}

Family::Member Family::member(std::uint64_t run) const {
  const std::string name = name_ + " (run " + std::to_string(run) + ")";
  std::string why;
  std::size_t boxesTried = 0;
  int attempt = 0;
  for (; attempt < tries_ && boxesTried < kMostBoxesTried; ++attempt) {
    RandomStream random(seed_, run, static_cast<std::uint64_t>(attempt));
    Member member;
    const std::string text = FamilyWriter(tree_, random, &member.drawn, nullptr).scene();
    try {
      member.scene = parseScene(text, name);
      member.attempts = attempt + 1;
      return member;
    } catch (const InputError& error) {
      // What else is wrong stays wrong.
      boxesTried += parseScene(text, name, Starts::kMayOverlap).boxes.size();
      why = error.what();
    }
  }
  throw InputError(name + ": found no start without overlap in " + std::to_string(attempt) +
                   " tries, expected one; the last: " + why);
}

std::vector<std::string> Family::columns() const {
  std::vector<std::string> paths;
  for (const Varying& each : varying_) {
    if (!each.inBoxes) {
      paths.push_back(each.path);
    }
  }
  return paths;
}

bool looksLikeFamily(const std::string& text) {
  try {
    const JsonTree tree(text, "");
    return tree.root().find("sweep") != nullptr || holdsDistribution(tree.root());
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace careen
