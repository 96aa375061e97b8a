/// ambrig._core: rigs, scenarios, runs and commands for Python. What a user sees is python/ambrig.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "app/json/run_json.h"
#include "core/base/memory_reuse.h"
#include "core/base/toml_edit.h"
#include "core/math/no_solution.h"
#include "core/record/hdf5.h"
#include "python/module/background.h"
#include "python/module/call_command.h"
#include "rig/rig_file.h"
#include "simulation/simulate.h"
#include "simulation/verdict/expect.h"

namespace ambrig::python {

namespace {

namespace py = pybind11;

/// An array that owns the samples: no copy, freed with the array.
py::array_t<double> Owned(std::vector<double>&& samples) {
  auto* kept = new std::vector<double>(std::move(samples));
  const py::capsule owner(kept, [](void* p) { delete static_cast<std::vector<double>*>(p); });
  return py::array_t<double>(static_cast<py::ssize_t>(kept->size()), kept->data(), owner);
}

/// {"rate", "start", "attributes", "channels": {name: (unit, array)}}
py::dict RecordToPython(Record&& r) {
  py::dict channels, out;
  for (Channel& c : r.channels)
    channels[py::str(c.name)] = py::make_tuple(c.unit, Owned(std::move(c.samples)));
  out["rate"] = r.rate;
  out["start"] = r.start;
  out["attributes"] = r.attributes;
  out["channels"] = channels;
  return out;
}

Record RecordFromPython(const py::dict& d) {
  Record r;
  r.rate = d["rate"].cast<double>();
  r.start = d["start"].cast<double>();
  r.attributes = d["attributes"].cast<std::map<std::string, std::string>>();
  for (const auto& [name, value] : d["channels"].cast<py::dict>()) {
    const auto pair = value.cast<py::tuple>();
    const auto samples =
        pair[1].cast<py::array_t<double, py::array::c_style | py::array::forcecast>>();
    r.channels.push_back({name.cast<std::string>(), pair[0].cast<std::string>(),
                          std::vector<double>(samples.data(), samples.data() + samples.size())});
  }
  return r;
}

py::tuple Run(const RigParameters& rig, const Scenario& scenario, const std::string& fidelity,
              double rate, const py::object& progress) {
  std::atomic<bool> stop{false};
  Watch watch;
  watch.stop = &stop;
  SimulateOptions options;
  options.fidelity = FidelityByName(fidelity);
  options.record_rate = rate;
  options.stop = &stop;
  options.progress = [&](double f) { watch.fraction = f; };
  RunResult result;
  std::string json;
  InBackground(
      [&] {
        result = Simulate(rig, scenario, options);
        json = RunJson(scenario, result, CheckExpectations(scenario, result)).dump();
      },
      watch, progress);
  return py::make_tuple(RecordToPython(std::move(result.record)), json);
}

std::string Edited(const std::string& text, const std::string& file, const std::string& path,
                   const std::string& literal) {
  return EditedToml(text, file, {{path, TomlLiteral{literal}}});
}

/// Classes of python/ambrig/errors.py, which says them.
struct Exceptions {
  py::object input, no_solution;
};

Exceptions& Raised() {
  static auto* const classes = new Exceptions;  // never destroyed: the interpreter may be gone
  return *classes;
}

void Translate(std::exception_ptr error) {
  try {
    if (error) std::rethrow_exception(error);
  } catch (const InputError& e) {
    PyErr_SetString(Raised().input.ptr(), e.what());
  } catch (const NoSolution& e) {
    PyErr_SetString(Raised().no_solution.ptr(), e.what());
  } catch (const Interrupted&) {
    PyErr_SetNone(PyExc_KeyboardInterrupt);
  }
}

}  // namespace

PYBIND11_MODULE(_core, m) {
  KeepFreedMemory();
  m.doc() = "the compiled part of ambrig";
  m.def("set_exceptions", [](const py::object& input, const py::object& no_solution) {
    Raised() = {input, no_solution};
  });
  py::register_exception_translator(Translate);
  py::class_<RigParameters>(m, "Rig")
      .def(py::init(&ReadRigText), py::arg("text"), py::arg("file"))
      .def_readonly("name", &RigParameters::name)
      .def_property_readonly("axes", [](const RigParameters& r) {
        std::vector<std::string> axes;
        for (const BearingParameters& b : r.bearings)
          for (const std::string& a : b.Axes()) axes.push_back(a);
        return axes;
      });
  py::class_<Scenario>(m, "Scenario")
      .def(py::init(&ReadScenarioText), py::arg("text"), py::arg("file"), py::arg("rig"))
      .def_readonly("name", &Scenario::name)
      .def_readonly("duration", &Scenario::duration);
  m.def("run", &Run, py::arg("rig"), py::arg("scenario"), py::arg("fidelity"), py::arg("rate"),
        py::arg("progress"));
  m.def("command", &CallCommand, py::arg("arguments"), py::arg("progress"));
  m.def("edited", &Edited, py::arg("text"), py::arg("file"), py::arg("path"), py::arg("literal"));
  m.def("has_path", &HasTomlPath, py::arg("text"), py::arg("file"), py::arg("path"));
  m.def("with_absolute_files", &WithAbsoluteFiles, py::arg("text"), py::arg("file"));
  m.def("rig_of_scenario", &RigOfScenario, py::arg("file"));
  m.def("read_hdf5", [](const std::string& path) { return RecordToPython(ReadHdf5(path)); });
  m.def("write_hdf5", [](const py::dict& record, const std::string& path) {
    WriteHdf5(RecordFromPython(record), path);
  });
}

}  // namespace ambrig::python
