#pragma once
// Facets whose power test is positive all over a step, by its coefficients in double with their proved bound:
// in most steps most are. They are looked at as they lie in the cells, in lanes, without a certificate made
// for each. What is not found positive here is for the certificates.

#include <array>
#include <cstdint>

#include "certificates/power_test.h"
#include "certificates/settle_lanes.h"
#include "structures/regular_triangulation.h"

namespace kds {

/// Which of four formulas, in the order of their beads, have certainly positive coefficients.
template <class Certificate, Motion M>
[[KDS_LANES_TARGETS]] void positive_coefficients(
    const M& motion,
    const typename LanesView<M, bead_places<Certificate>, channels_of<Certificate>>::Tuples& tuples,
    Lanes::Mask& positive) {
  constexpr int degree = decltype(function_of(Certificate{}, DoubleView<M>(motion)))::degree;
  detail::ScaledLanes<degree> lanes;
  detail::evaluate_lanes<Certificate>(motion, tuples, Lanes(1.0), lanes);
  positive = lanes.positive;
}

template <Motion M>
class PositiveFacets {
 public:
  static constexpr int dimension = M::dimension;

  explicit PositiveFacets(const M& motion) : motion_(motion) {}

  /// Facet i of a cell, all beads finite, if it is wanted: each second one is not, which no branch foretells.
  /// Calls `doubt` with the facets, this or earlier ones, that are not found positive.
  template <class Doubt>
  void look_at(const TriangulationCell<dimension>& cell, int i, FacetId facet, bool wanted, Doubt doubt) {
    auto& beads = beads_[waiting_];
    for (std::size_t k = 0; k <= dimension; ++k) beads[k] = cell.vertex[k];
    beads[dimension + 1] = cell.apex[static_cast<std::size_t>(i)];
    facets_[waiting_] = facet;
    waiting_ += wanted ? 1 : 0;
    if (waiting_ == Lanes::width) flush(doubt);
  }
  template <class Doubt>
  void finish(Doubt doubt) {
    if (waiting_ == 0) return;
    for (std::size_t lane = waiting_; lane < Lanes::width; ++lane) beads_[lane] = beads_[0];
    flush(doubt);
  }
  /// How many were found positive.
  [[nodiscard]] std::uint64_t count() const { return count_; }

 private:
  template <class Doubt>
  void flush(Doubt doubt) {
    Lanes::Mask positive;
    positive_coefficients<PowerTest<dimension>>(motion_, beads_, positive);
    for (std::size_t lane = 0; lane < waiting_; ++lane) {
      if (positive[lane] != 0) {
        ++count_;
      } else {
        doubt(facets_[lane]);
      }
    }
    waiting_ = 0;
  }

  const M& motion_;
  std::array<std::array<BeadId, dimension + 2>, Lanes::width> beads_{};
  std::array<FacetId, Lanes::width> facets_{};
  std::size_t waiting_ = 0;
  std::uint64_t count_ = 0;
};

}  // namespace kds
