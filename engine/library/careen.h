#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

// careen as a library: read a scene or build one, simulate it, and ask for states at any moment, impacts, the
// audit, a hash, and pictures. SI units, z up, right-handed frames, angles in radians. Everything here may be
// used by several threads at once, each with runs of its own or with the same one; pictures are drawn one at
// a time.
//
// This header needs the standard library alone. What is in careen::v1 keeps its meaning.
namespace careen::v1 {

/// Name and version, such as "careen 0.1.0".
const char* version();

using Vector = std::array<double, 3>;
using Quaternion = std::array<double, 4>;  ///< w x y z, of length 1
using Tensor = std::array<Vector, 3>;      ///< symmetric, in rows

/// The tensor whose principal axes are those of the frame.
constexpr Tensor diagonal(double x, double y, double z) {
  return {Vector{x, 0, 0}, Vector{0, y, 0}, Vector{0, 0, z}};
}

/// Anything that went wrong; what() says what was found and what was expected.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A scene, or a file, that cannot be used.
class SceneError : public Error {
 public:
  SceneError(const std::string& message, std::string file, std::size_t line, std::size_t column)
      : Error(message), file_(std::move(file)), line_(line), column_(column) {}
  const std::string& file() const { return file_; }  ///< empty if none is to blame
  std::size_t line() const { return line_; }         ///< from 1; 0: no line is to blame
  std::size_t column() const { return column_; }     ///< likewise

 private:
  std::string file_;
  std::size_t line_;
  std::size_t column_;
};

/// One of the boxes of a body, in that body's frame.
struct BoxPart {
  Vector halfExtents = {0.5, 0.5, 0.5};   ///< [m]
  Vector position = {0, 0, 0};            ///< [m] of its middle
  Quaternion orientation = {1, 0, 0, 0};  ///< body from part
};

/// How a fixed box or a wall moves by itself; all of it adds up.
struct Motion {
  /// [s] and [m] Where its middle is, in place of `position`, or a wall's `point`: straight from point to
  /// point, still before the first and after the last.
  std::vector<std::pair<double, Vector>> path = {};
  Vector velocity = {0, 0, 0};         ///< [m/s] all the time
  Vector angularVelocity = {0, 0, 0};  ///< [rad/s] world frame, all the time
  /// [m] What it turns about, in the world at the start; goes along with path and velocity. None: its middle,
  /// or a wall's point.
  std::optional<Vector> about = std::nullopt;
  Vector amplitude = {0, 0, 0};         ///< [m] times sin(2π frequency t + phase)
  Vector angularAmplitude = {0, 0, 0};  ///< [rad] likewise, along the angular velocity if there is one
  double frequency = 0;                 ///< [Hz]
  double phase = 0;                     ///< [rad]
};

/// A box of a scene that is built in code; keys of scene files have the same names and defaults.
struct Box {
  std::string name;                       ///< empty: box-0, box-1 …
  Vector halfExtents = {0.5, 0.5, 0.5};   ///< [m]
  double mass = 1;                        ///< [kg]
  Vector position = {0, 0, 0};            ///< [m] of the middle
  Quaternion orientation = {1, 0, 0, 0};  ///< world from body
  Vector velocity = {0, 0, 0};            ///< [m/s]
  Vector angularVelocity = {0, 0, 0};     ///< [rad/s] world frame
  double restitution = 0;                 ///< [1]
  double friction = 0;                    ///< [1]
  bool fixed = false;
  /// [kg m²] About the centre of mass, along the box's axes; none: a solid box. No principal moment may
  /// exceed the sum of the two others. Not of a fixed box.
  std::optional<Tensor> inertia = std::nullopt;
  /// [m] Centre of mass, from the middle along the box's axes; inside the box. Not of a fixed box.
  Vector center = {0, 0, 0};
  Vector surfaceVelocity = {0, 0, 0};  ///< [m/s] belts: how the faces of a fixed box move along themselves
  double surfaceSpin = 0;              ///< [rad/s] turntables: likewise, about its z axis
  /// A rigid body of several boxes, which may overlap, in the place of `halfExtents`. `position` and `State`
  /// are then of its frame's origin; the centre of mass, if `center` is 0, and the inertia, if there is none,
  /// are those of the union of its boxes.
  std::vector<BoxPart> parts = {};
  std::optional<Motion> motion = std::nullopt;  ///< of a fixed box
};

/// A plane that keeps boxes on the side that its normal points to.
struct Wall {
  std::string name;                    ///< empty: wall-0, wall-1 …
  Vector point = {0, 0, 0};            ///< [m]
  Vector normal = {0, 0, 1};           ///< of any length but 0
  double restitution = 0;              ///< [1]
  double friction = 0;                 ///< [1]
  Vector surfaceVelocity = {0, 0, 0};  ///< [m/s] a belt: how it moves along itself
  double surfaceSpin = 0;              ///< [rad/s] a turntable: about its normal, through its point
  std::optional<Motion> motion = std::nullopt;
};

struct State {
  Vector position;         ///< [m] of the box's middle
  Quaternion orientation;  ///< world from body
  Vector velocity;         ///< [m/s] of the box's middle
  Vector angularVelocity;  ///< [rad/s] world frame
};

/// A joint of the scene at a moment at which a controller is asked; both are 0 if it is no hinge or slider.
struct JointReading {
  std::string name;
  double coordinate;  ///< [rad] or [m]; turns of a hinge are counted
  double rate;        ///< [rad/s] or [m/s]
};

/// Answers with the efforts [N m] or [N] of all joints, in the order in which it is given them, which are
/// held until it is asked again. It must always answer the same, or the same scene makes other runs; it may
/// be asked by any thread that simulates.
using Controller = std::function<std::vector<double>(double time, const std::vector<State>& boxes,
                                                     const std::vector<JointReading>& joints)>;

/// A scene: text in the format of scene files, checked when it is simulated.
class Scene {
 public:
  /// An empty one, that boxes and walls are added to.
  explicit Scene(double duration, Vector gravity = {0, 0, -9.81});
  /// A scene file, or a model of MuJoCo (.xml), whose scene text() then is. SceneError if it cannot be read.
  static Scene read(const std::filesystem::path& path);
  /// `name` stands for the file in messages.
  static Scene parse(std::string text, std::string name = "scene");

