#pragma once
// A view without a motion: it records a formula, which can be played later
// (motions/numbers/recorded_formula.h). The formula names beads by their places among its own beads.

#include <cstdint>

#include "motions/base/bead.h"
#include "motions/numbers/recorded_formula.h"
#include "motions/views/channels.h"

namespace kds {

template <int DimensionValue, bool Lifted, Channels channels>
class RecordingView {
  using Kind = FormulaStep::Kind;

 public:
  using Number = Recorded;
  static constexpr int dimension = DimensionValue;
  static constexpr int degree = Lifted ? 1 : any_degree;

  explicit RecordingView(RecordedFormula& formula) : formula_(formula) {}

  [[nodiscard]] BernsteinVector<Recorded, degree, dimension> difference(BeadId i, BeadId j) const {
    BernsteinVector<Recorded, degree, dimension> result;
    Kind kind = Kind::centre_difference;
    for (auto& coordinate : result) {
      coordinate = of_beads<degree>(kind, i, j);
      kind = Kind::next_coordinate;
    }
    return result;
  }
  [[nodiscard]] Bernstein<Recorded, degree> weight_difference(BeadId i, BeadId j) const
      requires(channels.weights) {
    return of_beads<degree>(Kind::weight_difference, i, j);
  }
  [[nodiscard]] Bernstein<Recorded, degree> radius_difference(BeadId i, BeadId j) const
      requires(channels.radii) {
    return of_beads<degree>(Kind::radius_difference, i, j);
  }
  [[nodiscard]] Bernstein<Recorded, degree> radius_sum(BeadId i, BeadId j) const requires(channels.radii) {
    return of_beads<degree>(Kind::radius_sum, i, j);
  }
  [[nodiscard]] Bernstein<Recorded, 1> lift_difference(BeadId i, BeadId j) const
      requires(channels.weights&& Lifted) {
    return of_beads<1>(Kind::lift_difference, i, j);
  }

 private:
  template <int Degree>
  [[nodiscard]] Bernstein<Recorded, Degree> of_beads(Kind kind, BeadId i, BeadId j) const {
    return {&formula_, formula_.add(kind, static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(j))};
  }

  RecordedFormula& formula_;
};

}  // namespace kds
