#pragma once

#include <optional>
#include <string>
#include <vector>

#include "image/font.h"
#include "render/overlay/energy_shares.h"
#include "render/overlay/shapes.h"
#include "render/overlay/style.h"
#include "render/view/screen.h"
#include "trajectory/trajectory.h"

namespace careen {

/// The largest values of a film: what its longest arrows stand for. 0 where there is none.
struct OverlayScales {
  double speed = 0;            ///< [m/s]
  double angularMomentum = 0;  ///< [kg m²/s]
  double angularSpeed = 0;     ///< [rad/s]
  double impulse = 0;          ///< [N s]
};

struct OverlayFonts {
  Font plain;
  Font monospaced;
};

/// What overlays are made from at one moment.
struct OverlayFrame {
  const Trajectory& trajectory;
  double time = 0;          ///< [s]
  double frameSeconds = 0;  ///< [s] from one frame of the film to the next
  const std::vector<BodyState>& states;
  const OverlayScales& scales;
  const OverlayFonts* fonts = nullptr;  ///< there if anything is written
  const EnergyBook* energy = nullptr;   ///< there if its parts are shown
  const Screen& screen;
  OverlayStyle style;
};

// Each adds one overlay. Where an arrow's length counts, it is for that value over the film's largest, seen
// from the box's distance, and shorter where it points to or from the eye.
void addTrails(OverlayShapes& shapes, const OverlayFrame& frame);
void addVelocities(OverlayShapes& shapes, const OverlayFrame& frame);
void addAngularMomenta(OverlayShapes& shapes, const OverlayFrame& frame);
void addSpinAxes(OverlayShapes& shapes, const OverlayFrame& frame);
void addContacts(OverlayShapes& shapes, const OverlayFrame& frame);
void addImpulses(OverlayShapes& shapes, const OverlayFrame& frame);
/// Above or below the boxes, the nearest first; a name that would cover another, or a plate that is there
/// already, is left out, and so are names that nobody gave where there are many boxes.
void addNames(OverlayShapes& shapes, const OverlayFrame& frame);
void addTimeCode(OverlayShapes& shapes, const OverlayFrame& frame);
void addEnergy(OverlayShapes& shapes, const OverlayFrame& frame);
/// What the arrows of `shown` mean, and how long one of a round value is.
void addLegend(OverlayShapes& shapes, const OverlayFrame& frame, const OverlaySet& shown);

/// How long an impact is shown: it fades over so many of the film's frames.
inline constexpr int kImpactFrames = 8;
/// How long a trail is [s].
inline constexpr double kTrailSeconds = 1.5;

/// An arrow for a vector at a point of the world; none where it is too short to be seen, or behind the
/// camera.
std::optional<Stroke> arrowFor(const OverlayFrame& frame, const Vec3& point, const Vec3& vector,
                               double largest, const Color& color);

/// A dark plate for text to stand on; corners at whole pixels.
Plate plateFor(const OverlayStyle& style, const Vec2& min, const Vec2& max);

/// 00:00:01.234 for 1.234 s.
std::string timeCode(double seconds);

/// A value of at most 0.6 of the largest that is easily read: 1, 2 or 5 times a power of ten.
double roundValue(double largest);

}  // namespace careen
