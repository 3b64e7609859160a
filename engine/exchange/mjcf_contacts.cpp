#include "exchange/mjcf_contacts.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "core/brief.h"
#include "exchange/friction_fit.h"
#include "scene/json_tree.h"

namespace careen {
namespace {

class ContactReader {
 public:
  ContactReader(MjcfDocument& document, const MjcfModel& model, FilterParent filterParent)
      : document_(document), surfaces_(model.surfaces), model_(model), filterParent_(filterParent) {
    for (std::size_t i = 0; i < surfaces_.size(); ++i) {
      const MjcfSurface& surface = surfaces_[i];
      for (std::size_t part = 0; part < surface.geomCount(); ++part) {
        byGeom_.emplace(surface.parts.empty() ? surface.geom.name : surface.parts[part].name, i);
      }
    }
  }

  MjcfContacts read() {
    for (const XmlElement* const contacts : document_.sections("contact")) {
      for (const XmlElement& each : contacts->children) {
        if (each.name == "pair") {
          readPair(each);
        }
      }
    }
    checkPairs();
    passThroughJoined();
    for (const XmlElement* const contacts : document_.sections("contact")) {
      for (const XmlElement& each : contacts->children) {
        if (each.name == "exclude") {
          readExclude(each);
        } else if (each.name != "pair") {
          document_.fail(each, "<" + each.name + "> in <contact>", "<pair> or <exclude>");
        }
      }
    }
    fitFriction();
    return std::move(contacts_);
  }

 private:
  using Pair = std::pair<std::size_t, std::size_t>;

  // ---- Pairs

  void readPair(const XmlElement& pair) {
    document_.check(pair, {"name", "geom1", "geom2", "condim", "friction"},
                    {"solref", "solreffriction", "solimp", "margin", "gap"});
    std::array<std::size_t, 2> ends{};
    for (const std::size_t k : {0U, 1U}) {
      const char* const attribute = k == 0 ? "geom1" : "geom2";
      const auto found = byGeom_.find(pair.text(attribute));
      if (found == byGeom_.end() || found->first.empty()) {
        document_.fail(pair, inQuotes(pair.text(attribute)) + " for " + attribute, "the name of a <geom>");
      }
      ends[k] = found->second;
    }
    const std::vector<double> friction = document_.numbers(pair, "friction", 1, 5);
    const double usual = ownFriction(ends[0], ends[1]);
    const double sliding = friction.empty() ? usual : friction[0];
    if (sliding < 0 || (friction.size() > 1 && friction[1] != sliding)) {
      document_.fail(pair, *pair.find("friction"), "the same friction in all directions, not below 0");
    }
    if (ends[0] == ends[1]) {
      document_.ignore("pair of one body");
      return;
    }
    const int most = std::max(surfaces_[ends[0]].geom.condim, surfaces_[ends[1]].geom.condim);
    const double found = document_.integer(pair, "condim", most) == 1 ? 0 : sliding;
    const Pair bodies = std::minmax(ends[0], ends[1]);
    NamedGeoms& named = named_[bodies];
    if (named.last != nullptr && geomPairs(bodies) > 1 && pairs_[bodies] != found) {
      document_.fail(pair,
                     "a friction of " + brief(found) + " where other geoms of the two bodies have " +
                         brief(pairs_[bodies]),
                     "one for all geoms of two bodies");
    }
    named.last = &pair;
    named.geoms.insert(std::minmax(pair.text("geom1"), pair.text("geom2")));
    pairs_[bodies] = found;
  }

  std::size_t geomPairs(const Pair& bodies) const {
    return surfaces_[bodies.first].geomCount() * surfaces_[bodies.second].geomCount();
  }

  // Those of their geoms that no <pair> names would touch otherwise.
  void checkPairs() const {
    for (const auto& [bodies, named] : named_) {
      if (named.geoms.size() < geomPairs(bodies)) {
        document_.fail(*named.last,
                       std::to_string(named.geoms.size()) + " pairs of geoms of " +
                           inQuotes(surfaces_[bodies.first].name) + " and " +
                           inQuotes(surfaces_[bodies.second].name),
                       "none, or all " + std::to_string(geomPairs(bodies)));
      }
    }
  }

  // ---- What passes through each other

  void passThrough(std::size_t a, std::size_t b, const XmlElement& why) {
    const Pair pair = std::minmax(a, b);
    if (a == b || pairs_.contains(pair) || !(surfaces_[a].movable || surfaces_[b].movable)) {
      return;
    }
    for (const std::size_t each : {a, b}) {
      if (surfaces_[each].isPlane()) {
        document_.fail(why,
                       inQuotes(surfaces_[a].name) + ", which goes through " + inQuotes(surfaces_[b].name) +
                           " (contype, conaffinity or <exclude>)",
                       "walls that nothing goes through");
      }
    }
    contacts_.apart.insert(pair);
  }

