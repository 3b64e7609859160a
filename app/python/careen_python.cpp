// careen in Python: the module, its classes and functions.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "answers.h"
#include "library/careen.h"

namespace py = pybind11;
using namespace careen::python;
using careen::v1::JointReading;
using careen::v1::Scene;
using careen::v1::SceneError;
using careen::v1::State;

namespace {

// A path, or a dictionary as a scene file has it.
Scene sceneOf(const py::object& scene) {
  if (py::isinstance<py::dict>(scene)) {
    return Scene::parse(py::module_::import("json").attr("dumps")(scene).cast<std::string>(), "scene");
  }
  return Scene::read(scene.cast<std::filesystem::path>());
}

// The efforts that a function of Python gives for some joints by name; the others have none.
std::vector<double> effortsOf(const py::object& control, double time, const std::vector<State>& boxes,
                              const std::vector<JointReading>& joints) {
  const py::gil_scoped_acquire locked;
  py::dict readings;
  for (const JointReading& joint : joints) {
    readings[joint.name.c_str()] = py::make_tuple(joint.coordinate, joint.rate);
  }
  const py::dict answer = control(time, arraysOf(boxes), readings).cast<py::dict>();
  std::vector<double> efforts;
  std::size_t known = 0;
  for (const JointReading& joint : joints) {
    const bool has = answer.contains(joint.name.c_str());
    efforts.push_back(has ? answer[joint.name.c_str()].cast<double>() : 0);
    known += has ? 1 : 0;
  }
  if (known != answer.size()) {
    throw careen::v1::Error("found an effort of an unknown joint, expected names of joints of the scene");
  }
  return efforts;
}

// What the run has in place of the scene's own.
struct Replaced {
  std::optional<std::string> method;
  std::optional<double> tolerance;
  std::optional<double> step;
  std::optional<double> duration;
  bool allowsOverlap = false;
  std::string until;
  int threads = 1;
};

Run simulate(const py::object& given, const Replaced& replaced, const py::object& control,
             std::optional<double> period) {
  Scene scene = sceneOf(given);
  if (control.is_none() == period.has_value()) {
    throw careen::v1::Error("found a control without a period, or the other way round, expected both");
  }
  if (period) {
    scene.control(*period, [&control](double time, const std::vector<State>& boxes,
                                      const std::vector<JointReading>& joints) {
      return effortsOf(control, time, boxes, joints);
    });
  }
  if (replaced.method) {
    scene.method(*replaced.method);
  }
  if (replaced.tolerance) {
    scene.tolerance(*replaced.tolerance);
  }
  if (replaced.step) {
    scene.step(*replaced.step);
  }
  if (replaced.duration) {
    scene.duration(*replaced.duration);
  }
  if (replaced.allowsOverlap) {
    scene.allowOverlap();
  }
  scene.until(replaced.until).threads(replaced.threads);
  const py::gil_scoped_release unlocked;
  return Run(scene);
}

py::dict compare(const std::filesystem::path& expected, const std::filesystem::path& actual,
                 careen::v1::Allowed allowed, const std::filesystem::path& page,
                 const std::filesystem::path& scene) {
  careen::v1::Comparison found;
  {
    const py::gil_scoped_release unlocked;
    found = careen::v1::compare(expected, actual, allowed, page, scene);
  }
  py::dict comparison;
  comparison["same"] = found.same;
  comparison["headline"] = found.headline;
  comparison["different"] = found.different;
  comparison["report"] = fromJson(found.report);
  return comparison;
}

// Exceptions of the module: careen.Error, and careen.SceneError with file, line and column.
void addErrors(py::module_& module) {
  static const py::object error = py::exception<careen::v1::Error>(module, "Error", PyExc_RuntimeError);
  static const py::object sceneError = py::exception<SceneError>(module, "SceneError", error);
  sceneError.attr("__doc__") =
      "A scene or file that cannot be used: file (str), line and column (int, from 1; 0: no place is to "
      "blame).";
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      std::rethrow_exception(std::move(thrown));
    } catch (const SceneError& fault) {
      const py::object raised = sceneError(fault.what());
      raised.attr("file") = fault.file();
      raised.attr("line") = fault.line();
      raised.attr("column") = fault.column();
      PyErr_SetObject(sceneError.ptr(), raised.ptr());
    } catch (const careen::v1::Error& fault) {
      PyErr_SetString(error.ptr(), fault.what());
    }
  });
}

}  // namespace

