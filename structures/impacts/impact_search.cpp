#include "structures/impacts/impact_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "certificates/exact/exact_time.h"
#include "certificates/search/certificate_search.h"
#include "certificates/types/orientation.h"
#include "certificates/types/segments.h"
#include "motions/base/input_error.h"
#include "motions/curves/bezier_motion.h"

namespace kds {

namespace {

constexpr std::size_t four = 4;
constexpr int highest_degree_of_impacts = 20;  // the orientation's degree is three times as high

/// A certificate's function, for the exact number behind a failure time.
template <class Certificate>
class FunctionOf final : public CertificateSource {
 public:
  FunctionOf(const CertificateSearch<Certificate>& search, const Certificate& certificate)
      : search_(search), certificate_(certificate) {}
  [[nodiscard]] ExactFunction exact_function(std::uint32_t) const override {
    return search_.exact_function(certificate_);
  }

 private:
  const CertificateSearch<Certificate>& search_;
  Certificate certificate_;
};

/// A root of a function in the step.
struct Root {
  std::unique_ptr<CertificateSource> source;  ///< null if the time is a double
  Instant time;
  bool changes_sign = false;
};

}  // namespace

class ImpactSearch::Work {
 public:
  Work(ImpactKind kind, int degree)
      : kind_(kind),
        motion_(four, degree),
        orientation_(search_over<Orientation<3>>(MotionRef<3>(motion_))),
        cross_x_(search_over<CrossComponent<0>>(MotionRef<3>(motion_))),
        cross_y_(search_over<CrossComponent<1>>(MotionRef<3>(motion_))),
        cross_z_(search_over<CrossComponent<2>>(MotionRef<3>(motion_))),
        beyond_(search_over<BeyondEnds>(MotionRef<3>(motion_))) {}

  void set(std::span<const double> points);

  /// Calls found(impact) for the impacts in ascending order, as long as it returns true.
  template <class Found>
  void each_impact(const Found& found) {
    if (are_apart()) return;
    const bool is_planar = !each_root(*orientation_, Orientation<3>({0, 1, 2, 3}, 1), [&](Root root) {
      return !meet(root.time) || found(impact_at(root.time, root.changes_sign));
    });
    if (is_planar) each_impact_in_plane(found);
  }

  [[nodiscard]] std::uint64_t decided_by_integers() const { return stages_.exact + stages_.signs_exact; }

 private:
  static constexpr Kernel kernel = Kernel::filtered;

  /// Returns whether an axis certainly separates the features at all times.
  [[nodiscard]] bool are_apart() const;
  /// Visits the roots of the certificate's function in [0,1], ascending, until `visit` returns false. Returns
  /// false if the function is zero on the whole step.
  template <class Certificate, class Visit>
  bool each_root(const CertificateSearch<Certificate>& search, Certificate certificate, const Visit& visit);
  template <class Found>
  void each_impact_in_plane(const Found& found);

  /// Returns whether the features meet at a time at which the four points are coplanar.
  [[nodiscard]] bool meet(const Instant& time) const;
  [[nodiscard]] bool is_in_triangle(const Instant& time) const;
  [[nodiscard]] bool edges_meet(const Instant& time) const;
  [[nodiscard]] bool is_on_segment(BeadId a, BeadId b, BeadId point, const Instant& time) const;
  /// Returns the sign of a component of (b - a) x (d - c).
  [[nodiscard]] int cross(int axis, std::array<BeadId, four> beads, const Instant& time) const;
  /// Returns the side of a line on which a point lies, seen along an axis.
  [[nodiscard]] int side(int axis, BeadId a, BeadId b, BeadId point, const Instant& time) const {
    return cross(axis, {a, b, a, point}, time);
  }
  [[nodiscard]] static Impact impact_at(const Instant& time, bool passes);

