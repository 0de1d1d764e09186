#include "structures/impacts/impact_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "certificates/exact/exact_time.h"
#include "motions/base/input_error.h"
#include "motions/curves/bezier_motion.h"

namespace kds {

namespace {

constexpr std::size_t point_count = 4;

Impact impact_at(const Instant& time, bool passes) {
  if (time.upper() - time.lower() > 0x1p-44 * time.upper()) {
    ExactTime exact = *time.exact_apart();
    exact.narrow_to_width(0x1p-46 * time.upper());
    return {exact.lower().round_down(), exact.upper().round_up(), passes};
  }
  return {time.lower(), time.upper(), passes};
}

}  // namespace

class ImpactSearch::Work {
 public:
  Work(ImpactKind kind, int degree)
      : pair_{kind, {0, 1, 2, 3}, {}},
        motion_(point_count, degree),
        test_(MotionRef<3>(motion_), Kernel::filtered, stages_) {}

  void set(std::span<const double> points);

  /// Calls found(impact) for the impacts in ascending order, as long as it returns true.
  template <class Found>
  void each_impact(const Found& found) const {
    if (are_apart()) return;
    test_.each_impact(pair_,
                      [&](const Instant& time, bool passes) { return found(impact_at(time, passes)); });
  }

  [[nodiscard]] std::uint64_t decided_by_integers() const { return stages_.exact + stages_.signs_exact; }

 private:
  /// Returns whether an axis certainly separates the features at all times.
  [[nodiscard]] bool are_apart() const;

  FeaturePair pair_;
  AnyDegreeMotion<3> motion_;
  StageCounts stages_;
  FeaturePairTest test_;
};

void ImpactSearch::Work::set(std::span<const double> points) {
  const auto row = static_cast<std::size_t>(motion_.own_degree()) + 1;
  if (points.size() != point_count * row * 3)
    throw InputError(
        fmt::format("expected {} coordinates of four points with {} control points each, found {}",
                    point_count * row * 3, row, points.size()));
  std::size_t at = 0;
  for (BeadId point = 0; point < point_count; ++point)
    for (int k = 0; k < static_cast<int>(row); ++k)
      for (int axis = 0; axis < 3; ++axis) motion_.set_coordinate(point, k, axis, points[at++]);
}

bool ImpactSearch::Work::are_apart() const {
  const BeadId of_first = pair_.kind == ImpactKind::vertex_face ? 1 : 2;
  for (int axis = 0; axis < 3; ++axis) {
    double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
    for (BeadId point = 0; point < point_count; ++point) {
      const int feature = point < of_first ? 0 : 1;
      for (int k = 0; k <= motion_.own_degree(); ++k) {
        low[feature] = std::min(low[feature], motion_.coordinate(point, k, axis));
        high[feature] = std::max(high[feature], motion_.coordinate(point, k, axis));
      }
    }
    if (low[0] > high[1] || low[1] > high[0]) return true;
  }
  return false;
}

ImpactSearch::ImpactSearch(ImpactKind kind, int degree) {
  if (degree < 1 || degree > highest_degree)
    throw std::invalid_argument(
        fmt::format("impacts of degree {}: expected 1 to {}", degree, highest_degree));
  work_ = std::make_unique<Work>(kind, degree);
}

ImpactSearch::~ImpactSearch() = default;

std::optional<Impact> ImpactSearch::first_impact(std::span<const double> points) {
  work_->set(points);
  std::optional<Impact> first;
  work_->each_impact([&](const Impact& impact) {
    first = impact;
    return false;
  });
  return first;
}

std::vector<Impact> ImpactSearch::all_impacts(std::span<const double> points) {
  work_->set(points);
  std::vector<Impact> all;
  work_->each_impact([&](const Impact& impact) {
    all.push_back(impact);
    return true;
  });
  return all;
}

std::uint64_t ImpactSearch::decided_by_integers() const { return work_->decided_by_integers(); }

}  // namespace kds
