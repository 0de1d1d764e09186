#include "python/analyses.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "experiments/collide/collide_command.h"
#include "experiments/collide/collide_report.h"
#include "experiments/collide/compare_detectors.h"
#include "experiments/compare/compare_report.h"
#include "experiments/compare/compare_runs.h"
#include "experiments/contacts/contacts_command.h"
#include "experiments/contacts/contacts_report.h"
#include "experiments/output/result_json.h"
#include "experiments/run/load_scene.h"
#include "experiments/run/replay_command.h"
#include "experiments/scenes/generate_command.h"
#include "experiments/scenes/info_command.h"
#include "experiments/scenes/scene_info.h"
#include "experiments/surface/surface_command.h"
#include "experiments/trade/trade_command.h"
#include "experiments/trade/trade_report.h"
#include "experiments/update/compare_updates.h"
#include "experiments/update/update_command.h"
#include "experiments/voids/follow_voids.h"
#include "experiments/voids/voids_command.h"
#include "motions/base/input_error.h"
#include "motions/base/interruption.h"
#include "motions/readers/read_trajectory.h"
#include "motions/scene/radii.h"
#include "python/arrays.h"
#include "python/watch.h"

namespace kds::python {

namespace py = pybind11;

namespace {

/// The results of an analysis, before they become objects of Python.
struct Found {
  Json json;
  std::string table;
};

using Warn = std::function<void(const std::string&)>;
using Progress = std::function<void(std::size_t done, std::size_t total)>;

/// Calls `find(progress, warn)`, which returns a Found, without the GIL. Returns the results as a dictionary.
/// `reads_live` is that of Watch.
template <class Find>
py::dict run_analysis(const py::object& progress, const Find& find, bool reads_live = false) {
  std::vector<std::string> warnings;
  std::string json, table;
  {
    if (reads_live) withdraw_live_end();
    Watch watch(progress, reads_live);
    const Found found =
        find(Progress([&](std::size_t done, std::size_t total) { watch.look(done, 0, total); }),
             Warn([&](const std::string& warning) { warnings.push_back(warning); }));
    json = text_of(found.json);
    table = found.table;
  }
  py::dict result;
  result["json"] = json;
  result["table"] = table;
  result["warnings"] = warnings;
  return result;
}

/// The columns of all intervals of a report.
struct Intervals {
  std::vector<std::int64_t> first, second;
  std::vector<double> begin_frame, end_frame, begin_time, end_time, begin_step, end_step, length;
  std::vector<std::uint8_t> open_at_start, open_at_end;

