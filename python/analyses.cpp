#include "python/analyses.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
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
#include "experiments/scenes/generate_command.h"
#include "experiments/scenes/info_command.h"
#include "experiments/scenes/scene_info.h"
#include "experiments/trade/trade_command.h"
#include "experiments/trade/trade_report.h"
#include "experiments/update/compare_updates.h"
#include "experiments/update/update_command.h"
#include "motions/base/input_error.h"
#include "motions/scene/radii.h"
#include "python/arrays.h"
#include "python/watch.h"

namespace kds::python {

namespace py = pybind11;

namespace {

/// The results of an analysis, before they become objects of Python.
struct Found {
  std::string json, table;
  std::vector<std::string> warnings;

  [[nodiscard]] auto warn() {
    return [this](const std::string& warning) { warnings.push_back(warning); };
  }
  [[nodiscard]] py::dict dict() const {
    py::dict found;
    found["json"] = json;
    found["table"] = table;
    found["warnings"] = warnings;
    return found;
  }
};

/// The default of analyses, because Ctrl-C ends them at once only on one thread.
constexpr std::size_t one_thread = 1;

auto progress_of(Watch& watch) {
  return [&watch](std::size_t done, std::size_t total) { watch.look(done, 0, total); };
}

void refuse_instance(const InputOptions& options) {
  if (const auto instance = read_lone_instance(options))
    throw InputError(instance->file + ": an instance file has no frames; expected a trajectory");
}

/// The columns of all intervals of a report.
struct Intervals {
  std::vector<std::int64_t> first, second;
  std::vector<double> begin_frame, end_frame, begin_time, end_time, length;
  std::vector<std::uint8_t> open_at_start, open_at_end;

