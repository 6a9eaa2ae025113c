#include "python/src/handles.h"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

namespace py = pybind11;

namespace oriel::python {

namespace {

std::string place_of(const Place& place) {
  std::string text = place.file;
  if (place.line > 0) text += ":" + std::to_string(place.line);
  if (place.column > 0) text += ":" + std::to_string(place.column);
  for (const std::string& part : {place.building, place.feature})
    if (!part.empty()) text += (text.empty() ? "" : " ") + part;
  return text;
}

/// Raises oriel.Error of what was found.
void raise(const std::vector<Issue>& issues) {
  const py::object error = py::module_::import("oriel.errors").attr("Error");
  PyErr_SetObject(error.ptr(), error(issues).ptr());
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const InputError& error) {
    raise({error.issue()});
  } catch (const OutputError& error) {
    raise({error.issue()});
  } catch (const GeometryError& error) {
    raise({building_issue(Severity::error, Code::E901, "", error.what())});
  }
}

}  // namespace

void bind_issues(py::module_& module) {
  py::class_<Place>(module, "Place",
                    "Where a finding is: in a text (file, line and column, counted from 1, 0 is "
                    "unknown), in a model (building, feature), or both.")
      .def_readonly("file", &Place::file)
      .def_readonly("line", &Place::line)
      .def_readonly("column", &Place::column)
      .def_readonly("building", &Place::building)
      .def_readonly("feature", &Place::feature)
      .def("__str__", &place_of)
      .def("__repr__", [](const Place& place) { return "<oriel.Place " + place_of(place) + ">"; });
  py::class_<Issue>(module, "Issue",
                    "A finding about data or rules. str() is the line that the command prints.")
      .def_property_readonly(
          "severity", [](const Issue& issue) { return to_string(issue.severity); },
          "'error', 'warning' or 'note'.")
      .def_property_readonly(
          "code", [](const Issue& issue) { return to_string(issue.code); },
          "'E101', 'R204' ...: docs/errors.md and docs/rules.md.")
      .def_readonly("sentence", &Issue::sentence)
      .def_readonly("place", &Issue::place)
      .def_readonly("excerpt", &Issue::excerpt,
                    "The source line with a caret below the place, or empty.")
      .def("__str__", [](const Issue& issue) { return to_string(issue); })
      .def("__repr__", [](const Issue& issue) {
        return "<oriel.Issue " + to_string(issue.severity) + ": " + to_string(issue) + ">";
      });
  py::register_exception_translator(&translate);
}

}  // namespace oriel::python

PYBIND11_MODULE(_oriel, module) {
  module.doc() = "The functions of oriel's front door; import oriel gives them their Python form.";
  module.attr("__version__") = ORIEL_PYTHON_VERSION;
  oriel::python::bind_issues(module);
  oriel::python::bind_buildings(module);
  oriel::python::bind_stages(module);
  oriel::python::bind_features(module);
  oriel::python::bind_score(module);
  oriel::python::bind_learning(module);
}