  explicit Intervals(const ContactsReport& report) {
    for (const IntervalRecord& interval : report.intervals) {
      first.push_back(interval.first);
      second.push_back(interval.second);
      begin_frame.push_back(interval.begin_frame);
      end_frame.push_back(interval.end_frame);
      begin_time.push_back(interval.begin_picoseconds);
      end_time.push_back(interval.end_picoseconds);
      begin_step.push_back(interval.begin);
      end_step.push_back(interval.end);
      length.push_back(interval.length);
      open_at_start.push_back(interval.open_at_start ? 1 : 0);
      open_at_end.push_back(interval.open_at_end ? 1 : 0);
    }
  }
  void move_to(py::dict& found) {
    found["first"] = array_of(std::move(first));
    found["second"] = array_of(std::move(second));
    found["begin_frame"] = array_of(std::move(begin_frame));
    found["end_frame"] = array_of(std::move(end_frame));
    found["begin_time"] = array_of(std::move(begin_time));
    found["end_time"] = array_of(std::move(end_time));
    found["begin_step"] = array_of(std::move(begin_step));
    found["end_step"] = array_of(std::move(end_step));
    found["length"] = array_of(std::move(length));
    found["open_at_start"] = array_of(std::move(open_at_start));
    found["open_at_end"] = array_of(std::move(open_at_end));
  }
};

}  // namespace

py::dict contacts(const Arguments& arguments, const py::object& progress) {
  const ContactsTask task = parse_contacts_options(arguments).task;
  std::vector<std::string> names;
  std::string columns;
  std::unique_ptr<Intervals> intervals;
  std::vector<std::int64_t> frame_numbers;
  py::dict result = run_analysis(
      progress,
      [&](const Progress& look, const Warn& warn) {
        ContactsFound contacts = find_contacts(task, look, warn);
        Found found;
        add_contacts(*contacts.report, contacts.figures, found.json);
        found.table = contacts_text(*contacts.report, contacts.figures);
        names = contacts.report->elements.names;
        contacts.figures.pairs.clear();
        columns = contacts_csv(*contacts.report, contacts.figures);
        intervals = std::make_unique<Intervals>(*contacts.report);
        const std::size_t steps = contacts.report->steps, first = contacts.report->first_frame;
        for (std::size_t k = 0; k <= steps; ++k)
          frame_numbers.push_back(static_cast<std::int64_t>(
              first + k * (contacts.report->last_frame - first) / std::max<std::size_t>(steps, 1)));
        return found;
      },
      is_live(task));
  result["names"] = names;
  result["columns"] = columns;
  result["frame_numbers"] = array_of(std::move(frame_numbers));
  intervals->move_to(result);
  return result;
}

py::dict replay(const Arguments& arguments, const py::object& progress) {
  return run_analysis(progress, [&](const Progress& show, const Warn& warn) {
    const ReplayReport replay = replay_log(
        arguments.at(0), [&](std::size_t done, double, std::size_t total) { show(done, total); }, warn);
    return Found{parse_json(replay_json(replay, arguments[0])), comparison_table(replay.run)};
  });
}

py::dict compare(const Arguments& arguments, const py::object& progress) {
  const CompareOptions options = parse_compare_options(arguments);
  return run_analysis(
      progress,
      [&](const Progress& look, const Warn& warn) {
        const Comparison comparison = compare_runs(options, look, warn);
        Found found;
        found.json["pooled"] = pooled_columns().json(pooled_rows(comparison));
        found.json["rows"] = compare_columns(comparison).json(comparison.rows);
        found.table = compare_table(comparison);
        return found;
      },
      is_live(options));
}

py::dict update(const Arguments& arguments, const py::object& progress) {
  const UpdateOptions options = parse_update_options(arguments);
  return run_analysis(progress, [&](const Progress& look, const Warn& warn) {
    const std::vector<UpdateRow> rows = measure_updates(options, look, warn);
    return Found{{{"rows", update_columns().json(rows)}}, update_table(rows)};
  });
}

py::dict surface(const Arguments& arguments, const py::object& progress) {
  const SurfaceTask task = parse_surface_options(arguments).task;
  std::vector<double> frames, areas, volumes, contact_areas;
  std::vector<std::int64_t> contact_times, contacts, residue_of, chain_of;
  std::vector<std::string> names, residue_names, chain_names;
  py::dict result = run_analysis(progress, [&](const Progress& look, const Warn& warn) {
    SurfaceReport report = measure_surface(task, true, look, warn);
    for (std::size_t t = 0; t < report.frames.size(); ++t) {
      SurfaceFrame& frame = report.frames[t];
      frames.push_back(frame.frame);
      areas.insert(areas.end(), frame.measures.areas.begin(), frame.measures.areas.end());
      volumes.insert(volumes.end(), frame.measures.volumes.begin(), frame.measures.volumes.end());
      contact_times.insert(contact_times.end(), frame.edges.size(), static_cast<std::int64_t>(t));
      for (const auto& edge : frame.edges) contacts.insert(contacts.end(), edge.begin(), edge.end());
      contact_areas.insert(contact_areas.end(), frame.measures.contacts.begin(),
                           frame.measures.contacts.end());
      frame.measures = {};
      frame.edges = {};
    }
    for (BeadId bead = 0; bead < report.scene->bead_count(); ++bead)
      names.push_back(report.scene->bead_name(bead));
    residue_of.assign(names.size(), -1);
    if (report.residues) {
      residue_of.assign(report.residues->of_bead.begin(), report.residues->of_bead.end());
      residue_names = report.residues->names;
    }
    chain_of.assign(report.chains.of_bead.begin(), report.chains.of_bead.end());
    chain_names = report.chains.names;
    Found found;
    add_surface(report, found.json);
    found.table = surface_text(report);
    return found;
  });
  const auto times = static_cast<py::ssize_t>(frames.size()), beads = static_cast<py::ssize_t>(names.size()),
             count = static_cast<py::ssize_t>(contact_times.size());
  result["frames"] = array_of(std::move(frames));
  result["areas"] = array_of(std::move(areas), {times, beads});
  result["volumes"] = array_of(std::move(volumes), {times, beads});
  result["contact_times"] = array_of(std::move(contact_times));
  result["contacts"] = array_of(std::move(contacts), {count, 2});
  result["contact_areas"] = array_of(std::move(contact_areas));
  result["names"] = names;
  result["residue_of"] = array_of(std::move(residue_of));
  result["residue_names"] = residue_names;
  result["chain_of"] = array_of(std::move(chain_of));
  result["chain_names"] = chain_names;
  return result;
}

py::dict voids(const Arguments& arguments, const py::object& progress) {
  const VoidsTask task = parse_voids_options(arguments).task;
  return run_analysis(progress, [&](const Progress& look, const Warn& warn) {
    const VoidsReport report = follow_voids(task, false, look, warn);
    Found found;
    add_voids(report, found.json);
    found.table = voids_text(report);
    return found;
  });
}

py::dict collide(const Arguments& arguments, const py::object& progress) {
  const CollideOptions options = parse_collide_options(arguments);
  std::vector<std::int64_t> frame_of_pairs, beads;
  py::dict result = run_analysis(progress, [&](const Progress& look, const Warn& warn) {
    refuse_instance(options);
    CollideFrames frames(options, warn);
    const CollideTask task = collide_task(options, frames);
    std::vector<FrameFound> in_frames;
    const CollideReport report = compare_detectors(
        frames, task,
        [&](const FrameRead&, const FrameFound& in_frame, std::span<const BeadPair> pairs) {
          in_frames.push_back(in_frame);
          for (const BeadPair& pair : pairs) {
            frame_of_pairs.push_back(static_cast<std::int64_t>(in_frame.stamp.number));
            beads.push_back(pair.first);
            beads.push_back(pair.second);
          }
        },
        warn, look);
    Found found;
    found.json["rows"] = collide_columns(report.timed).json(report.rows);
    found.json["frames"] = collide_frame_columns(report.timed).json(in_frames);
    found.table = collide_table(report);
    return found;
  });
  const auto count = static_cast<py::ssize_t>(frame_of_pairs.size());
  result["frames"] = array_of(std::move(frame_of_pairs));
  result["pairs"] = array_of(std::move(beads), {count, 2});
  return result;
}

py::dict trade(const Arguments& arguments, const py::object& progress) {
  return run_analysis(progress, [&](const Progress& look, const Warn& warn) {
    const std::vector<TradeRow> rows = measure_trade_of(arguments, look, warn);
    Found found;
    found.json["rows"] = trade_rows_json(rows);
    found.json["recommendation"] = recommendation(rows);
    found.table = trade_table(rows) + "\n" + recommendation(rows) + "\n";
    return found;
  });
}

py::dict conditions(const Arguments& arguments, const py::object& progress) {
  const InfoOptions options = parse_info_options(arguments);
  return run_analysis(progress, [&](const Progress& look, const Warn& warn) {
    refuse_instance(options);
    const SceneInfo info = describe_input(options, look, warn);
    Found found;
    add_scene(found.json, info);
    found.table = scene_table(info);
    return found;
  });
}

namespace {

py::list arrays_of(const std::vector<Trajectory>& necklaces) {
  py::list arrays;
  for (const Trajectory& necklace : necklaces) {
    std::vector<double> all;
    for (const Eigen::Matrix3Xd& frame : necklace.frames)
      all.insert(all.end(), frame.data(), frame.data() + frame.size());
    arrays.append(array_of(std::move(all), {static_cast<py::ssize_t>(necklace.frames.size()),
                                            static_cast<py::ssize_t>(necklace.bead_count()), 3}));
  }
  return arrays;
}

}  // namespace

py::list generate(const Arguments& arguments) {
  const GenerateOptions options = parse_generate_options(arguments);
  std::vector<Trajectory> necklaces;
  {
    const Watch watch;
    necklaces = models::generate(*options.model, options.settings);
  }
  return arrays_of(necklaces);
}

py::object read_positions(const std::string& path, const std::optional<std::string>& topology) {
  for (const std::string& file : {path, topology.value_or(path)}) {
    if (file.find('\0') != std::string::npos)
      throw InputError(fmt::format("{}: has a null character, expected a path", file.c_str()));
    std::error_code error;
    if (!std::filesystem::exists(file, error)) throw InputError(fmt::format("'{}': no such file", file));
  }
  std::vector<Trajectory> necklaces;
  {
    const Watch watch;
    ReadOptions options;
    if (topology) options.topology = *topology;
    necklaces.push_back(read_trajectory(path, options));
  }
  return arrays_of(necklaces)[0];
}

}  // namespace kds::python
