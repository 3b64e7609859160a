#include "exchange/mjcf_frame.h"

#include <utility>

namespace careen {
namespace {

class ContentReader {
 public:
  ContentReader(MjcfDocument& document, const MjcfDefaults& defaults)
      : document_(document), defaults_(defaults) {}

  void gather(const XmlElement& parent, const std::optional<MjcfFrame>& frame, const std::string& ofParent) {
    for (const XmlElement& child : parent.children) {
      if (child.name == "frame") {
        document_.check(child,
                        {"name", "childclass", "pos", "quat", "axisangle", "euler", "xyaxes", "zaxis"});
        gather(child, poseOf(document_, child, frame.value_or(MjcfFrame{})),
               defaults_.classOf(child, "childclass", ofParent));
      } else if (child.name == "inertial" && frame) {
        document_.fail(child, "<inertial> in <" + parent.name + ">", "it in <body>");
      } else {
        contents.push_back({.element = &child, .frame = frame, .ofClass = ofParent});
      }
    }
  }

  std::vector<MjcfContent> contents;

 private:
  MjcfDocument& document_;
  const MjcfDefaults& defaults_;
};

}  // namespace

std::vector<MjcfContent> contentsOf(MjcfDocument& document, const MjcfDefaults& defaults,
                                    const XmlElement& body, const std::string& ofBody) {
  ContentReader reader(document, defaults);
  reader.gather(body, std::nullopt, ofBody);
  return std::move(reader.contents);
}

MjcfFrame poseOf(const MjcfDocument& document, const XmlElement& element, const MjcfFrame& parent) {
  return parent.of(document.vector(element, "pos", Vec3::Zero()),
                   document.orientation(element, Quat::Identity()));
}

MjcfGeom geomOf(const MjcfDefaults& defaults, const MjcfContent& content) {
  MjcfGeom geom = defaults.geom(*content.element, content.ofClass);
  if (content.frame) {
    const MjcfFrame placed = content.frame->of(geom.position, geom.turn);
    geom.position = placed.position;
    geom.turn = placed.turn;
  }
  return geom;
}

}  // namespace careen
