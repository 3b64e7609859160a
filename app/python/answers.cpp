#include "answers.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <cstddef>

namespace careen::python {

using v1::Energy;
using v1::Force;
using v1::Image;
using v1::Impact;
using v1::State;

namespace {

// An array of the shape of the times, then of boxes, then `count` numbers.
py::array_t<double> arrayOf(const Times& times, std::size_t boxes, std::size_t count) {
  std::vector<py::ssize_t> shape(times.shape(), times.shape() + times.ndim());
  shape.push_back(static_cast<py::ssize_t>(boxes));
  shape.push_back(static_cast<py::ssize_t>(count));
  return py::array_t<double>(shape);
}

// Of what has a and b, and numbers and vectors.
template <class Event>
class Columns {
 public:
  explicit Columns(const std::vector<Event>& events) : events_(events) {
    py::list a;
    py::list b;
    for (const Event& event : events) {
      a.append(event.a);
      b.append(event.b);
    }
    found_["time"] = numbers(&Event::time);
    found_["a"] = a;
    found_["b"] = b;
    found_["point"] = vectors(&Event::point);
    found_["normal"] = vectors(&Event::normal);
  }
  py::array_t<double> numbers(double Event::*part) const {
    py::array_t<double> array(static_cast<py::ssize_t>(events_.size()));
    std::transform(events_.begin(), events_.end(), array.mutable_data(),
                   [&](const Event& each) { return each.*part; });
    return array;
  }
  py::array_t<double> vectors(v1::Vector Event::*part) const {
    py::array_t<double> array({static_cast<py::ssize_t>(events_.size()), py::ssize_t{3}});
    double* to = array.mutable_data();
    for (const Event& event : events_) {
      to = std::copy((event.*part).begin(), (event.*part).end(), to);
    }
    return array;
  }
  py::dict& found() { return found_; }