  explicit Intervals(const ContactsReport& report) {
    report.intervals.for_each([this](const IntervalRecord& interval) {
      first.push_back(interval.first);
      second.push_back(interval.second);
      begin_frame.push_back(interval.begin_frame);
      end_frame.push_back(interval.end_frame);
      begin_time.push_back(interval.begin_picoseconds);
      end_time.push_back(interval.end_picoseconds);
      length.push_back(interval.length);
      open_at_start.push_back(interval.open_at_start ? 1 : 0);
      open_at_end.push_back(interval.open_at_end ? 1 : 0);
    });
  }
  void move_to(py::dict& found) {
    found["first"] = array_of(std::move(first));
    found["second"] = array_of(std::move(second));
    found["begin_frame"] = array_of(std::move(begin_frame));
    found["end_frame"] = array_of(std::move(end_frame));
    found["begin_time"] = array_of(std::move(begin_time));
    found["end_time"] = array_of(std::move(end_time));
    found["length"] = array_of(std::move(length));
    found["open_at_start"] = array_of(std::move(open_at_start));
    found["open_at_end"] = array_of(std::move(open_at_end));
  }
};

}  // namespace

py::dict contacts(const Arguments& arguments, const py::object& progress) {
  ContactsTask task = parse_contacts_options(arguments).task;
  if (!task.threads) task.threads = one_thread;
  Found found;
  std::vector<std::string> names;
  std::string columns;
  std::unique_ptr<Intervals> intervals;
  {
    Watch watch(progress);
    refuse_instance(task);
    InputOptions loaded = task;
    loaded.at_frame_surveyed = [] { Watch::glance(); };
    if (!task.surface && task.radius == "auto") loaded.radius = "1";  // radii do not matter between centres
    const Scene scene = load_necklaces(loaded, task.motion, 1, found.warn());
    const auto report = follow_contacts(task, scene, progress_of(watch));
    const ContactsFigures figures = figures_of(*report);
    if (figures.all.contacts == 0) found.warnings.emplace_back("there are no contacts within the cutoff");
    Json json;
    add_contacts(*report, figures, json);
    found.json = text_of(json);
    found.table = contacts_text(*report, figures);
    names = report->elements.names;
    columns = contacts_csv(*report, ContactsFigures());
    intervals = std::make_unique<Intervals>(*report);
  }
  py::dict result = found.dict();
  result["names"] = names;
  result["columns"] = columns;
  intervals->move_to(result);
  return result;
}

py::dict compare(const Arguments& arguments, const py::object& progress) {
  CompareOptions options = parse_compare_options(arguments);
  if (!options.threads) options.threads = one_thread;
  Found found;
  {
    Watch watch(progress);
    const Comparison comparison = compare_runs(options, progress_of(watch), found.warn());
    Json json;
    json["pooled"] = pooled_columns().json(pooled_rows(comparison));
    json["rows"] = compare_columns(comparison).json(comparison.rows);
    found.json = text_of(json);
    found.table = compare_table(comparison);
  }
  return found.dict();
}

py::dict update(const Arguments& arguments, const py::object& progress) {
  const UpdateOptions options = parse_update_options(arguments);
  Found found;
  {
    Watch watch(progress);
    refuse_instance(options);
    std::map<std::size_t, FrameSurvey> surveys;  // by stride
    const std::unique_ptr<FrameSource> all = open_frames(options, found.warn());
    surveys.emplace(1, survey_frames(*all, options.radius == "auto", found.warn()));
    const std::vector<double> radii = bead_radii(options.radius, all->necklaces(), surveys.at(1));
    const SceneAtStride scene_at = [&](std::size_t stride, FrameMotion motion) {
      auto frames = open_frames(
          options, [](const std::string&) {}, stride);
      if (!surveys.contains(stride)) surveys.emplace(stride, survey_frames(*frames, false));
      return Scene(std::move(frames), surveys.at(stride), radii, motion);
    };
    const std::vector<UpdateRow> rows = compare_updates(scene_at, options, progress_of(watch));
    Json json;
    json["rows"] = update_columns().json(rows);
    found.json = text_of(json);
    found.table = update_table(rows);
  }
  return found.dict();
}

py::dict collide(const Arguments& arguments, const py::object& progress) {
  const CollideOptions options = parse_collide_options(arguments);
  Found found;
  std::vector<std::int64_t> frame_of_pairs, beads;
  {
    Watch watch(progress);
    refuse_instance(options);
    CollideFrames frames(options, found.warn());
    const CollideTask task = collide_task(options, frames);
    std::vector<FrameFound> in_frames;
    const CollideReport report = compare_detectors(
        frames, task,
        [&](const FrameRead&, const FrameFound& in_frame, std::optional<std::span<const BeadPair>> pairs) {
          in_frames.push_back(in_frame);
          for (const BeadPair& pair : pairs.value_or(std::span<const BeadPair>())) {
            frame_of_pairs.push_back(static_cast<std::int64_t>(in_frame.stamp.number));
            beads.push_back(pair.first);
            beads.push_back(pair.second);
          }
        },
        found.warn(), progress_of(watch));
    Json json;
    json["rows"] = collide_columns(report.timed).json(report.rows);
    json["frames"] = collide_frame_columns(report.timed).json(in_frames);
    found.json = text_of(json);
    found.table = collide_table(report);
  }
  py::dict result = found.dict();
  const auto count = static_cast<py::ssize_t>(frame_of_pairs.size());
  result["frames"] = array_of(std::move(frame_of_pairs));
  result["pairs"] = array_of(std::move(beads), {count, 2});
  return result;
}

py::dict trade(const Arguments& arguments, const py::object& progress) {
  Found found;
  {
    Watch watch(progress);
    const std::vector<TradeRow> rows = measure_trade_of(arguments, progress_of(watch), found.warn());
    Json json;
    json["rows"] = trade_rows_json(rows);
    json["recommendation"] = recommendation(rows);
    found.json = text_of(json);
    found.table = trade_table(rows) + "\n" + recommendation(rows) + "\n";
  }
  return found.dict();
}

py::dict conditions(const Arguments& arguments, const py::object& progress) {
  const InfoOptions options = parse_info_options(arguments);
  Found found;
  {
    Watch watch(progress);
    refuse_instance(options);
    const auto frames = open_frames(options, found.warn());
    const FrameSurvey survey = survey_frames(*frames, options.radius == "auto", found.warn());
    const std::vector<double> radii = bead_radii(options.radius, frames->necklaces(), survey);
    SceneInfo info = describe_frames(frames->heads(), frames->frame_counts(), *frames, radii,
                                     options.validate, progress_of(watch));
    info.first_time = survey.first.picoseconds;
    info.last_time = survey.last.picoseconds;
    info.truncated = survey.truncated;
    Json json;
    add_scene(json, info);
    found.json = text_of(json);
    found.table = scene_table(info);
  }
  return found.dict();
}

py::list generate(const Arguments& arguments) {
  const GenerateOptions options = parse_generate_options(arguments);
  py::list arrays;
  for (const Trajectory& necklace : models::generate(*options.model, options.settings)) {
    std::vector<double> numbers;
    for (const Eigen::Matrix3Xd& frame : necklace.frames)
      numbers.insert(numbers.end(), frame.data(), frame.data() + frame.size());
    arrays.append(array_of(std::move(numbers), {static_cast<py::ssize_t>(necklace.frames.size()),
                                                static_cast<py::ssize_t>(necklace.bead_count()), 3}));
  }
  return arrays;
}

}  // namespace kds::python
