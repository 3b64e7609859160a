#pragma once

#include <nlohmann/json_fwd.hpp>

#include "exchange/mjcf_contacts.h"
#include "exchange/mjcf_links.h"
#include "exchange/mjcf_model.h"

namespace careen {

/// Writes the joints of a scene: of bodies, of <equality>, and ropes and rods; the boxes that pass through
/// each other; and the control of motors, which looks at its joints once in a time step of the model, and not
/// more than a million times within `duration` [s].
void writeJoints(const MjcfDocument& document, const MjcfModel& model, const MjcfLinks& links,
                 const MjcfContacts& contacts, double duration, nlohmann::ordered_json& scene);

}  // namespace careen
