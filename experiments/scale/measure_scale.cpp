#include "experiments/scale/measure_scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/compare/compare_runs.h"
#include "experiments/run/load_scene.h"
#include "experiments/theorems/plan_theorems.h"
#include "motions/base/input_error.h"
#include "motions/models/model.h"
#include "motions/models/shapes.h"
#include "structures/collision/closest_pair.h"
#include "structures/collision/hierarchy_search.h"
#include "structures/collision/sphere_tree.h"

namespace kds {

namespace {

enum FrameMeasure : std::size_t { wrapped_family, layered_family, pairs_looked_at, ratio_of_roots };

// Returns the values of frame_measures() in their order.
template <int Dimension>
std::array<std::optional<double>, 4> measure_first_frame(const Scene& scene) {
  const Eigen::Matrix3Xd centers = scene.centers(0);
  const std::vector<double>& radii = scene.radii();
  const std::vector<BeadRange> necklaces = scene.necklaces();
  std::array<std::optional<double>, 4> values;
  const Balls<Dimension> balls(centers, radii);
  const PairsAsked asked{necklaces, true, 2, true};
  const auto family = [&](Hierarchy hierarchy) {
    SphereTree<Dimension> tree(hierarchy, necklaces);
    tree.build(balls);
    return static_cast<double>(find_pairs(tree, asked).family);
  };
  values[wrapped_family] = family(Hierarchy::wrapped);
  values[layered_family] = family(Hierarchy::layered);
  const PairsLookedAt pairs =
      closest_pair<Dimension>(centers, radii, BeadPairs::along(radii.size(), necklaces)).looked_at;
  values[pairs_looked_at] = static_cast<double>(pairs.edges + pairs.common_neighbors + pairs.unconnected +
                                                pairs.centers + pairs.near);
  if (necklaces.size() == 1 && radii.size() > 1)
    values[ratio_of_roots] = root_ratio(centers, radii, Dimension);
  return values;
}

// Returns the values of structure_measures() in their order.
std::vector<std::optional<double>> values_of(const CompareRow& row) {
  const auto steps = static_cast<double>(row.steps);
  return {row.events_per_step(),
          row.net_changes ? std::optional(static_cast<double>(*row.net_changes) / steps) : std::nullopt,
          row.events_per_net_change(),
          row.efficiency(),
          static_cast<double>(row.structure.peak),
          static_cast<double>(row.costs.per_bead_most),
          row.created_per_event(),
          row.touched_per_event(),
          row.costs.events == 0 ? std::nullopt : std::optional(static_cast<double>(row.costs.touched_most)),
          row.responsiveness(),
          row.seconds.median / steps};
}

Scene model_scene(const ScaleOptions& options, std::size_t beads, std::uint64_t seed) {
  const models::Settings settings{.beads = beads, .frames = options.steps + 1, .seed = seed};
  const std::vector<Trajectory> necklaces = models::generate(*models::find_model(*options.model), settings);
  std::size_t all = 0;
  for (const Trajectory& necklace : necklaces) all += necklace.bead_count();
  return {necklaces, std::vector<double>(all, models::radius)};
}

RunOptions run_of_file(const ScaleOptions& options, std::size_t input) {
  RunOptions run;
  run.inputs = {options.inputs[input]};
  run.reading = reading_of(options, input);
  run.radius = options.radius;
  return run;
}

}  // namespace

std::span<const ScaleMeasure> structure_measures() {
  static const std::vector<ScaleMeasure> measures{
      {"events_per_step", "events per step"},
      {"net_changes_per_step", "net changes per step"},
      {"events_per_net_change", "events per net change"},
      {"efficiency", "all events per external event"},
      {"compactness", "most certificates at once"},
      {"locality", "most certificates on one bead"},
      {"created_per_event", "certificates created per event"},
      {"touched_per_event", "certificates touched per event"},
      {"touched_most", "most certificates touched at one time"},
      {"responsiveness", "seconds per event"},
      {"seconds_per_step", "seconds per step"},
  };
  return measures;
}

std::span<const ScaleMeasure> frame_measures() {
  static const std::vector<ScaleMeasure> measures{
      {"wrapped_family", "pairs in the separating family, wrapped", {{1}, {0}}},
      {"layered_family", "pairs in the separating family, layered", {{1}, {0}}},
      {"pairs_looked_at", "pairs looked at for the closest pair", {}},
      {"root_ratio", "layered / wrapped radius of the root"},
  };
  return measures;
}

std::vector<ScaleRow> measure_scene(const Scene& scene, const ScaleOptions& options, const ScaleRow& row) {
  std::vector<ScaleRow> rows;
  ScaleRow of_scene = row;
  of_scene.beads = scene.bead_count();
  of_scene.dimension = scene.dimension();
  const auto add = [&](const std::string& subject, const ScaleMeasure& measure, std::optional<double> value) {
    if (!value) return;
    ScaleRow& added = rows.emplace_back(of_scene);
    added.subject = subject;
    added.measure = &measure;
    added.value = *value;
  };
  if (scene.has_radii() && scene.dimension() > 1) {
    const auto values =
        scene.dimension() == 2 ? measure_first_frame<2>(scene) : measure_first_frame<3>(scene);
    for (std::size_t m = 0; m < values.size(); ++m) add("first frame", frame_measures()[m], values[m]);
  }
  if (scene.step_count() == 0) return rows;
  RunOptions run;
  run.structures = options.structures;
  run.directions = options.directions;
  run.threads = 1;  // times are of one thread
  for (const CompareRow& structure : measure_runs(scene, run, options.rounds, [] {})) {
    const auto values = values_of(structure);
    for (std::size_t m = 0; m < values.size(); ++m)
      add(structure.structure.name, structure_measures()[m], values[m]);
  }
  return rows;
}

std::vector<ScaleRow> measure_scale(const ScaleOptions& options,
                                    const std::function<void(std::size_t, std::size_t)>& progress,
                                    const std::function<void(const std::string&)>& warn) {
  std::vector<ScaleRow> rows;
  std::size_t done = 0;
  const auto measure = [&](const Scene& scene, const ScaleRow& row, std::size_t total,
                           const std::string& name) {
    try {
      for (ScaleRow& found : measure_scene(scene, options, row)) rows.push_back(std::move(found));
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {}", name, error.what()));
    }
    progress(++done, total);
  };
  if (options.model) {
    for (const std::size_t beads : options.beads)
      for (std::size_t s = 0; s < options.seeds; ++s)
        measure(model_scene(options, beads, options.seed + s), {*options.model, options.seed + s},
                options.beads.size() * options.seeds,
                fmt::format("--model {}, {} beads", *options.model, beads));
    return rows;
  }
  for (const auto& input : options.inputs)
    if (is_instance_file(input))
      throw InputError(input.string() + ": an instance file has no size to grow with; expected a trajectory");
  for (std::size_t i = 0; i < options.inputs.size(); ++i)
    static_cast<void>(load_scene(run_of_file(options, i), warn));
  for (std::size_t i = 0; i < options.inputs.size(); ++i)
    measure(load_scene(run_of_file(options, i), [](const std::string&) {}), {options.inputs[i].string(), {}},
            options.inputs.size(), options.inputs[i].string());
  return rows;
}

GrowthPoints ScaleSeries::growth() const {
  GrowthPoints points;
  for (const Size& size : sizes) points.emplace_back(static_cast<double>(size.beads), size.mean);
  return points;
}

std::vector<GrowthTerm> ScaleSeries::lower_terms() const {
  // The surface of a chain that fills its square or cube.
  return measure->lower.empty() ? std::vector<GrowthTerm>{{(dimension - 1.0) / dimension}} : measure->lower;
}

std::optional<GrowthSummary> ScaleSeries::fits() const {
  const GrowthPoints points = growth();
  const auto line = fit_power(points);
  if (!line) return std::nullopt;
  return GrowthSummary{line, local_exponents(points), growth_exponent(points, {}, lower_terms()),
                       best_growth(points, usual_forms())};
}

std::vector<ScaleSeries> series_of(std::span<const ScaleRow> rows) {
  std::vector<ScaleSeries> all;
  std::vector<std::vector<std::pair<std::size_t, double>>> values;  // of each series
  for (const ScaleRow& row : rows) {
    auto series = std::ranges::find_if(all, [&](const ScaleSeries& one) {
      return one.subject == row.subject && one.measure == row.measure;
    });
    if (series == all.end()) {
      series = all.insert(series, ScaleSeries{row.subject, row.measure, {}, row.dimension});
      values.emplace_back();
    }
    series->dimension = std::max(series->dimension, row.dimension);
    values[static_cast<std::size_t>(series - all.begin())].emplace_back(row.beads, row.value);
  }
  for (std::size_t s = 0; s < all.size(); ++s) {
    std::ranges::stable_sort(values[s], {}, &std::pair<std::size_t, double>::first);
    for (std::size_t first = 0, end = 0; first < values[s].size(); first = end) {
      std::vector<double> of_size;
      for (end = first; end < values[s].size() && values[s][end].first == values[s][first].first; ++end)
        of_size.push_back(values[s][end].second);
      double mean = 0;
      for (const double value : of_size) mean += value / static_cast<double>(of_size.size());
      all[s].sizes.push_back(
          {values[s][first].first, of_size.size(), mean, above_zero(mean_of_independent(of_size))});
    }
  }
  return all;
}

}  // namespace kds
