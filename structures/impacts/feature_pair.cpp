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

/// The edges of a feature, each with a point of the other feature that may meet it.
struct EdgeAndPoint {
  unsigned a, b, point;
};
constexpr std::array<EdgeAndPoint, 3> edges_of_face{{{1, 2, 0}, {2, 3, 0}, {3, 1, 0}}};
constexpr std::array<EdgeAndPoint, 4> ends_of_edges{{{0, 1, 2}, {0, 1, 3}, {2, 3, 0}, {2, 3, 1}}};

std::span<const EdgeAndPoint> edges_and_points(ImpactKind kind) {
  if (kind == ImpactKind::vertex_face) return edges_of_face;
  return ends_of_edges;
}

/// Returns the shift of one point relative to another.
std::array<BeadId, 2> shift_between(const FeaturePair& pair, unsigned to, unsigned from) {
  const unsigned second = pair.kind == ImpactKind::vertex_face ? 1 : 2;  // its first point
  const bool to_moves = to >= second, from_moves = from >= second;
  if (to_moves == from_moves) return {pair.shift[0], pair.shift[0]};
  return to_moves ? pair.shift : std::array{pair.shift[1], pair.shift[0]};
}

}  // namespace

struct FeaturePairTest::Candidate {
  Root root;
  ExactTime exact;
};

FeaturePairTest::FeaturePairTest(const MotionRef<3>& motion, Kernel kernel, StageCounts& stages)
    : kernel_(kernel),
      stages_(stages),
      orientation_(search_over<SegmentsOrientation>(motion)),
      cross_x_(search_over<CrossComponent<0>>(motion)),
      cross_y_(search_over<CrossComponent<1>>(motion)),
      cross_z_(search_over<CrossComponent<2>>(motion)),
      beyond_(search_over<BeyondEnds>(motion)) {}

void FeaturePairTest::each_impact(const FeaturePair& pair, const Found& found) const {
  const bool is_planar = !each_root(*orientation_, pair.orientation(1), [&](const Root& root) {
    return !meet(pair, root.time) || found(root.time, root.changes_sign);
  });
  if (!is_planar) return;
  const auto candidates = candidates_in_plane(pair);
  bool before = false;  // whether they meet just before the candidate
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const bool now = meet(pair, candidates[k]->root.time);
    if (now && !before && !found(candidates[k]->root.time, false)) return;
    if (k + 1 < candidates.size()) before = meet_between(pair, *candidates[k], *candidates[k + 1]);
  }
}

bool FeaturePairTest::meet_throughout(const FeaturePair& pair) const {
  const auto candidates = candidates_in_plane(pair);
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    if (!meet(pair, candidates[k]->root.time)) return false;
    if (k + 1 < candidates.size() && !meet_between(pair, *candidates[k], *candidates[k + 1])) return false;
  }
  return true;
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

std::vector<std::unique_ptr<FeaturePairTest::Candidate>> FeaturePairTest::candidates_in_plane(
    const FeaturePair& pair) const {
  std::vector<std::unique_ptr<Candidate>> candidates;  // comparing narrows them
  const auto add = [&](Root root) {
    ExactTime exact = *root.time.exact_apart();
    candidates.push_back(std::make_unique<Candidate>(Candidate{std::move(root), std::move(exact)}));
    return true;
  };
  add({nullptr, Instant(0.0)});
  for (const auto& [a, b, point] : edges_and_points(pair.kind)) {
    (void)each_root(*cross_x_, component<0>(pair, {a, b, a, point}), add);
    (void)each_root(*cross_y_, component<1>(pair, {a, b, a, point}), add);
    (void)each_root(*cross_z_, component<2>(pair, {a, b, a, point}), add);
    (void)each_root(*beyond_, beyond(pair, a, b, point), add);
  }
  add({nullptr, Instant(1.0)});
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return ExactTime::compare(a->exact, b->exact) < 0; });
  return candidates;
}

bool FeaturePairTest::meet_between(const FeaturePair& pair, Candidate& one, Candidate& next) const {
  if (ExactTime::compare(one.exact, next.exact) == 0) return meet(pair, one.root.time);
  return meet(pair, Instant(dyadic_between(one.exact, next.exact)));
}

template <int Axis>
CrossComponent<Axis> FeaturePairTest::component(const FeaturePair& pair, std::array<unsigned, 4> points) {
  const auto [a, b, c, d] = points;
  const auto [to, from] = shift_between(pair, d, c);
  return {{pair.points[a], pair.points[b], pair.points[c], pair.points[d], to, from}};
}

BeyondEnds FeaturePairTest::beyond(const FeaturePair& pair, unsigned a, unsigned b, unsigned point) {
  const auto [to, from] = shift_between(pair, a, point);
  return {{pair.points[a], pair.points[b], pair.points[point], to, from}};
}

int FeaturePairTest::cross(int axis, const FeaturePair& pair, std::array<unsigned, 4> points,
                           const Instant& time) const {
  if (axis == 0) return cross_x_->sign_now(kernel_, component<0>(pair, points), time, stages_);
  if (axis == 1) return cross_y_->sign_now(kernel_, component<1>(pair, points), time, stages_);
  return cross_z_->sign_now(kernel_, component<2>(pair, points), time, stages_);
}

bool FeaturePairTest::is_on_segment(const FeaturePair& pair, unsigned a, unsigned b, unsigned point,
                                    const Instant& time) const {
  for (int axis = 0; axis < 3; ++axis)
    if (side(axis, pair, a, b, point, time) != 0) return false;
  return beyond_->sign_now(kernel_, beyond(pair, a, b, point), time, stages_) <= 0;
}

bool FeaturePairTest::meet(const FeaturePair& pair, const Instant& time) const {
  return pair.kind == ImpactKind::vertex_face ? is_in_triangle(pair, time) : edges_meet(pair, time);
}

bool FeaturePairTest::meet_at_end(const FeaturePair& pair, const Instant& time) const {
  const auto pairs = edges_and_points(pair.kind);
  return std::any_of(pairs.begin(), pairs.end(), [&](const EdgeAndPoint& end) {
    return is_on_segment(pair, end.a, end.b, end.point, time);
  });
}

bool FeaturePairTest::is_in_triangle(const FeaturePair& pair, const Instant& time) const {
  for (int axis = 0; axis < 3; ++axis) {
    const int turn = side(axis, pair, 1, 2, 3, time);
    if (turn == 0) continue;
    return std::all_of(edges_of_face.begin(), edges_of_face.end(), [&](const EdgeAndPoint& edge) {
      return turn * side(axis, pair, edge.a, edge.b, edge.point, time) >= 0;
    });
  }
  return meet_at_end(pair, time);
}

bool FeaturePairTest::edges_meet(const FeaturePair& pair, const Instant& time) const {
  for (int axis = 0; axis < 3; ++axis) {
    if (cross(axis, pair, {0, 1, 2, 3}, time) == 0) continue;
    return side(axis, pair, 0, 1, 2, time) * side(axis, pair, 0, 1, 3, time) <= 0 &&
           side(axis, pair, 2, 3, 0, time) * side(axis, pair, 2, 3, 1, time) <= 0;
  }
  return meet_at_end(pair, time);
}

}  // namespace kds
