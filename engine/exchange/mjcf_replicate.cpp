#include "exchange/mjcf_replicate.h"

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/brief.h"
#include "scene/json_tree.h"

namespace careen {
namespace {

std::string textOf(const Vec3& v) { return inFull(v.x()) + " " + inFull(v.y()) + " " + inFull(v.z()); }

std::size_t sizeOf(const XmlElement& element) {
  std::size_t size = 1;
  for (const XmlElement& child : element.children) {
    size += sizeOf(child);
  }
  return size;
}

void appendTo(XmlElement& element, std::string_view attribute, const std::string& suffix) {
  for (XmlAttribute& each : element.attributes) {
    if (each.name == attribute) {
      each.value += suffix;
    }
  }
}

void nameWith(XmlElement& element, const std::string& suffix) {
  appendTo(element, "name", suffix);
  for (XmlElement& child : element.children) {
    nameWith(child, suffix);
  }
}

/// Names of geoms and sites in an element.
struct CopiedNames {
  std::set<std::string> geoms;
  std::set<std::string> sites;

  void add(const XmlElement& element) {
    if (element.name == "geom" && element.find("name") != nullptr) {
      geoms.insert(element.text("name"));
    } else if (element.name == "site" && element.find("name") != nullptr) {
      sites.insert(element.text("name"));
    }
    for (const XmlElement& child : element.children) {
      add(child);
    }
  }
};

class Replicator {
 public:
  explicit Replicator(MjcfDocument& document) : document_(document) {}

  void expandAll() {
    for (XmlElement& section : document_.root().children) {
      if (section.name == "worldbody") {
        expand(section);
      }
    }
  }

 private:
  // The innermost first, whose numbers come first in names.
  void expand(XmlElement& parent) {
    std::vector<XmlElement> children;
    children.reserve(parent.children.size());
    for (XmlElement& child : parent.children) {
      expand(child);
      if (child.name == "replicate") {
        addCopies(child, children);
      } else {
        children.push_back(std::move(child));
      }
    }
    parent.children = std::move(children);
  }

  void addCopies(const XmlElement& element, std::vector<XmlElement>& children) {
    document_.check(element, {"count", "offset", "euler", "sep", "childclass"});
    const XmlAttribute* const counted = element.find("count");
    if (counted == nullptr) {
      document_.fail(element, "<replicate> without count", "one");
    }
    const int count = document_.integer(element, "count", 0);
    if (count < 1) {
      document_.fail(element, *counted, "a number above 0");
    }
    refuseParts(element);
    makes(sizeOf(element) * static_cast<std::size_t>(count), element);
    const Vec3 offset = document_.vector(element, "offset", Vec3::Zero());
    const Vec3 angles = document_.vector(element, "euler", Vec3::Zero());
    const std::size_t digits = std::to_string(count).size();
    std::vector<std::string> suffixes;
    Vec3 place = Vec3::Zero();
    for (int i = 0; i < count; ++i) {
      const std::string number = std::to_string(i);
      suffixes.push_back(element.text("sep") + std::string(digits - number.size(), '0') + number);
      XmlElement frame{.name = "frame", .offset = element.offset, .attributes = {}, .children = {}};
      frame.attributes.push_back({.name = "pos", .value = textOf(place), .offset = counted->offset});
      frame.attributes.push_back({.name = "euler", .value = textOf(i * angles), .offset = counted->offset});
      if (const XmlAttribute* const childClass = element.find("childclass")) {
        frame.attributes.push_back(*childClass);
      }
      place += document_.orientation(frame, Quat::Identity()) * offset;
      for (const XmlElement& child : element.children) {
        frame.children.push_back(child);
        nameWith(frame.children.back(), suffixes.back());
      }
      children.push_back(std::move(frame));
    }
    copyReferences(element, suffixes);
  }

  void makes(std::size_t elements, const XmlElement& replicate) {
    made_ += elements;
    if (made_ > kMostReplicated) {
      document_.fail(replicate, *replicate.find("count"),
                     "at most " + std::to_string(kMostReplicated) + " elements in all copies together");
    }
  }

  // What is part of the body that the copies are in.
  void refuseParts(const XmlElement& element) const {
    for (const XmlElement& child : element.children) {
      if (child.name == "joint" || child.name == "freejoint" || child.name == "inertial") {
        document_.fail(child, "<" + child.name + "> in <replicate>", "it in a <body>");
      }
      if (child.name == "frame") {
        refuseParts(child);
      }
    }
  }

  void copyReferences(const XmlElement& copied, const std::vector<std::string>& suffixes) {
    CopiedNames names;
    names.add(copied);
    for (XmlElement& section : document_.root().children) {
      if (section.name != "contact" && section.name != "tendon") {
        continue;
      }
      std::vector<XmlElement> children;
      for (XmlElement& child : section.children) {
        if (!isOf(names, child)) {
          children.push_back(std::move(child));
          continue;
        }
        makes(sizeOf(child) * suffixes.size(), copied);
        for (const std::string& suffix : suffixes) {
          children.push_back(child);
          nameWith(children.back(), suffix);
          appendTo(children.back(), "geom1", suffix);
          appendTo(children.back(), "geom2", suffix);
          for (XmlElement& end : children.back().children) {
            appendTo(end, "site", suffix);
          }
        }
      }
      section.children = std::move(children);
    }
  }

  // Whether it names what is copied.
  bool isOf(const CopiedNames& names, const XmlElement& element) const {
    std::size_t inside = 0;
    std::size_t all = 0;
    const auto count = [&](const XmlElement& of, std::string_view attribute,
                           const std::set<std::string>& among) {
      if (of.find(attribute) != nullptr) {
        ++all;
        inside += among.contains(of.text(attribute)) ? 1 : 0;
      }
    };
    count(element, "geom1", names.geoms);
    count(element, "geom2", names.geoms);
    for (const XmlElement& end : element.children) {
      count(end, "site", names.sites);
    }
    if (inside > 0 && inside < all) {
      document_.fail(element, "<" + element.name + "> of what is in a <replicate> and what is not",
                     "all in it, or none: MuJoCo makes no such copies");
    }
    return inside > 0;
  }

  MjcfDocument& document_;
  std::size_t made_ = 0;
};

}  // namespace

void replicate(MjcfDocument& document) { Replicator(document).expandAll(); }

}  // namespace careen
