#pragma once

#include "image/picture.h"

namespace careen {

/// Pictures of one view and size from which boxes are taken off their stage.
struct MatteParts {
  Picture boxes;       ///< boxes in their light, all else black
  Picture coverage;    ///< boxes white, all else black: in linear light, how much of a pixel they cover
  Picture stage;       ///< what is around boxes, with their shadows on it, as if they could not be seen
  Picture emptyStage;  ///< the same without their shadows
};

/// Boxes and their shadows on nothing. Laid over a picture as programs usually do it (in sRGB), a shadow
/// changes it as it changed the stage: over the empty stage it gives the stage within 1 of 255, with the
/// least alpha for which a colour does so. Boxes have the part of a pixel that they cover as alpha.
Picture onNothing(const MatteParts& parts);

}  // namespace careen