  ImpactKind kind_;
  AnyDegreeMotion<3> motion_;
  std::unique_ptr<CertificateSearch<Orientation<3>>> orientation_;
  std::unique_ptr<CertificateSearch<CrossComponent<0>>> cross_x_;
  std::unique_ptr<CertificateSearch<CrossComponent<1>>> cross_y_;
  std::unique_ptr<CertificateSearch<CrossComponent<2>>> cross_z_;
  std::unique_ptr<CertificateSearch<BeyondEnds>> beyond_;
  mutable StageCounts stages_;
};

void ImpactSearch::Work::set(std::span<const double> points) {
  const auto row = static_cast<std::size_t>(motion_.own_degree()) + 1;
  if (points.size() != four * row * 3)
    throw InputError(
        fmt::format("expected {} coordinates of four points with {} control points each, found {}",
                    four * row * 3, row, points.size()));
  std::size_t at = 0;
  for (BeadId point = 0; point < four; ++point)
    for (int k = 0; k < static_cast<int>(row); ++k)
      for (int axis = 0; axis < 3; ++axis) motion_.set_coordinate(point, k, axis, points[at++]);
}

bool ImpactSearch::Work::are_apart() const {
  const BeadId of_first = kind_ == ImpactKind::vertex_face ? 1 : 2;
  for (int axis = 0; axis < 3; ++axis) {
    double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
    for (BeadId point = 0; point < four; ++point) {
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

template <class Certificate, class Visit>
bool ImpactSearch::Work::each_root(const CertificateSearch<Certificate>& search, Certificate certificate,
                                   const Visit& visit) {
  Root at;  // the present time
  const int sign = search.sign_just_after(kernel, certificate, at.time, stages_);
  if (sign == 0) return false;
  if (search.sign_now(kernel, certificate, at.time, stages_) == 0 && !visit(Root{nullptr, Instant(0.0)}))
    return true;
  if (sign < 0) certificate.sign = -certificate.sign;
  KnownAtStart known = KnownAtStart::unknown;
  for (;;) {
    Failure failure;
    search.first_failures(kernel, {&certificate, 1}, at.time, {&known, 1}, stages_, TouchPolicy::reported,
                          {&failure, 1});
    if (failure.kind != Failure::Kind::later) break;
    const auto root_of = [&] {
      auto source = std::make_unique<FunctionOf<Certificate>>(search, certificate);
      Instant time(failure.time, *source, 0);
      return Root{std::move(source), std::move(time), !failure.time.touch};
    };
    if (!visit(root_of())) return true;
    at = root_of();
    known = failure.time.touch ? KnownAtStart::unknown : KnownAtStart::at_own_root;
    if (!failure.time.touch) certificate.sign = -certificate.sign;
  }
  if (search.sign_now(kernel, certificate, Instant(1.0), stages_) == 0) visit(Root{nullptr, Instant(1.0)});
  return true;
}

int ImpactSearch::Work::cross(int axis, std::array<BeadId, four> beads, const Instant& time) const {
  if (axis == 0) return cross_x_->sign_now(kernel, {beads}, time, stages_);
  if (axis == 1) return cross_y_->sign_now(kernel, {beads}, time, stages_);
  return cross_z_->sign_now(kernel, {beads}, time, stages_);
}

bool ImpactSearch::Work::is_on_segment(BeadId a, BeadId b, BeadId point, const Instant& time) const {
  for (int axis = 0; axis < 3; ++axis)
    if (side(axis, a, b, point, time) != 0) return false;
  return beyond_->sign_now(kernel, {{a, b, point}}, time, stages_) <= 0;
}

bool ImpactSearch::Work::meet(const Instant& time) const {
  return kind_ == ImpactKind::vertex_face ? is_in_triangle(time) : edges_meet(time);
}

bool ImpactSearch::Work::is_in_triangle(const Instant& time) const {
  for (int axis = 0; axis < 3; ++axis) {
    const int turn = side(axis, 1, 2, 3, time);
    if (turn == 0) continue;
    return turn * side(axis, 1, 2, 0, time) >= 0 && turn * side(axis, 2, 3, 0, time) >= 0 &&
           turn * side(axis, 3, 1, 0, time) >= 0;
  }
  return is_on_segment(1, 2, 0, time) || is_on_segment(2, 3, 0, time) || is_on_segment(3, 1, 0, time);
}

bool ImpactSearch::Work::edges_meet(const Instant& time) const {
  for (int axis = 0; axis < 3; ++axis) {
    if (cross(axis, {0, 1, 2, 3}, time) == 0) continue;
    return side(axis, 0, 1, 2, time) * side(axis, 0, 1, 3, time) <= 0 &&
           side(axis, 2, 3, 0, time) * side(axis, 2, 3, 1, time) <= 0;
  }
  return is_on_segment(0, 1, 2, time) || is_on_segment(0, 1, 3, time) || is_on_segment(2, 3, 0, time) ||
         is_on_segment(2, 3, 1, time);
}

Impact ImpactSearch::Work::impact_at(const Instant& time, bool passes) {
  if (time.upper() - time.lower() > 0x1p-44 * time.upper()) {
    ExactTime exact = *time.exact_apart();
    exact.narrow_to_width(0x1p-46 * time.upper());
    return {exact.lower().round_down(), exact.upper().round_up(), passes};
  }
  return {time.lower(), time.upper(), passes};
}

// Between two of the roots, the answer does not change.
template <class Found>
void ImpactSearch::Work::each_impact_in_plane(const Found& found) {
  struct Candidate {
    Root root;
    ExactTime exact;
  };
  std::vector<std::unique_ptr<Candidate>> candidates;  // comparing narrows them
  const auto add = [&](Root root) {
    ExactTime exact = *root.time.exact_apart();
    candidates.push_back(std::make_unique<Candidate>(Candidate{std::move(root), std::move(exact)}));
    return true;
  };
  add({nullptr, Instant(0.0)});
  const auto add_ends_on = [&](BeadId a, BeadId b, BeadId point) {
    (void)each_root(*cross_x_, CrossComponent<0>{{a, b, a, point}}, add);
    (void)each_root(*cross_y_, CrossComponent<1>{{a, b, a, point}}, add);
    (void)each_root(*cross_z_, CrossComponent<2>{{a, b, a, point}}, add);
    (void)each_root(*beyond_, BeyondEnds{{a, b, point}}, add);
  };
  if (kind_ == ImpactKind::vertex_face) {
    add_ends_on(1, 2, 0);
    add_ends_on(2, 3, 0);
    add_ends_on(3, 1, 0);
  } else {
    add_ends_on(0, 1, 2);
    add_ends_on(0, 1, 3);
    add_ends_on(2, 3, 0);
    add_ends_on(2, 3, 1);
  }
  add({nullptr, Instant(1.0)});
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return ExactTime::compare(a->exact, b->exact) < 0; });
  bool before = false;  // whether they meet just before the candidate
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    Candidate& candidate = *candidates[k];
    const bool now = meet(candidate.root.time);
    if (now && !before && !found(impact_at(candidate.root.time, false))) return;
    if (k + 1 == candidates.size()) return;
    if (ExactTime::compare(candidate.exact, candidates[k + 1]->exact) == 0) {
      before = now;
    } else {
      before = meet(Instant(dyadic_between(candidate.exact, candidates[k + 1]->exact)));
    }
  }
}

ImpactSearch::ImpactSearch(ImpactKind kind, int degree) {
  if (degree < 1 || degree > highest_degree_of_impacts)
    throw std::invalid_argument(
        fmt::format("impacts of degree {}: expected 1 to {}", degree, highest_degree_of_impacts));
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
