// The extension module kds._kds. Its functions and classes are those that the Python package kds builds on;
// the package documents them.

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "experiments/output/result_json.h"
#include "experiments/output/text.h"
#include "experiments/program/commands.h"
#include "experiments/program/input_options.h"
#include "experiments/program/option_values.h"
#include "kds/kinetic_structure.h"
#include "motions/base/input_error.h"
#include "motions/readers/bead_name.h"
#include "motions/scene/length_unit.h"
#include "python/analyses.h"
#include "python/frames_in_memory.h"
#include "python/impacts.h"
#include "python/paper_measures.h"
#include "python/run_handle.h"
#include "python/static_structures.h"
#include "python/timing.h"
#include "python/watch.h"
#include "structures/session/structure_spec.h"

namespace py = pybind11;

namespace {

using kds::python::FramesInMemory;
using kds::python::RunHandle;
using kds::python::Watch;

void translate_exceptions(py::module_& module) {
  static const py::exception<kds::InputError> input_error(module, "InputError", PyExc_ValueError);
  static const py::exception<kds::AuditError> audit_error(module, "AuditError", PyExc_RuntimeError);
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      std::rethrow_exception(std::move(thrown));
    } catch (const kds::InputError& error) {
      PyErr_SetString(input_error.ptr(), kds::one_line(error.what()).c_str());
    } catch (const kds::AuditError& error) {
      PyErr_SetString(audit_error.ptr(), kds::one_line(error.what()).c_str());
    } catch (const std::invalid_argument& error) {  // such as a bead that a structure does not have
      PyErr_SetString(input_error.ptr(), kds::one_line(error.what()).c_str());
    }
  });
}

/// Returns the options of a command of the program, as its help lists them: name, help, whether it is a flag.
std::vector<std::tuple<std::string, std::string, bool>> options_of(const std::string& command) {
  using Run = int (*)(const kds::Arguments&);
  static const std::map<std::string, Run, std::less<>> commands{
      {"run", kds::run_command},       {"contacts", kds::contacts_command}, {"compare", kds::compare_command},
      {"update", kds::update_command}, {"collide", kds::collide_command},   {"trade", kds::trade_command},
      {"info", kds::info_command},     {"generate", kds::generate_command}, {"surface", kds::surface_command},
      {"voids", kds::voids_command}};
  std::vector<std::tuple<std::string, std::string, bool>> all;
  try {
    commands.at(command)({"--help"});
  } catch (const kds::HelpRequest& help) {
    for (const kds::OptionSpec& option : help.options)
      all.emplace_back(kds::argument(option.name), option.help, option.value.empty());
  }
  return all;
}

std::vector<std::string> structure_names() {
  std::vector<std::string> names;
  for (const kds::StructureSpec& spec : kds::structure_registry().all()) names.push_back(spec.name);
  return names;
}

void bind_frames(py::module_& module) {
  using kds::python::BeadsInMemory;
  py::class_<BeadsInMemory>(module, "Beads")
      .def(py::init([](std::string label) { return BeadsInMemory{.label = std::move(label)}; }),
           py::arg("label"))
      .def_readonly("label", &BeadsInMemory::label)
      .def_readwrite("names", &BeadsInMemory::names)
      .def_readwrite("elements", &BeadsInMemory::elements)
      .def_readwrite("radii", &BeadsInMemory::radii)
      .def_readwrite("groups", &BeadsInMemory::groups)
      .def_readwrite("first_frame", &BeadsInMemory::first_frame)
      .def_readwrite("frame_step", &BeadsInMemory::frame_step)
      .def_readwrite("times", &BeadsInMemory::times)
      .def_readwrite("cells", &BeadsInMemory::cells)
      .def_readwrite("nanometres", &BeadsInMemory::nanometres)
      .def("add_chain", [](BeadsInMemory& beads, std::string name, std::size_t count) {
        kds::ChainRead& chain = beads.chains.emplace_back();
        chain.name = std::move(name);
        chain.bead_count = count;
      });
  py::class_<FramesInMemory, std::shared_ptr<FramesInMemory>>(module, "Frames")
      .def(py::init<const py::array&, const std::optional<py::array>&, BeadsInMemory>(), py::arg("positions"),
           py::arg("velocities"), py::arg("beads"))
      .def(py::init<py::function, std::size_t, std::size_t, BeadsInMemory>(), py::arg("frame"),
           py::arg("frame_count"), py::arg("bead_count"), py::arg("beads"))
      .def_property_readonly("path", [](const FramesInMemory& frames) { return frames.path().string(); });
}