 private:
  const std::vector<Event>& events_;
  py::dict found_;
};

}  // namespace

py::dict arraysOf(const std::vector<State>& boxes) {
  const auto numbers = [&](std::size_t count, auto&& of) {
    py::array_t<double> array({static_cast<py::ssize_t>(boxes.size()), static_cast<py::ssize_t>(count)});
    double* to = array.mutable_data();
    for (const State& box : boxes) {
      to = std::copy(of(box).begin(), of(box).end(), to);
    }
    return array;
  };
  py::dict states;
  states["position"] = numbers(
      3, [](const State& box) -> const auto& { return box.position; });
  states["orientation"] = numbers(
      4, [](const State& box) -> const auto& { return box.orientation; });
  states["velocity"] = numbers(
      3, [](const State& box) -> const auto& { return box.velocity; });
  states["angular_velocity"] = numbers(
      3, [](const State& box) -> const auto& { return box.angularVelocity; });
  return states;
}

py::dict statesOf(const Run& run, const Times& times) {
  const std::size_t boxes = run.boxes().size();
  py::array_t<double> position = arrayOf(times, boxes, 3);
  py::array_t<double> orientation = arrayOf(times, boxes, 4);
  py::array_t<double> velocity = arrayOf(times, boxes, 3);
  py::array_t<double> angular = arrayOf(times, boxes, 3);
  {
    const double* const at = times.data();
    const auto count = static_cast<std::size_t>(times.size());
    double* p = position.mutable_data();
    double* q = orientation.mutable_data();
    double* v = velocity.mutable_data();
    double* w = angular.mutable_data();
    const py::gil_scoped_release unlocked;
    for (std::size_t k = 0; k < count; ++k) {
      for (std::size_t box = 0; box < boxes; ++box) {
        const State state = run.state(box, at[k]);
        p = std::copy(state.position.begin(), state.position.end(), p);
        q = std::copy(state.orientation.begin(), state.orientation.end(), q);
        v = std::copy(state.velocity.begin(), state.velocity.end(), v);
        w = std::copy(state.angularVelocity.begin(), state.angularVelocity.end(), w);
      }
    }
  }
  py::dict states;
  states["position"] = position;
  states["orientation"] = orientation;
  states["velocity"] = velocity;
  states["angular_velocity"] = angular;
  return states;
}

py::dict energiesOf(const Run& run, const Times& times) {
  std::vector<Energy> energies;
  {
    const std::vector<double> at(times.data(), times.data() + times.size());
    const py::gil_scoped_release unlocked;
    energies = run.energies(at);
  }
  const std::vector<py::ssize_t> shape(times.shape(), times.shape() + times.ndim());
  const auto numbers = [&](double Energy::*part) {
    py::array_t<double> array(shape);
    std::transform(energies.begin(), energies.end(), array.mutable_data(),
                   [&](const Energy& each) { return each.*part; });
    return array;
  };
  const auto vectors = [&](v1::Vector Energy::*part) {
    std::vector<py::ssize_t> full = shape;
    full.push_back(3);
    py::array_t<double> array(full);
    double* to = array.mutable_data();
    for (const Energy& each : energies) {
      to = std::copy((each.*part).begin(), (each.*part).end(), to);
    }
    return array;
  };
  py::dict found;
  found["translation"] = numbers(&Energy::translation);
  found["rotation"] = numbers(&Energy::rotation);
  found["gravity"] = numbers(&Energy::gravity);
  found["springs"] = numbers(&Energy::springs);
  found["joint_springs"] = numbers(&Energy::jointSprings);
  found["total"] = numbers(&Energy::total);
  found["motors"] = numbers(&Energy::motors);
  found["changes"] = numbers(&Energy::changes);
  found["impacts"] = numbers(&Energy::impacts);
  found["joint_friction"] = numbers(&Energy::jointFriction);
  found["damping"] = numbers(&Energy::damping);
  found["drag"] = numbers(&Energy::drag);
  found["remaining"] = numbers(&Energy::remaining);
  found["momentum"] = vectors(&Energy::momentum);
  found["angular_momentum"] = vectors(&Energy::angularMomentum);
  return found;
}

py::dict impactsOf(const Run& run) {
  Columns<Impact> columns(run.impacts());
  columns.found()["approach"] = columns.numbers(&Impact::approach);
  columns.found()["impulse"] = columns.numbers(&Impact::impulse);
  columns.found()["tangential"] = columns.numbers(&Impact::tangential);
  return columns.found();
}

py::dict forcesOf(const Run& run, const Times& times) {
  std::vector<Force> forces;
  {
    const std::vector<double> at(times.data(), times.data() + times.size());
    const py::gil_scoped_release unlocked;
    forces = run.forces(at);
  }
  Columns<Force> columns(forces);
  columns.found()["force"] = columns.vectors(&Force::force);
  columns.found()["left"] = columns.numbers(&Force::left);
  return columns.found();
}

py::dict auditOf(const Run& run) {
  v1::Audit audit;
  {
    const py::gil_scoped_release unlocked;
    audit = run.audit();
  }
  py::dict found;
  for (const v1::AuditFigure& figure : audit.figures) {
    py::dict each;
    each["size"] = figure.size;
    each["unit"] = figure.unit;
    each["time"] = figure.time;
    each["bodies"] = figure.bodies;
    each["promised"] = figure.promised;
    found[figure.kind.c_str()] = each;
  }
  found["breaches"] = audit.breaches;
  return found;
}

py::array_t<double> momentsOf(const Run& run, const std::string& statement) {
  std::vector<double> times;
  {
    const py::gil_scoped_release unlocked;
    times = run.when(statement);
  }
  return py::array_t<double>(static_cast<py::ssize_t>(times.size()), times.data());
}

py::array_t<std::uint8_t> frameOf(const Run& run, double time, const Size& size) {
  Image image;
  {
    const py::gil_scoped_release unlocked;
    image = run.frame(time, size);
  }
  py::array_t<std::uint8_t> array({py::ssize_t{image.height}, py::ssize_t{image.width}, py::ssize_t{3}});
  std::copy(image.rgb.begin(), image.rgb.end(), array.mutable_data());
  return array;
}

py::dict differenceOf(const Run& run, const Run& other) {
  v1::Difference found;
  {
    const py::gil_scoped_release unlocked;
    found = run.differenceFrom(other);
  }
  py::dict difference;
  difference["incomparable"] = found.incomparable;
  difference["same"] = found.same;
  difference["from"] = found.from;
  difference["position"] = found.position;
  difference["angle"] = found.angle;
  difference["box"] = found.box;
  difference["time"] = found.time;
  difference["horizon"] = found.horizon;
  difference["first_impact"] = found.firstImpact;
  return difference;
}

py::object estimateOf(const Run& run) {
  std::optional<v1::ErrorEstimate> found;
  {
    const py::gil_scoped_release unlocked;
    found = run.estimateError();
  }
  if (!found) {
    return py::none();
  }
  py::dict estimate;
  estimate["position"] = found->position;
  estimate["angle"] = found->angle;
  estimate["until"] = found->until;
  estimate["holds"] = found->holds;
  return estimate;
}

py::object fromJson(const std::string& text) { return py::module_::import("json").attr("loads")(text); }

py::object reportOf(const Run& run) {
  std::string report;
  {
    const py::gil_scoped_release unlocked;
    report = run.report();
  }
  return fromJson(report);
}

}  // namespace careen::python
