#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/math/linear_algebra.h"
#include "exchange/mjcf_defaults.h"
#include "exchange/mjcf_document.h"

namespace careen {

struct MjcfFrame {
  Vec3 position = Vec3::Zero();
  Quat turn = Quat::Identity();

  MjcfFrame of(const Vec3& at, const Quat& by) const {
    return {position + turn * at, (turn * by).normalized()};
  }
};

/// What lies in a body, or in a <frame> of it.
struct MjcfContent {
  const XmlElement* element = nullptr;
  std::optional<MjcfFrame> frame;  ///< its body from its <frame>, if it is in one
  std::string ofClass;             ///< that it takes after

  /// Of its <frame>, or of the body.
  MjcfFrame in(const MjcfFrame& body) const { return frame ? body.of(frame->position, frame->turn) : body; }
};

/// In the file's order. An <inertial> must not be in a <frame>.
std::vector<MjcfContent> contentsOf(MjcfDocument& document, const MjcfDefaults& defaults,
                                    const XmlElement& body, const std::string& ofBody);

/// Of an element with pos and an orientation.
MjcfFrame poseOf(const MjcfDocument& document, const XmlElement& element, const MjcfFrame& parent);

/// A <geom>, in its body.
MjcfGeom geomOf(const MjcfDefaults& defaults, const MjcfContent& content);

}  // namespace careen