void bind_run(py::module_& module) {
  using kds::python::PythonOptions;
  py::class_<PythonOptions>(module, "MoreOptions")
      .def(py::init<>())
      .def_readwrite("only", &PythonOptions::only);
  py::class_<RunHandle>(module, "Run")
      .def(py::init([](const kds::Arguments& arguments, const PythonOptions& more,
                       const std::shared_ptr<FramesInMemory>& memory) {
             const Watch watch;
             return std::make_unique<RunHandle>(arguments, more, memory);
           }),
           py::arg("arguments"), py::arg("more"), py::arg("memory"))
      .def(py::init([](const kds::Arguments& arguments, const PythonOptions& more, int dimension,
                       std::vector<std::size_t> necklaces, std::vector<double> radii,
                       const std::vector<double>& cell) {
             kds::PushedFrames frames;
             frames.cell = kds::python::cell_given(cell, dimension);
             frames.dimension = dimension;
             frames.necklaces = std::move(necklaces);
             frames.radii = std::move(radii);
             return std::make_unique<RunHandle>(arguments, more, std::move(frames));
           }),
           py::arg("arguments"), py::arg("more"), py::arg("dimension"), py::arg("necklaces"),
           py::arg("radii"), py::arg("cell"))
      .def("execute", &RunHandle::execute, py::arg("progress") = py::none())
      .def("write_view", &RunHandle::write_view)
      .def("write_log", &RunHandle::write_log)
      .def(
          "push",
          [](RunHandle& run, const RunHandle::Frame& frame, std::optional<double> picoseconds,
             const std::vector<double>& cell) {
            run.push(frame, picoseconds, kds::python::cell_given(cell, run.scene().dimension()));
          },
          py::arg("frame"), py::arg("picoseconds"), py::arg("cell"))
      .def("build", &RunHandle::build)
      .def("step", &RunHandle::step)
      .def("next_event", &RunHandle::next_event)
      .def("go_to", &RunHandle::go_to)
      .def("finish", &RunHandle::finish)
      .def("audit", &RunHandle::audit)
      .def("insert", &RunHandle::insert)
      .def("erase", &RunHandle::erase)
      .def("bend", &RunHandle::bend)
      .def("control_points", &RunHandle::control_points)
      .def("cell_points", &RunHandle::cell_points)
      .def("time", &RunHandle::time)
      .def("fingerprint", &RunHandle::fingerprint)
      .def("edges", &RunHandle::edges, py::arg("time") = py::none())
      .def("contacts", &RunHandle::contacts, py::arg("time") = py::none())
      .def("spheres", &RunHandle::spheres, py::arg("structure"), py::arg("time") = py::none())
      .def("elements", &RunHandle::elements)
      .def("take_events", &RunHandle::take_events)
      .def("keep_events", &RunHandle::keep_events)
      .def("structures", &RunHandle::structures)
      .def("warnings", &RunHandle::warnings)
      .def("table", &RunHandle::table, py::arg("progress") = py::none())
      .def("json", &RunHandle::json)
      .def("stamp", &RunHandle::stamp)
      .def("stamps", &RunHandle::stamps)
      .def("bead_names", &RunHandle::bead_names)
      .def_property_readonly("apart", &RunHandle::apart)
      .def_property_readonly("contact_distance",
                             [](const RunHandle& run) {
                               const kds::ContactDistance distance = run.contact_distance();
                               return std::pair(distance.length, distance.between_surfaces);
                             })
      .def_property_readonly("radii", [](const RunHandle& run) { return run.scene().radii(); })
      .def_property_readonly("bead_count", [](const RunHandle& run) { return run.scene().bead_count(); })
      .def_property_readonly("frame_count", [](const RunHandle& run) { return run.scene().frame_count(); })
      .def("leave", &RunHandle::leave)
      .def_property_readonly("is_live", [](const RunHandle& run) { return run.scene().is_live(); })
      .def("live_warnings", [](const RunHandle& run) { return run.scene().live_warnings(); })
      .def_property_readonly("dimension", [](const RunHandle& run) { return run.scene().dimension(); })
      .def_property_readonly("degree", [](const RunHandle& run) { return run.scene().degree(); })
      .def_property_readonly("necklaces", [](const RunHandle& run) {
        std::vector<std::size_t> counts;
        for (const kds::BeadRange& range : run.scene().necklaces())
          counts.push_back(range.last - range.first + 1);
        return counts;
      });
}

}  // namespace

PYBIND11_MODULE(_kds, module) {
  kds::set_interface(kds::Interface::python);
  translate_exceptions(module);
  kds::python::add_memory_reader();
  bind_frames(module);
  bind_run(module);
  module.def("bead_name", [](std::string atom, std::string residue, std::string number, std::string chain) {
    return kds::text_of(
        kds::BeadName{std::move(atom), std::move(residue), std::move(number), std::move(chain)});
  });
  module.def("nanometres_doubt", [](const kds::python::Numbers& chain) {  // beads in rows
    return kds::nanometres_doubt(Eigen::Map<const Eigen::Matrix3Xd>(chain.data(), 3, chain.size() / 3));
  });
  module.def("options_of", options_of);
  module.def("suggestion", [](std::string_view word, const std::vector<std::string>& names) {
    return kds::suggestion(word, std::vector<std::string_view>(names.begin(), names.end()));
  });
  module.def("structure_names", structure_names);
  module.def("version", kds::program_version);
  module.def("data_folder", [] { return kds::source_data_folder().string(); });
  module.def("contacts", kds::python::contacts);
  module.def("replay", kds::python::replay);
  module.def("surface", kds::python::surface);
  module.def("voids", kds::python::voids);
  module.def("compare", kds::python::compare);
  module.def("update", kds::python::update);
  module.def("collide", kds::python::collide);
  module.def("trade", kds::python::trade);
  module.def("conditions", kds::python::conditions);
  module.def("generate", kds::python::generate);
  module.def("read_positions", kds::python::read_positions);
  module.def("power_diagram", kds::python::power_diagram);
  module.def("enclosing_sphere", kds::python::enclosing_sphere);
  module.def("wrapped_hierarchy", kds::python::wrapped_hierarchy);
  module.def("layered_hierarchy", kds::python::layered_hierarchy);
  module.def("separating_family", kds::python::separating_family);
  module.def("closest_by_diagram", kds::python::closest_by_diagram);
  module.def("trusted_hierarchy", kds::python::trusted_hierarchy);
  module.def("colliding_pairs", kds::python::colliding_pairs);
  module.def("closest_pair", kds::python::closest_pair_of);
  module.def("impacts", kds::python::impacts);
  module.attr("highest_degree_of_impacts") = kds::ImpactSearch::highest_degree;
  kds::python::bind_timing(module);
}