  /// Error if the scene was not begun in code.
  Scene& add(const Box& box);
  Scene& add(const Wall& wall);
  /// What gravity [m/s²] is from each time [s] on; times ascend, the first is 0. Or what it is at each of
  /// them, straight from one to the next.
  Scene& gravity(const std::vector<std::pair<double, Vector>>& path);
  Scene& gravityThrough(const std::vector<std::pair<double, Vector>>& path);
  /// Method ("exact", "listing1" …) and tolerance [m] in place of those of the scene.
  Scene& method(const std::string& name);
  Scene& tolerance(double metres);
  /// [s] Step, of methods that step, and duration in place of those of the scene.
  Scene& step(double seconds);
  Scene& duration(double seconds);
  /// That boxes which overlap at the start are moved apart, in place of an error.
  Scene& allowOverlap();
  /// That the run ends when a statement becomes true, such as "rest" or "a touches b".
  Scene& until(const std::string& statement);
  /// That share the steps of large crowds, 1 to 64; 1 unless said otherwise. Nothing but the time depends on
  /// it.
  Scene& threads(int count);

  /// That it is asked each period [s], from 0 on, in place of a "control" in the scene. A run that is saved
  /// has the efforts, and not the controller.
  Scene& control(double period, Controller controller);

  std::string text() const;
  const std::string& name() const { return name_; }
  /// What of a model of MuJoCo is ignored, left open or renamed, in words.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  friend class Run;
  void requireBuilt() const;
  Scene(std::string name, std::string text) : name_(std::move(name)), text_(std::move(text)) {}

