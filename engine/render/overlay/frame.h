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
#include "stage/overlay.h"
#include "trajectory/force_samples.h"
#include "trajectory/trajectory.h"
#include "view/screen.h"

namespace careen {

struct OverlayFonts {
  Font plain;
  Font monospaced;
};

struct NamesNow;

/// The data that overlays are made from at one moment.
struct OverlayFrame {
  const Trajectory& trajectory;
  double time = 0;          ///< [s]
  double frameSeconds = 0;  ///< [s] from one frame of the film to the next
  const std::vector<BodyState>& states;
  const std::vector<std::size_t>& farthestFirst;  ///< bodies: what is nearer is drawn over what is behind it
  const OverlayFonts* fonts = nullptr;            ///< non-null if there is text
  const EnergyBook* energy = nullptr;             ///< non-null if the energy is shown
  const std::vector<ContactPush>* forces = nullptr;  ///< non-null if forces are shown
  const NamesNow* names = nullptr;                   ///< non-null if names are shown
  const Trajectory* ghost = nullptr;                 ///< non-null if another run is shown as outlines
  const Screen& screen;
  OverlayStyle style;
};

/// Back to front; within a layer as the list has them.
enum class OverlayLayer { kTrails, kAxes, kArrows, kImpacts, kPanels, kNames };

/// What an overlay needs that is made once for a film.
enum class OverlayNeeds { kNothing, kText, kEnergy, kNames, kForces };

/// What an overlay's arrows mean: a row of the legend, with an arrow of a round value as scale. The longest
/// arrow stands for the largest value of the film. An arrow's length is proportional to its value, as seen at
/// its place, with perspective foreshortening.
struct ArrowMeaning {
  int row = 0;  ///< of the legend, from above
  const char* name = "";
  const char* unit = "";
  Color color = {};
  // One of the four.
  Vec3 (*ofBody)(const MassProperties& mass, const BodyState& state) = nullptr;
  double (*ofImpact)(const Impact& impact) = nullptr;
  double (*ofEffort)(const JointEffort& effort) = nullptr;
  double (*ofPush)(const ContactPush& push) = nullptr;
};

struct ShownOverlay;

/// An overlay: one constant in a source of its own, named in the list of stage/overlay.h.
struct OverlayKind {
  const char* shows = "";  ///< as the manual and the schema of scenes say it
  OverlayLayer layer = OverlayLayer::kArrows;
  OverlayNeeds needs = OverlayNeeds::kNothing;
  std::optional<ArrowMeaning> legend = {};  ///< if it has arrows; they need text too
  void (*add)(OverlayShapes& shapes, const OverlayFrame& frame, const ShownOverlay& shown) = nullptr;
};

#define CAREEN_OVERLAY_KIND(Name, name) extern const OverlayKind k##Name##Overlay;
CAREEN_OVERLAYS(CAREEN_OVERLAY_KIND)

/// An overlay of a film.
struct ShownOverlay {
  const OverlayKind* kind;
  double largest = 0;  ///< value of its arrows in the film; 0 if there is none
};

/// Draws the vector of each body, as the legend of `shown` has it, as an arrow at the centre of mass.
void addArrows(OverlayShapes& shapes, const OverlayFrame& frame, const ShownOverlay& shown);
/// Outlines of the other run's movable boxes, those edges paler that their own boxes would hide, and lines
/// from each centre to its ghost's. Nothing after the end of the other run.
void addGhost(OverlayShapes& shapes, const OverlayFrame& frame);
/// In the lower right corner, the largest distance and angle of a box from its ghost; after the end of the
/// other run a note.
void addGhostPanel(OverlayShapes& shapes, const OverlayFrame& frame);
/// The largest part of a picture that panels cover together.
inline constexpr double kPanelsShare = 0.25;
/// The panels of what is shown, the legend of arrows, and the distance of the other run; in this order, each
/// for which there still is room.
void addPanels(OverlayShapes& shapes, const OverlayFrame& frame, std::span<const ShownOverlay> shown);

/// Number of film frames over which an impact fades.
inline constexpr int kImpactFrames = 8;
/// Impacts of these last frames, in order of time; the latest, if there are more than can be seen.
std::span<const Impact> recentImpacts(const OverlayFrame& frame);
/// 1 at the impact, 0 when it has faded out.
double strengthOf(const OverlayFrame& frame, const Impact& impact);
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
