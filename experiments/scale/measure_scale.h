#pragma once
// The experiment behind `kds scale`: the same measures on scenes of several sizes, and how they grow.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/program/growth_columns.h"
#include "experiments/program/growth_fit.h"
#include "experiments/program/input_options.h"
#include "experiments/program/mean_interval.h"
#include "motions/scene/scene.h"

namespace kds {

/// A quantity that is measured at every size.
struct ScaleMeasure {
  std::string_view key;   ///< such as events_per_step
  std::string_view name;  ///< in words, with its unit
  /// The lower-order terms beside which its exponent is fitted. For pairs looked at, see lower_terms.
  std::vector<GrowthTerm> lower{{0}};
};
/// Returns the measures of a kinetic structure, and those of the first frame, in the order of reports.
[[nodiscard]] std::span<const ScaleMeasure> structure_measures();
[[nodiscard]] std::span<const ScaleMeasure> frame_measures();

/// One value of one scene. The subject is a structure, or "first frame".
struct ScaleRow {
  std::string input;                  ///< the file, or the model
  std::optional<std::uint64_t> seed;  ///< of a model
  std::size_t beads = 0;
  int dimension = 3;
  std::string subject = {};
  const ScaleMeasure* measure = nullptr;
  double value = 0;
};

struct ScaleOptions : InputOptions, Destinations {
  std::optional<std::string> model;  ///< --model; empty if files are measured
  std::vector<std::size_t> beads{64, 128, 256, 512, 1024, 2048};
  std::size_t steps = 10;  ///< of a model
  std::uint64_t seed = 1;
  std::size_t seeds = 1;                ///< number of models of each size
  std::vector<std::string> structures;  ///< empty for the scene's default
  std::optional<int> directions;        ///< of boxes
  std::size_t rounds = 1;
};

/// Measures one scene. A scene of one frame has only the measures of the first frame; these need balls in
/// the plane or in space, and the ratio of roots needs a single necklace of two beads or more. `row` tells
/// which scene it is.
[[nodiscard]] std::vector<ScaleRow> measure_scene(const Scene& scene, const ScaleOptions& options,
                                                  const ScaleRow& row);

/// Measures all scenes that the options name. Opens all files first, and throws InputError for one that
/// cannot be measured, with the name of the file, or of the model and its size. Warnings about inputs go to
/// `warn`.
[[nodiscard]] std::vector<ScaleRow> measure_scale(
    const ScaleOptions& options, const std::function<void(std::size_t, std::size_t)>& progress,
    const std::function<void(const std::string&)>& warn);

/// One measure of one subject at all sizes.
struct ScaleSeries {
  struct Size {
    std::size_t beads = 0, scenes = 0;
    double mean = 0;                       ///< over the scenes of this size
    std::optional<MeanInterval> interval;  ///< for two scenes or more that differ, above 0
  };

  std::string subject;
  const ScaleMeasure* measure = nullptr;
  std::vector<Size> sizes;  ///< ascending
  int dimension = 3;        ///< the largest of the scenes

  [[nodiscard]] GrowthPoints growth() const;
  /// Returns the lower-order terms of the measure in this dimension.
  [[nodiscard]] std::vector<GrowthTerm> lower_terms() const;
  /// Returns the fits, or nothing for fewer than three sizes with values above 0.
  [[nodiscard]] std::optional<GrowthSummary> fits() const;
};
/// Groups the rows by subject and measure, in the order of first appearance.
[[nodiscard]] std::vector<ScaleSeries> series_of(std::span<const ScaleRow> rows);

}  // namespace kds