PYBIND11_MODULE(careen, module) {
  module.doc() =
      "Rigid boxes that tumble and collide. SI units, z up, angles in radians, quaternions as w x y z.";
  module.attr("__version__") = std::string(careen::v1::version()).substr(sizeof("careen"));
  // Loads NumPy now: pybind11 does it where the first array is made, and two threads that do so wait for each
  // other.
  try {
    static_cast<void>(py::array_t<double>(0));
  } catch (py::error_already_set& error) {
    py::raise_from(error, PyExc_ImportError, "careen needs NumPy in this Python");
    throw py::error_already_set();
  }
  addErrors(module);

  py::class_<Run>(module, "Run", "A finished run; careen.simulate and careen.read_run make one.")
      .def_property_readonly("duration", &Run::duration, "float [s]")
      .def_property_readonly("boxes", &Run::boxes,
                             "Names of the boxes, in the order of the scene: list of N str.")
      .def_property_readonly("hash", &Run::hash, "Hash of the final states, bit for bit: str.")
      .def("states", &statesOf, py::arg("t"),
           "States at times t [s], an array of any shape S within [0, duration]. A dictionary of arrays: "
           "position "
           "S+(N, 3) [m] of their middles, of bodies of several parts of their frames; orientation S+(N, 4), "
           "w x y z, world from body; velocity S+(N, 3) "
           "[m/s]; "
           "angular_velocity S+(N, 3) [rad/s], world frame.")
      .def_property_readonly(
          "impacts", &impactsOf,
          "All K impacts in order of time, a dictionary: time (K,) [s]; a, b: lists of K str, what "
          "struck what; point (K, 3) [m]; normal (K, 3), from b to a; approach (K,) [m/s]; impulse "
          "(K,) [N s] along the normal; tangential (K,) [N s] of friction.")
      .def("energy", &energiesOf, py::arg("t"),
           "Energies [J] at times t [s], an array of any shape S within [0, duration]. A dictionary of "
           "arrays of "
           "shape S: translation, rotation, gravity, springs, joint_springs and their total; motors, "
           "changes, what "
           "they "
           "gave since the start; impacts, joint_friction, damping, drag and remaining, what was lost since. "
           "total - motors - changes + what was lost is the total at the start. momentum S+(3,) [kg m/s] and "
           "angular_momentum S+(3,) [kg m^2/s] about the world's origin.")
      .def("forces", &forcesOf, py::arg("t"),
           "Forces of contact at times t [s], an array within [0, duration], moment by moment: a dictionary "
           "of "
           "K rows, one for each point at which something pushes: time (K,) [s]; a, b: lists of K str, the "
           "box "
           "that it acts on, and the box or wall that pushes, empty if none was found; point (K, 3) [m]; "
           "normal "
           "(K, 3), from b to a; force (K, 3) [N] on a, the opposite on b; left (K,) [N], what of the forces "
           "that "
           "move the boxes as they move no forces of contact can give. Where contacts are redundant, those "
           "with "
           "the least sum of squares. Of what is in a crowd, means over 1/60 s or so, with its impacts.")
      .def_property_readonly(
          "audit", &auditOf,
          "What the run is worth, by code that shares nothing with the method: for each kind a "
          "dictionary of size, unit, time [s], bodies and promised; and breaches, a list of str, "
          "empty if the run keeps all promises of its method.")
      .def("when", &momentsOf, py::arg("statement"),
           "All moments [s] at which a statement becomes true, in order of time, an array; 0 among them if "
           "it is "
           "from the start. Such as 'a touches b', 'height(a) < 0.5', 'rest'; 'careen help questions' has "
           "all.")
      .def("frame", &frameOf, py::arg("t"), py::arg("size") = py::none(),
           "The picture at film time t [s], an array of uint8 (height, width, 3); size is (width, height) "
           "[px], that "
           "of the scene if there is none.")
      .def(
          "film",
          [](const Run& run, const std::filesystem::path& folder,
             const std::optional<std::filesystem::path>& video, const std::string& quality,
             const std::string& frames, const Size& size, bool alpha, bool sound, bool replace,
             const std::optional<int>& jobs) {
            run.film({.folder = folder,
                      .video = video.value_or(""),
                      .quality = quality,
                      .frames = frames,
                      .size = size,
                      .alpha = alpha,
                      .sound = sound,
                      .replace = replace,
                      .jobs = jobs});
          },
          py::arg("folder"), py::kw_only(), py::arg("video") = py::none(), py::arg("quality") = "good",
          py::arg("frames") = "", py::arg("size") = py::none(), py::arg("alpha") = false,
          py::arg("sound") = false, py::arg("replace") = false, py::arg("jobs") = py::none(),
          py::call_guard<py::gil_scoped_release>(),
          "Draws the film into a folder as careen render does: PNG frames and, if a video is named, that too "
          "(.mp4, .webm ..., by ffmpeg; quality draft, good or best). frames such as '0-119,200:2', all if "
          "empty; size (width, height) [px]; alpha: boxes and shadows on nothing; sound: sound.wav beside "
          "the frames, and in the video; replace "
          "another film that is there; jobs: processes. They are forked: not after frame() in the same "
          "process.")
      .def(
          "export", &Run::exportTo, py::arg("path"), py::arg("every") = 1.0 / 60,
          py::call_guard<py::gil_scoped_release>(),
          "Writes a file of another program, by the end of its name: .glb (glTF), .xml (MJCF), .npz or .csv, "
          "tables with poses at every so many seconds.")
      .def(
          "page",
          [](const Run& run, const std::filesystem::path& path, const std::string& quality,
             const std::array<int, 2>& size,
             bool sound) { run.page({.path = path, .quality = quality, .size = size, .sound = sound}); },
          py::arg("path"), py::kw_only(), py::arg("quality") = "good", py::arg("size") = std::array{640, 360},
          py::arg("sound") = false, py::call_guard<py::gil_scoped_release>(),
          "Writes a page for a browser: the film, of this quality and size (width, height) [px], energies, "
          "impacts and audit. Processes are forked, as by film().")
      .def(
          "labels",
          [](const Run& run, const std::filesystem::path& folder, const std::string& channels,
             const std::string& frames, const Size& size, const std::optional<int>& jobs) {
            run.labels(
                {.folder = folder, .channels = channels, .frames = frames, .size = size, .jobs = jobs});
          },
          py::arg("folder"), py::kw_only(), py::arg("channels") = "all", py::arg("frames") = "",
          py::arg("size") = py::none(), py::arg("jobs") = py::none(),
          py::call_guard<py::gil_scoped_release>(),
          "Writes labels of every pixel of the film's frames into a folder, as careen truth does: 000000.npz "
          "..., truth.json. channels such as 'depth,instance,flow'; frames, size and jobs as for film().")
      .def("estimate_error", &estimateOf,
           "How wrong the run is, from other runs of the scene that take one to three times as long, a "
           "dictionary: position [m] and angle [rad], the largest of all boxes up to the time until [s]; if "
           "that is before the end, chaos has taken over, and nothing is known of later places; holds, the "
           "part of scenes in which the error is no larger, or None. None if these runs fail, and of a table "
           "of poses.")
      .def_property_readonly("report", &reportOf,
                             "What was modelled, speed, error and audit, a dictionary: report.json of careen "
                             "simulate.")
      .def("difference_from", &differenceOf, py::arg("other"),
           "How far the run is from another one of the same scene, a dictionary: incomparable, list of str, "
           "why "
           "they are none; same (bool), to the bit; from [s] or None; position [m], angle [rad], box and "
           "time [s] "
           "of the largest difference up to the horizon [s], from which on they are unrelated, or None; "
           "first_impact (str) that differs.")
      .def("save", &Run::save, py::arg("path"), py::call_guard<py::gil_scoped_release>(),
           "Writes the run as a file that careen render and careen.read_run take.");
  module.def(
      "simulate",
      [](const py::object& scene, const std::optional<std::string>& method, std::optional<double> tolerance,
         std::optional<double> step, std::optional<double> duration, bool allowOverlap,
         const std::string& until, int threads, const py::object& control, std::optional<double> period) {
        return simulate(scene,
                        {.method = method,
                         .tolerance = tolerance,
                         .step = step,
                         .duration = duration,
                         .allowsOverlap = allowOverlap,
                         .until = until,
                         .threads = threads},
                        control, period);
      },
      py::arg("scene"), py::kw_only(), py::arg("method") = py::none(), py::arg("tolerance") = py::none(),
      py::arg("dt") = py::none(), py::arg("duration") = py::none(), py::arg("allow_overlap") = false,
      py::arg("until") = "", py::arg("threads") = 1, py::arg("control") = py::none(),
      py::arg("period") = py::none(),
      "Simulates a scene: the path of a scene file or of a model of MuJoCo (.xml), or a dictionary with the "
      "keys of scene files (motion of fixed boxes and walls, gravity that changes, parts and joints among "
      "them). method (str), tolerance [m], dt [s] and duration [s] replace those of the scene; "
      "allow_overlap moves boxes apart that overlap at the start; the run ends when the statement until, "
      "such "
      "as 'rest', becomes true; threads share the steps of large crowds, and nothing but the time depends on "
      "them. control(t, boxes, joints) is called each period [s], with the arrays of Run.states without "
      "times, and (coordinate, rate) of each joint by name; it returns efforts [N m] or [N] by name of a "
      "hinge or slider, which are held until the next time. SceneError says what is wrong with a scene, and "
      "where.");
  module.def(
      "read_run", &Run::read, py::arg("path"), py::arg("scene") = "",
      py::call_guard<py::gil_scoped_release>(),
      "Reads a run that Run.save or careen simulate wrote, or a table of poses (CSV, NPZ) of the boxes "
      "of a scene file. A run takes camera, film, look and light from the scene, if there is one.");
  module.def(
      "compare",
      [](const std::filesystem::path& expected, const std::filesystem::path& actual,
         const std::string& threshold, const std::vector<std::string>& limits, std::optional<double> motion,
         std::optional<double> until, const std::vector<std::string>& ignored,
         const std::filesystem::path& page, const std::filesystem::path& scene) {
        return compare(
            expected, actual,
            {.threshold = threshold, .limits = limits, .motion = motion, .until = until, .ignored = ignored},
            page, scene);
      },
      py::arg("expected"), py::arg("actual"), py::kw_only(), py::arg("threshold") = "same-picture",
      py::arg("limits") = std::vector<std::string>(), py::arg("motion") = 0.0, py::arg("until") = py::none(),
      py::arg("ignored") = std::vector<std::string>(), py::arg("page") = "", py::arg("scene") = "",
      "Compares two pictures, two folders of frames, or two runs (trajectory files or tables of poses, of a "
      "scene file if they need one). threshold: exact, same-machine, same-picture or other-renderer; limits "
      "in place of its own, such as ['failpercent=5']; motion: how far apart boxes of runs may be, in their "
      "half diagonals or radians, 0: bit for bit; of films, None: another motion does not count; until [s]; "
      "ignored: 'x,y,width,height' [px] or "
      "masks; page: a folder for a report. A dictionary: same (bool), headline (str), different (list of "
      "str, "
      "frames) and report (dict), its report.json.");
  module.def(
      "sweep",
      [](const std::filesystem::path& family, const std::filesystem::path& folder,
         const std::array<long, 2>& runs, const std::vector<std::string>& when, bool estimateError,
         std::optional<int> jobs) {
        careen::v1::SweepTable table;
        {
          const py::gil_scoped_release unlocked;
          table = careen::v1::sweep({.family = family,
                                     .folder = folder,
                                     .first = runs[0],
                                     .last = runs[1],
                                     .when = when,
                                     .estimateErrors = estimateError,
                                     .jobs = jobs});
        }
        return py::make_tuple(table.path, table.rows, table.broken);
      },
      py::arg("family"), py::arg("folder"), py::kw_only(), py::arg("runs") = std::array<long, 2>{0, 99},
      py::arg("when") = std::vector<std::string>(), py::arg("estimate_error") = false,
      py::arg("jobs") = py::none(),
      "Simulates runs (first, last) of a family, a scene file whose numbers may be distributions, in jobs "
      "processes (None: one for each core). The table has a column for the first moment of each statement in "
      "when, and with estimate_error columns of each run's error, which takes two to four times as long. "
      "Returns the path of the table (table.npz beside it), its rows, and "
      "how many of them are of runs that break a promise of their method.");
}
