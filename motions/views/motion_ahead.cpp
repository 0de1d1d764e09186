#include "motions/views/motion_ahead.h"

#include <algorithm>
#include <cmath>

namespace kds {

namespace {

using Vector = Lanes::Vector;

// Loads a control point into lanes: coordinates, then the weight, then zeros.

template <int Dimension>
Vector point(const double* p) {
  if constexpr (Dimension == 3) return Lanes::load(p);
  return Vector{p[0], p[1], p[2], 0};
}
template <int Dimension>
void store(const Vector& v, double* p) {
  for (int i = 0; i <= Dimension; ++i) p[i] = v[i];
}

/// Returns the rounding error of a sum. The returned error is exact unless something overflows; then it is
/// NaN.
Vector left_of_sum(const Vector& a, const Vector& b, const Vector& sum) {
  const Vector of_b = sum - a;
  return (a - (sum - of_b)) + (b - of_b);
}

bool all_of(const Lanes::Mask& mask) { return (mask[0] & mask[1] & mask[2] & mask[3]) != 0; }

}  // namespace

template <int Dimension>
void MotionAhead<Dimension>::look_at(const Curves<Dimension>& curves, std::size_t every) {
  const std::size_t beads = curves.bead_count();
  straight_ = 0;
  all_known_ = true;
  ++step_;
  const std::size_t watched = (beads + every - 1) / every;
  if (every_ != every || courses_.size() != watched) courses_.assign(watched, {});
  every_ = every;
  if (every == 1) {
    records_.resize(beads);
    turned_.resize(beads + 1, 0);
  }
  for (std::size_t c = 0; c < courses_.size(); ++c) {
    const auto bead = static_cast<BeadId>(c * every);
    const Vector from = point<Dimension>(curves.control_point(bead, 0)),
                 to = point<Dimension>(curves.control_point(bead, 1)), step = to - from,
                 all_steps = static_cast<double>(steps) * step;
    Vector ahead = from + all_steps;
    Course& course = courses_[c];
    const Vector zero{};
    const bool known = step[Dimension] == 0 && all_of((left_of_sum(to, -from, step) == zero) &
                                                      (left_of_sum(from, all_steps, ahead) == zero));
    const bool goes_on = known & (course.known_in == step_ - 1) &
                         all_of((course.end == from) & (course.step == step));  // avoids a branch
    course = {to, step, known ? step_ : 0};
    straight_ += goes_on ? 1 : 0;
    all_known_ = all_known_ & known;
    if (every > 1) continue;
    if (!known) {
      // Place the bead far from all others, so far that no filter accepts its differences as lengths.
      ahead = zero;
      ahead[0] = std::ldexp(static_cast<double>(bead) + 1, 960);
      ahead[Dimension] = from[Dimension];
    }
    store<Dimension>(from, records_[bead].control[0]);
    store<Dimension>(ahead, records_[bead].control[1]);
    turned_[bead + 1] = goes_on ? 0 : -1;
  }
}

template class MotionAhead<2>;
template class MotionAhead<3>;

}  // namespace kds
