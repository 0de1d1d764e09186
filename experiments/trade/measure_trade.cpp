#include "experiments/trade/measure_trade.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <malloc.h>

#include <algorithm>

#include "experiments/program/timing.h"
#include "kds/stopwatch.h"
#include "motions/base/input_error.h"
#include "structures/session/kinetic_run.h"
#include "structures/session/parallel_run.h"

namespace kds {

namespace {

std::uint64_t bytes_in_use() {
  const struct mallinfo2 info = ::mallinfo2();
  return info.uordblks + info.hblkhd;
}

/// Runs once without examining the run, and returns the seconds. Adds the counts to `cost`.
double seconds_of_one(const Scene& scene, const TradeSetting& setting, TradeCost& cost) {
  const std::uint64_t before = bytes_in_use();
  std::vector<std::string> structures = setting.besides;
  structures.push_back(setting.structure);
  KineticRun run(scene, {std::move(structures), setting.kernel, AuditMode::none, setting.settings});
  run.build();
  // A step may take less than a reading of the clock. So all steps are timed at once, less the loading of
  // frames; build() has loaded the first.
  const double with_loading = processor_seconds_of([&] {
    while (run.load_step()) run.run_step();
  });
  run.finish();
  const double loading = processor_seconds_of([&] {
    for (std::size_t step = 1; step < scene.step_count(); ++step) run.motion()->load(step);
  });
  const std::uint64_t after = bytes_in_use();
  cost.memory = std::max(cost.memory, after > before ? after - before : 0);
  for (const KineticStructure* const structure : run.structures()) {
    cost.certificates += structure->statistics.certificates.created;
    for (std::size_t kind = 0; kind < structure->kinds().size(); ++kind)
      if (structure->kinds()[kind].external) cost.events += structure->statistics.events_by_kind[kind];
  }
  // Steps too quick to be told from loading count with it.
  return with_loading > loading ? with_loading - loading : with_loading;
}

/// Performs all runs that the setting takes and returns their seconds. Stores the counts in `cost`.
double seconds_to_run(const FinestData& finest, const TradeSetting& setting, TradeCost& cost) {
  const Scene scene = finest.scene(setting);
  cost.certificates = cost.events = 0;
  double seconds = seconds_of_one(scene, setting, cost);
  if (!setting.certify) return seconds;
  StrideDeviation deviation;
  seconds += processor_seconds_of([&] { deviation = finest.deviation(setting, scene); });
  if (setting.structure != "contacts") return seconds;
  const std::uint64_t events = cost.events;
  RadiiWithin radii = radii_within(deviation, scene.radii());
  for (std::vector<double>* const some : {&radii.larger, &radii.smaller})
    seconds += seconds_of_one(finest.scene(setting, std::move(*some)), setting, cost);
  cost.events = events;  // the other runs only bound the contacts
  return seconds;
}

/// Returns a message that says why the exact run of `want` is impossible for the input, and which options
/// avoid the problem.
std::string without(Want want, const FinestData& finest, const TradeSetting& exact, const TradeTask& task,
                    const std::string& reason) {
  std::vector<std::string_view> others;
  for (const Want other : task.wants)
    if (other != want) others.push_back(name_of(other));
  return fmt::format("{}: `{}`, the exact run of {} {}, is not possible: {}{}", finest.file(),
                     words_of(exact), "--want"_arg, name_of(want), reason,
                     others.empty() ? std::string()
                                    : fmt::format("; expected {} {}, which works without it", "--want"_arg,
                                                  fmt::join(others, ",")));
}

/// Scenes have no errors: they are different tasks rather than different answers to one task.
bool has_errors(const TradeGroup& group) { return group.want != Want::scenes; }

bool is_as_good(const TradeRow& a, const TradeRow& b) {
  const std::vector<double> of_a = main_errors(a), of_b = main_errors(b);
  if (of_a.empty()) return false;
  constexpr double clearly = 0.97;  // allows for noise in the times
  bool better = a.cost.ratio < clearly * b.cost.ratio;
  if (a.cost.ratio > b.cost.ratio) return false;
  for (std::size_t k = 0; k < of_a.size(); ++k) {
    if (of_a[k] > of_b[k]) return false;
    better |= of_a[k] < of_b[k];
  }
  return better;
}

void mark_front(std::span<TradeRow> rows) {
  for (TradeRow& row : rows)
    row.on_front =
        !main_errors(row).empty() &&
        std::none_of(rows.begin(), rows.end(), [&](const TradeRow& other) { return is_as_good(other, row); });
}

}  // namespace

std::vector<double> main_errors(const TradeRow& row) {
  const TradeErrors& e = row.errors;
  const auto known = [](std::initializer_list<std::optional<double>> errors) {
    std::vector<double> values;
    for (const std::optional<double>& error : errors) {
      if (!error) return std::vector<double>();
      values.push_back(*error);
    }
    return values;
  };
  switch (row.want) {
    case Want::contacts:
      return known({e.contacts_missed, e.contacts_spurious});
    case Want::cages:
      return known({e.radius_mean, e.beads_outside});
    case Want::diagram:
      return known({e.cells_wrong});
    case Want::events:
      return known({e.events_missed, e.events_invented});
    case Want::scenes:
      return {};
  }
  return {};
}

std::vector<TradeRow> measure_trade(const FinestData& finest, const TradeTask& task,
                                    const std::function<void(std::size_t, std::size_t)>& progress,
                                    const std::function<void(const std::string&)>& warn) {
  std::vector<TradeGroup> groups;
  std::size_t total = 0, done = 0;
  TradeInput input = finest.input();
  input.exact_kernel = task.exact_kernel;
  input.range = task.frames;
  for (const Want want : task.wants) {
    for (TradeGroup& group : groups_for(want, input, task.apart)) {
      total += group.settings.size() * (task.rounds + 1);
      groups.push_back(std::move(group));
    }
  }
  const Scene truest = finest.scene();
  const double largest = *std::max_element(finest.radii().begin(), finest.radii().end());
  const std::unique_ptr<Truth> truth =
      make_truth(truest, {truest.necklaces(), true, task.apart, true, input.groups, truest.at_rest()});
  std::vector<TradeRow> all;
  for (const TradeGroup& group : groups) {
    std::vector<TradeRow> rows;
    RunHistory exact;
    std::vector<double> ends;
    const auto measure = [&](const TradeSetting& setting) {
      TradeRow row{group.want, setting, {}, {}, rows.empty()};
      if (!has_errors(group)) {
        static_cast<void>(seconds_to_run(finest, setting, row.cost));
        return std::pair(std::move(row), 1.0);
      }
      FollowedRun run = follow_run(finest, setting, *truth, task.sampling, task.cutoff.value_or(4 * largest),
                                   task.threads.value_or(all_threads()));
      if (rows.empty()) exact = run.history;
      if (setting.has_events()) compare_histories(exact, run, finest, setting);
      row.errors = run.errors;
      row.cost.tests = run.tests;
      return std::pair(std::move(row), run.history.end);
    };
    for (const TradeSetting& setting : group.settings) {
      try {
        auto [row, end] = measure(setting);
        rows.push_back(std::move(row));
        ends.push_back(end);
        progress(++done, total);
      } catch (const InputError& error) {
        if (rows.empty()) throw InputError(without(group.want, finest, setting, task, error.what()));
        warn(fmt::format("`{}` is left out: {}", words_of(setting), error.what()));
        done += task.rounds + 1;
      }
    }
    std::vector<std::vector<double>> seconds(rows.size());
    for (std::size_t round = 0; round < task.rounds; ++round) {
      for (std::size_t k = 0; k < rows.size(); ++k) {
        seconds[k].push_back(seconds_to_run(finest, rows[k].setting, rows[k].cost));
        progress(++done, total);
      }
    }
    for (std::size_t k = 0; k < rows.size(); ++k) {
      TradeCost& cost = rows[k].cost;
      cost.seconds = median_of(seconds[k]);
      cost.quickest = *std::min_element(seconds[k].begin(), seconds[k].end());
      cost.slowest = *std::max_element(seconds[k].begin(), seconds[k].end());
      // A stride may stop before the last frame.
      const double share = ends[k] / ends.front();
      cost.ratio = cost.seconds / (share * rows.front().cost.seconds);
    }
    mark_front(rows);
    std::move(rows.begin(), rows.end(), std::back_inserter(all));
  }
  return all;
}

}  // namespace kds
