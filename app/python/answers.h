// What a run answers, as NumPy arrays and dictionaries of them. The interpreter's lock is released wherever
// something is computed.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "library/careen.h"

namespace careen::python {

namespace py = pybind11;
using v1::Run;

using Times = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Size = std::optional<std::array<int, 2>>;

/// States of boxes at a moment, likewise to statesOf.
py::dict arraysOf(const std::vector<v1::State>& boxes);
py::dict statesOf(const Run& run, const Times& times);
py::dict energiesOf(const Run& run, const Times& times);
py::dict impactsOf(const Run& run);
py::dict forcesOf(const Run& run, const Times& times);
py::dict auditOf(const Run& run);
py::array_t<double> momentsOf(const Run& run, const std::string& statement);
py::array_t<std::uint8_t> frameOf(const Run& run, double time, const Size& size);
py::dict differenceOf(const Run& run, const Run& other);
py::object estimateOf(const Run& run);
/// What a text of JSON is in Python.
py::object fromJson(const std::string& text);
py::object reportOf(const Run& run);

}  // namespace careen::python
