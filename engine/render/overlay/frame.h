#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "image/font.h"
#include "render/overlay/energy_shares.h"
#include "render/overlay/shapes.h"
#include "render/overlay/style.h"
#include "trajectory/trajectory.h"
#include "view/screen.h"

namespace careen {

/// The largest values of a film, shown by the longest arrows. 0 if there is none.
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

/// The data that overlays are made from at one moment.
struct OverlayFrame {
  const Trajectory& trajectory;
  double time = 0;          ///< [s]
  double frameSeconds = 0;  ///< [s] from one frame of the film to the next
  const std::vector<BodyState>& states;
  const std::vector<std::size_t>& farthestFirst;  ///< bodies: what is nearer is drawn over what is behind it
  const OverlayScales& scales;
  const OverlayFonts* fonts = nullptr;  ///< non-null if there is text
  const EnergyBook* energy = nullptr;   ///< non-null if the energy is shown
  const Trajectory* ghost = nullptr;    ///< non-null if another run is shown as outlines
  const Screen& screen;
  OverlayStyle style;
};

// Each adds one overlay. An arrow's length is proportional to its value over the film's largest, as seen at
// the box's distance, with perspective foreshortening.
void addTrails(OverlayShapes& shapes, const OverlayFrame& frame);
void addVelocities(OverlayShapes& shapes, const OverlayFrame& frame);
void addAngularMomenta(OverlayShapes& shapes, const OverlayFrame& frame);
void addSpinAxes(OverlayShapes& shapes, const OverlayFrame& frame);
void addContacts(OverlayShapes& shapes, const OverlayFrame& frame);
void addImpulses(OverlayShapes& shapes, const OverlayFrame& frame);
/// Outlines of the other run's movable boxes, those edges paler that their own boxes would hide, and lines
/// from each centre to its ghost's. Nothing after the end of the other run.
void addGhost(OverlayShapes& shapes, const OverlayFrame& frame);
/// In the lower right corner, the largest distance and angle of a box from its ghost; after the end of the
/// other run a note.
void addGhostPanel(OverlayShapes& shapes, const OverlayFrame& frame);
/// The largest part of a picture that panels cover together.
inline constexpr double kPanelsShare = 0.25;
/// The panels of what is shown: time, energy, the meaning of arrows with one of a round value as scale, and
/// the distance of the other run; in this order, each for which there still is room.
void addPanels(OverlayShapes& shapes, const OverlayFrame& frame, const OverlaySet& shown);

/// Number of film frames over which an impact fades.
inline constexpr int kImpactFrames = 8;
/// Length of a trail [s].
inline constexpr double kTrailSeconds = 1.5;

/// An arrow for a vector at a world point; nullopt if it is too short to be seen or behind the camera.
std::optional<Stroke> arrowFor(const OverlayFrame& frame, const Vec3& point, const Vec3& vector,
                               double largest, const Color& color);

/// Indices of these places [m], from the farthest from the camera to the nearest, whatever order they come
/// in.
std::vector<std::size_t> farthestFirst(const Screen& screen, std::span<const Vec3> places);

/// A dark plate as background of text; corners at whole pixels.
Plate plateFor(const OverlayStyle& style, const Vec2& min, const Vec2& max);

/// 00:00:01.234 for 1.234 s.
std::string timeCode(double seconds);

/// A round value of at most 0.6 of the largest: 1, 2 or 5 times a power of ten.
double roundValue(double largest);

}  // namespace careen