  std::string name_;
  std::string text_;
  bool built_ = false;
  std::vector<std::string> boxes_;  // each as JSON
  std::vector<std::string> walls_;  // likewise
  std::vector<std::string> notes_;
  std::optional<std::string> method_;
  std::optional<double> tolerance_;  // [m]
  std::optional<double> step_;       // [s]
  std::optional<double> duration_;   // [s]
  bool allowsOverlap_ = false;
  std::string until_;
  int threads_ = 1;
  double period_ = 0;  // [s]
  Controller controller_;
};

struct Impact {
  double time;        ///< [s]
  std::string a;      ///< the box that the normal points to
  std::string b;      ///< the box or wall that it struck
  Vector point;       ///< [m] world
  Vector normal;      ///< from b to a, of length 1
  double approach;    ///< [m/s] along the normal, before the impact
  double impulse;     ///< [N s] along the normal
  double tangential;  ///< [N s] of friction
};

/// Energies at a moment [J], and what was given and lost since the start: total − motors − changes + impacts
/// + jointFriction + damping + drag + remaining is the total at the start.
struct Energy {
  double translation;      ///< kinetic
  double rotation;         ///< likewise
  double gravity;          ///< potential, 0 at the height of the world's origin
  double springs;          ///< of the scene
  double jointSprings;     ///< of joints
  double total;            ///< of these five
  double motors;           ///< given by motors
  double changes;          ///< given where gravity changes
  double impacts;          ///< lost where impacts are recorded
  double jointFriction;    ///< lost to dry friction of joints
  double damping;          ///< lost in springs and joints
  double drag;             ///< lost to drag
  double remaining;        ///< lost in contact between impacts, and otherwise; less the work of drives, belts
  Vector momentum;         ///< [kg m/s]
  Vector angularMomentum;  ///< [kg m²/s] about the world's origin
};

/// The force of a contact at one point of a box and what it touches. Where contacts share what bears a box in
/// more than one way, it is that with the least sum of squares. Of what is in a crowd a mean over 1/60 s or
/// so, in which its impacts, too, are.
struct Force {
  double time;    ///< [s]
  std::string a;  ///< the box that it acts on
  std::string
      b;  ///< the box, on which the opposite acts, or wall; empty: nothing was found that moves a as it moves
  Vector point;   ///< [m] world
  Vector normal;  ///< from b to a, of length 1
  Vector force;   ///< [N] on a, friction included
  double left;    ///< [N] what of the forces that move the boxes as they move no forces of contact can give
};

/// The largest finding of a kind, by code that shares nothing with the method.
struct AuditFigure {
  std::string kind;                 ///< such as "box_overlap"
  std::string unit;                 ///< of the size: "m", "1", "states"
  double size;                      ///< 0: nothing found
  double time;                      ///< [s]
  std::vector<std::string> bodies;  ///< boxes and walls, by name
  bool promised;                    ///< the method promises a bound for it
};

struct Audit {
  std::vector<AuditFigure> figures;   ///< one for each kind
  std::vector<std::string> breaches;  ///< broken promises, in words; empty if the run keeps them all
};

/// A picture, rows from the top, three bytes a pixel: red, green, blue.
struct Image {
  int width = 0;   ///< [px]
  int height = 0;  ///< [px]
  std::vector<std::uint8_t> rgb;
};

/// A film of a run: PNG frames in a folder, and a video of them.
struct Film {
  std::filesystem::path folder;
  std::filesystem::path video = {};             ///< .mp4, .webm …, encoded by ffmpeg; empty: none
  std::string quality = "good";                 ///< of the video: draft, good or best
  std::string frames = {};                      ///< such as "0-119,200:2"; empty: all
  std::optional<std::array<int, 2>> size = {};  ///< [px] width, height; none: the scene's
  bool alpha = false;                           ///< boxes and their shadows on nothing
  bool sound = false;                           ///< sound.wav beside the frames, and in the video
  bool replace = false;                         ///< a film of something else that is in the folder
  std::optional<int> jobs = {};                 ///< processes; none: one for each core
};

/// How far a run is from another one of the same scene.
struct Difference {
  std::vector<std::string> incomparable;  ///< why they are no runs of one scene; empty if they are
  bool same = false;                      ///< to the bit
  std::optional<double> from;             ///< [s] when a state differs first
  double position = 0;                    ///< [m] of the box that is farthest off, up to the horizon
  double angle = 0;                       ///< [rad] of the same box
  std::string box;                        ///< that box
  double time = 0;                        ///< [s] when
  std::optional<double> horizon;          ///< [s] when they become unrelated, by chaos; none: never
  std::string firstImpact;                ///< that differs, in words; empty: none
};

/// How wrong a run is, estimated from others: one of half the step, or of a tenth of the tolerance.
struct ErrorEstimate {
  double position;              ///< [m] the largest of all boxes
  double angle;                 ///< [rad] likewise
  double until;                 ///< [s] up to here; if that is before the end, nothing is known of later
  std::optional<double> holds;  ///< [1] the part of scenes in which it is no larger, where that was measured
};

/// Labels of every pixel of a film's frames, as `careen truth` writes them.
struct Labels {
  std::filesystem::path folder;
  std::string channels = "all";                 ///< or such as "depth,instance,flow"
  std::string frames = {};                      ///< such as "0-119,200:2"; empty: all
  std::optional<std::array<int, 2>> size = {};  ///< [px] width, height; none: the scene's
  std::optional<int> jobs = {};                 ///< processes; none: one for each core
};

/// A page about a run, as `careen page` writes it, with its film.
struct Page {
  std::filesystem::path path;
  std::string quality = "good";          ///< of the film: draft, good or best
  std::array<int, 2> size = {640, 360};  ///< [px] of the film
  bool sound = false;
};

/// A finished run. Copies share it.
class Run {
 public:
  /// Simulates. SceneError if the scene is invalid, Error if the method cannot go on.
  explicit Run(const Scene& scene);
  /// A file that save() or `careen simulate` wrote, or a table of poses (CSV, NPZ) of the boxes of a scene. A
  /// trajectory takes camera, film, look and light from the scene, if there is one. SceneError if it cannot
  /// be read.
  static Run read(const std::filesystem::path& path, const std::filesystem::path& scene = {});
  void save(const std::filesystem::path& path) const;