  // Boxes of bodies without a joint between them are one body to MuJoCo.
  void passThroughJoined() {
    std::map<std::size_t, std::vector<std::size_t>> groups;  // by the first of each
    std::vector<std::size_t> groupOf(surfaces_.size());
    for (std::size_t i = 0; i < surfaces_.size(); ++i) {
      const MjcfSurface& surface = surfaces_[i];
      const bool isInOther = surface.movable && surface.parent && surfaces_[*surface.parent].movable;
      groupOf[i] = isInOther && surface.joint.type == "fixed" ? groupOf[*surface.parent] : i;
      if (!surface.movable) {
        continue;
      }
      for (const std::size_t other : groups[groupOf[i]]) {
        passThrough(other, i, *surface.geom.element);
      }
      groups[groupOf[i]].push_back(i);
    }
    for (const auto& [first, members] : groups) {
      const std::optional<std::size_t> parent = surfaces_[first].parent;
      if (filterParent_ == FilterParent::kYes && parent && surfaces_[*parent].movable) {
        for (const std::size_t one : members) {
          for (const std::size_t other : groups[groupOf[*parent]]) {
            passThrough(other, one, *surfaces_[one].geom.element);
          }
        }
      }
    }
  }

  void readExclude(const XmlElement& exclude) {
    document_.check(exclude, {"name", "body1", "body2"});
    std::array<std::vector<std::size_t>, 2> ends;
    for (const std::size_t k : {0U, 1U}) {
      const char* const attribute = k == 0 ? "body1" : "body2";
      const std::string name = exclude.text(attribute);
      if (!model_.bodies.contains(name)) {
        document_.fail(exclude, inQuotes(name) + " for " + attribute, "the name of a <body>");
      }
      for (std::size_t i = 0; i < surfaces_.size(); ++i) {
        if (surfaces_[i].ofBody == name) {
          ends[k].push_back(i);
        }
      }
    }
    for (const std::size_t one : ends[0]) {
      for (const std::size_t other : ends[1]) {
        passThrough(one, other, exclude);
      }
    }
  }

  // A pair that is named collides whatever its bits are.
  void readBits() {
    for (std::size_t i = 0; i < surfaces_.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const auto bits = [](int value) { return static_cast<unsigned>(value); };
        const MjcfGeom& a = surfaces_[i].geom;
        const MjcfGeom& b = surfaces_[j].geom;
        if (((bits(a.contype) & bits(b.conaffinity)) | (bits(b.contype) & bits(a.conaffinity))) == 0) {
          passThrough(i, j, *a.element);
        }
      }
    }
  }

  // ---- Friction

  double ownFriction(std::size_t i, std::size_t j) const {
    const MjcfGeom& a = surfaces_[i].geom;
    const MjcfGeom& b = surfaces_[j].geom;
    if (a.priority != b.priority) {
      const MjcfGeom& counts = a.priority > b.priority ? a : b;
      return counts.condim == 1 ? 0 : counts.friction;
    }
    return std::max(a.condim, b.condim) == 1 ? 0 : std::max(a.friction, b.friction);
  }

  void fitFriction() {
    const auto likeFirst = [this](const MjcfSurface& each) {
      const MjcfGeom& one = surfaces_[0].geom;
      const MjcfGeom& other = each.geom;
      return one.friction == other.friction && one.condim == other.condim && one.priority == other.priority &&
             other.contype == 1 && other.conaffinity == 1;
    };
    std::vector<double> own;
    std::vector<bool> movable;
    for (const MjcfSurface& each : surfaces_) {
      own.push_back(each.geom.condim == 1 ? 0 : each.geom.friction);
      movable.push_back(each.movable);
    }
    contacts_.frictions = own;
    if (pairs_.empty() && std::all_of(surfaces_.begin(), surfaces_.end(), likeFirst)) {
      return;
    }
    const auto moving = static_cast<std::size_t>(std::count(movable.begin(), movable.end(), true));
    if (moving * surfaces_.size() > kMostImportedPairs) {
      document_.fail(
          document_.root(),
          "geoms of different friction in more than " + std::to_string(kMostImportedPairs) + " pairs",
          "fewer, or one friction for all");
    }
    readBits();
    const FrictionFit fit = fitFrictions(own, movable, [this](std::size_t i, std::size_t j) {
      const Pair ends = std::minmax(i, j);
      const auto pair = pairs_.find(ends);
      return contacts_.apart.contains(ends) ? std::numeric_limits<double>::quiet_NaN()
             : pair == pairs_.end()         ? ownFriction(i, j)
                                            : pair->second;
    });
    if (fit.misfit) {
      const MjcfSurface& a = surfaces_[fit.misfit->first];
      const MjcfSurface& b = surfaces_[fit.misfit->second];
      document_.fail(*b.geom.element,
                     "frictions of pairs, as of " + inQuotes(a.name) + " and " + inQuotes(b.name) +
                         ", that no coefficients of the boxes and walls give",
                     "those of a scene: the friction of each pair is sqrt(μ₁ μ₂)");
    }
    contacts_.isRefitted = fit.coefficients != own;
    contacts_.frictions = fit.coefficients;
  }

  MjcfDocument& document_;
  const std::vector<MjcfSurface>& surfaces_;
  const MjcfModel& model_;
  FilterParent filterParent_;
  MjcfContacts contacts_;
  std::map<std::string, std::size_t> byGeom_;
  std::map<Pair, double> pairs_;  // friction
  /// What <pair> names of two bodies.
  struct NamedGeoms {
    std::set<std::pair<std::string, std::string>> geoms;
    const XmlElement* last = nullptr;
  };
  std::map<Pair, NamedGeoms> named_;
};

}  // namespace

MjcfContacts readContacts(MjcfDocument& document, const MjcfModel& model, FilterParent filterParent) {
  return ContactReader(document, model, filterParent).read();
}

}  // namespace careen
