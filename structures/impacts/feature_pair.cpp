#include "structures/impacts/feature_pair.h"

#include <algorithm>
#include <utility>

#include "certificates/exact/exact_time.h"

namespace kds {

namespace {

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

constexpr std::array<FeaturePair::EdgeAndPoint, 3> of_face{{{1, 2, 0}, {2, 3, 0}, {3, 1, 0}}};
constexpr std::array<FeaturePair::EdgeAndPoint, 4> of_edges{{{0, 1, 2}, {0, 1, 3}, {2, 3, 0}, {2, 3, 1}}};

}  // namespace

std::span<const FeaturePair::EdgeAndPoint> FeaturePair::edges_and_points() const {
  if (kind == ImpactKind::vertex_face) return of_face;
  return of_edges;
}

FeaturePairTest::FeaturePairTest(const MotionRef<3>& motion, Kernel kernel, StageCounts& stages)
    : kernel_(kernel),
      stages_(stages),
      orientation_(search_over<SegmentsOrientation>(motion)),
      cross_x_(search_over<CrossComponent<0>>(motion)),
      cross_y_(search_over<CrossComponent<1>>(motion)),
      cross_z_(search_over<CrossComponent<2>>(motion)),
      beyond_(search_over<BeyondEnds>(motion)) {}

void FeaturePairTest::each_impact(const FeaturePair& pair, const Found& found) const {
  const bool is_planar = !each_root(*orientation_, pair.orientation(), [&](const Root& root) {
    return !meet(pair, root.time) || found(root.time, root.changes_sign);
  });
  if (is_planar) each_impact_in_plane(pair, found);
}

template <class Certificate, class Visit>
bool FeaturePairTest::each_root(const CertificateSearch<Certificate>& search, Certificate certificate,
                                const Visit& visit) const {
  Root at;  // the present time
  const int sign = search.sign_just_after(kernel_, certificate, at.time, stages_);
  if (sign == 0) return false;
  if (search.sign_now(kernel_, certificate, at.time, stages_) == 0 && !visit(Root{nullptr, Instant(0.0)}))
    return true;
  if (sign < 0) certificate.sign = -certificate.sign;
  KnownAtStart known = KnownAtStart::unknown;
  for (;;) {
    Failure failure;
    search.first_failures(kernel_, {&certificate, 1}, at.time, {&known, 1}, stages_, TouchPolicy::reported,
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
  if (search.sign_now(kernel_, certificate, Instant(1.0), stages_) == 0) visit(Root{nullptr, Instant(1.0)});
  return true;
}

// Between two of the roots, the answer does not change.
void FeaturePairTest::each_impact_in_plane(const FeaturePair& pair, const Found& found) const {
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
  for (const FeaturePair::EdgeAndPoint& of : pair.edges_and_points()) {
    const std::array side{of.a, of.b, of.a, of.point};
    (void)each_root(*cross_x_, pair.cross<0>(side), add);
    (void)each_root(*cross_y_, pair.cross<1>(side), add);
    (void)each_root(*cross_z_, pair.cross<2>(side), add);
    (void)each_root(*beyond_, pair.beyond(of), add);
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return ExactTime::compare(a->exact, b->exact) < 0; });
  bool before = false;  // whether they meet just before the candidate
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const Instant& time = candidates[k]->root.time;
    const bool now = meet(pair, time);
    if (now && !before && !found(time, false)) return;
    const bool is_last = k + 1 == candidates.size();
    before = is_last || ExactTime::compare(candidates[k]->exact, candidates[k + 1]->exact) < 0
                 ? meet(pair, time, Moment::just_after)
                 : now;
  }
}

int FeaturePairTest::cross(int axis, const FeaturePair& pair, std::array<unsigned, 4> indices,
                           const Instant& time, Moment moment) const {
  if (axis == 0) return sign_of(*cross_x_, kernel_, pair.cross<0>(indices), moment, time, stages_);
  if (axis == 1) return sign_of(*cross_y_, kernel_, pair.cross<1>(indices), moment, time, stages_);
  return sign_of(*cross_z_, kernel_, pair.cross<2>(indices), moment, time, stages_);
}

bool FeaturePairTest::is_on_segment(const FeaturePair& pair, const FeaturePair::EdgeAndPoint& end,
                                    const Instant& time, Moment moment) const {
  for (int axis = 0; axis < 3; ++axis)
    if (side(axis, pair, end, time, moment) != 0) return false;
  return sign_of(*beyond_, kernel_, pair.beyond(end), moment, time, stages_) <= 0;
}

bool FeaturePairTest::meet(const FeaturePair& pair, const Instant& time, Moment moment) const {
  return pair.kind == ImpactKind::vertex_face ? is_in_triangle(pair, time, moment)
                                              : edges_meet(pair, time, moment);
}

bool FeaturePairTest::meet_at_end(const FeaturePair& pair, const Instant& time, Moment moment) const {
  const auto ends = pair.edges_and_points();
  return std::any_of(ends.begin(), ends.end(), [&](const FeaturePair::EdgeAndPoint& end) {
    return is_on_segment(pair, end, time, moment);
  });
}

bool FeaturePairTest::is_in_triangle(const FeaturePair& pair, const Instant& time, Moment moment) const {
  for (int axis = 0; axis < 3; ++axis) {
    const int turn = side(axis, pair, {1, 2, 3}, time, moment);
    if (turn == 0) continue;
    return std::all_of(of_face.begin(), of_face.end(), [&](const FeaturePair::EdgeAndPoint& edge) {
      return turn * side(axis, pair, edge, time, moment) >= 0;
    });
  }
  return meet_at_end(pair, time, moment);
}

bool FeaturePairTest::edges_meet(const FeaturePair& pair, const Instant& time, Moment moment) const {
  const auto& [first_by_c, first_by_d, second_by_a, second_by_b] = of_edges;
  for (int axis = 0; axis < 3; ++axis) {
    if (cross(axis, pair, {0, 1, 2, 3}, time, moment) == 0) continue;
    const auto of = [&](const FeaturePair::EdgeAndPoint& end) { return side(axis, pair, end, time, moment); };
    return of(first_by_c) * of(first_by_d) <= 0 && of(second_by_a) * of(second_by_b) <= 0;
  }
  return meet_at_end(pair, time, moment);
}

}  // namespace kds