  double duration() const;                        ///< [s] it ends earlier than its scene if Scene::until did
  const std::vector<std::string>& boxes() const;  ///< names, in the order of the scene
  /// State of a box, by its place in boxes(), at a time in [0, duration()] [s]; exact at every moment. Error
  /// outside.
  State state(std::size_t box, double time) const;
  const std::vector<Impact>& impacts() const;  ///< in order of time
  /// Energies at a time in [0, duration()] [s]. What was lost is added up from the start: ask for many
  /// moments at once. Error outside.
  Energy energy(double time) const;
  std::vector<Energy> energies(const std::vector<double>& times) const;  ///< at times in any order
  /// Forces of contact at times in [0, duration()] [s], moment by moment as given. Error outside.
  std::vector<Force> forces(const std::vector<double>& times) const;
  std::vector<Force> forces(double time) const;
  Audit audit() const;
  /// Simulates again, one to three times as long. None if that fails, or of a table of poses.
  std::optional<ErrorEstimate> estimateError() const;
  /// What was modelled, speed, error and audit as JSON: report.json of `careen simulate`.
  std::string report() const;
  /// [s] All moments at which a statement becomes true, in order of time, such as "a touches b", "height(a) <
  /// 0.5" or "rest"; 0 among them if it is from the start. Error if it is no statement about the run.
  std::vector<double> when(const std::string& statement) const;
  std::string hash() const;  ///< of the final states, bit for bit
  Difference differenceFrom(const Run& other) const;
  /// A file of another program, by its name's end, as `careen export` writes it: .glb (glTF), .xml (MJCF),
  /// .npz or .csv, with poses at every so many seconds in a table. Error for another name, or what cannot be
  /// written.
  void exportTo(const std::filesystem::path& path, double every = 1.0 / 60) const;

  /// The pictures at film times [s], as `careen render --still` draws them, overlays included; film time is
  /// scene time unless the scene says otherwise. Without a size, that of the scene. Error if there is no GL.
  std::vector<Image> frames(const std::vector<double>& filmTimes,
                            std::optional<std::array<int, 2>> size = std::nullopt) const;
  Image frame(double filmTime, std::optional<std::array<int, 2>> size = std::nullopt) const;
  /// The film that `careen render` makes, frame by frame the same bytes. Its processes are forked: Error if
  /// this process has drawn a frame itself, whose GL they would not have.
  void film(const Film& film) const;
  /// Likewise.
  void page(const Page& page) const;
  void labels(const Labels& labels) const;

 private:
  struct Data;
  explicit Run(std::shared_ptr<Data> data) : data_(std::move(data)) {}
  std::shared_ptr<Data> data_;
};

inline Run simulate(const Scene& scene) { return Run(scene); }

/// By how much two pictures, films or runs may differ.
struct Allowed {
  std::string threshold = "same-picture";  ///< exact, same-machine, same-picture or other-renderer
  std::vector<std::string> limits = {};    ///< in place of the threshold's, such as "failpercent=5"
  /// [1] Of runs: how far apart boxes may be, in their half diagonals or radians; 0: bit for bit. Of films:
  /// none, if another motion does not count where the pictures are the same.
  std::optional<double> motion = 0;
  std::optional<double> until = {};       ///< [s] runs are compared up to here
  std::vector<std::string> ignored = {};  ///< of pictures: "x,y,width,height" [px], or a mask's file
};

/// What `careen compare` finds.
struct Comparison {
  bool same;                           ///< as far as is allowed
  std::string headline;                ///< in a sentence
  std::vector<std::string> different;  ///< frames that differ, by name
  std::string report;                  ///< all of it as JSON: its report.json
};

/// Compares two pictures, two folders of frames, or two runs, of which a table of poses is one: of this
/// scene, or else of that of the other run. `page`: a folder for a report with pictures. Error if they are
/// not of one kind.
Comparison compare(const std::filesystem::path& expected, const std::filesystem::path& actual,
                   const Allowed& allowed = {}, const std::filesystem::path& page = {},
                   const std::filesystem::path& scene = {});

/// The table of a sweep: one row for each run of a family.
struct SweepTable {
  std::filesystem::path path;  ///< table.csv; table.npz beside it
  long rows = 0;
  long broken = 0;  ///< of runs that break a promise of their method
};

/// Runs of a family, a scene whose numbers may be distributions.
struct Sweep {
  std::filesystem::path family;
  std::filesystem::path folder;
  long first = 0;
  long last = 99;
  std::vector<std::string> when = {};  ///< statements, whose first moments are columns of the table
  bool estimateErrors = false;         ///< columns with each run's error: two to four times as long
  std::optional<int> jobs = {};        ///< processes, which are forked; none: one for each core
};

/// Simulates them, as `careen sweep` does. SceneError if the family is invalid, Error if the folder holds
/// another sweep.
SweepTable sweep(const Sweep& sweep);

}  // namespace careen::v1
