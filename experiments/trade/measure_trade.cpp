#include "experiments/trade/measure_trade.h"

#include <malloc.h>

#include <algorithm>

#include "experiments/program/timing.h"
#include "kds/seconds.h"

namespace kds {

namespace {

std::uint64_t bytes_in_use() {
  const struct mallinfo2 info = ::mallinfo2();
  return info.uordblks + info.hblkhd;
}

/// One run without a look at it; counts are taken by `cost`.
double seconds_to_run(const Scene& scene, const TradeSetting& setting, TradeCost& cost) {
  const std::uint64_t before = bytes_in_use();
  Session session(scene, {{setting.structure}, setting.kernel, AuditMode::none, setting.settings});
  session.load(0);
  session.simulator().build();
  double seconds = 0;
  for (std::size_t step = 0; step < scene.step_count(); ++step) {
    session.load(step);
    seconds += processor_seconds_of([&] { session.simulator().run_step(); });
  }
  session.simulator().finish();
  const std::uint64_t after = bytes_in_use();
  cost.memory = std::max(cost.memory, after > before ? after - before : 0);
  const KineticStructure& structure = *session.structures().front();
  cost.certificates = structure.statistics.certificates.created;
  cost.events = 0;
  for (std::size_t kind = 0; kind < structure.kinds().size(); ++kind)
    if (structure.kinds()[kind].external) cost.events += structure.statistics.events_by_kind[kind];
  return seconds;
}

bool is_as_good(const TradeRow& a, const TradeRow& b) {
  const std::vector<double> of_a = main_errors(a), of_b = main_errors(b);
  constexpr double clearly = 0.97;  // times wander
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
        std::none_of(rows.begin(), rows.end(), [&](const TradeRow& other) { return is_as_good(other, row); });
}

}  // namespace

std::vector<double> main_errors(const TradeRow& row) {
  const TradeErrors& e = row.errors;
  switch (row.want) {
    case Want::contacts:
      return {e.contacts_missed.value_or(0), e.contacts_spurious.value_or(0)};
    case Want::cages:
      return {e.radius_mean.value_or(0), e.beads_outside.value_or(0)};
    case Want::diagram:
      return {e.cells_wrong.value_or(0)};
    case Want::events:
      return {e.events_missed.value_or(0), e.events_invented.value_or(0)};
  }
  return {};
}

std::vector<TradeRow> measure_trade(const FinestData& finest, const TradeTask& task,
                                    const std::function<void(std::size_t, std::size_t)>& progress) {
  std::vector<TradeGroup> groups;
  std::size_t total = 0, done = 0;
  for (const Want want : task.wants) {
    for (TradeGroup& group : groups_for(want, finest.frame_count(), task.apart)) {
      total += group.settings.size() * (task.rounds + 1);
      groups.push_back(std::move(group));
    }
  }
  const Scene truest = finest.scene();
  const double largest = *std::max_element(finest.radii().begin(), finest.radii().end());
  const std::unique_ptr<Truth> truth = make_truth(truest, {truest.necklaces(), true, task.apart, true});
  std::vector<TradeRow> all;
  for (const TradeGroup& group : groups) {
    std::vector<TradeRow> rows;
    RunHistory exact;
    std::vector<double> ends;
    for (const TradeSetting& setting : group.settings) {
      const Scene scene = finest.scene(setting);
      FollowedRun run = follow_run(setting, scene, finest.frame_count(), *truth, task.sampling,
                                   task.cutoff.value_or(4 * largest));
      ends.push_back(run.history.end);
      if (rows.empty()) exact = run.history;
      if (setting.has_events()) compare_histories(exact, run, setting);
      rows.push_back({group.want, setting, {}, run.errors, rows.empty()});
      rows.back().cost.tests = run.tests;
      progress(++done, total);
    }
    std::vector<std::vector<double>> seconds(rows.size());
    for (std::size_t round = 0; round < task.rounds; ++round) {
      for (std::size_t k = 0; k < rows.size(); ++k) {
        seconds[k].push_back(seconds_to_run(finest.scene(rows[k].setting), rows[k].setting, rows[k].cost));
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
