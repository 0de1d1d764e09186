#pragma once
// Exact continuous collision detection of a point with a triangle and of two segments. All move on Bezier
// curves of one degree; everything is closed: ends of edges, corners of triangles, and the ends of the step.
// Doubles with error bounds decide where they can, integers elsewhere. All answers are exact; feature_pair.h
// says how they are found.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "structures/impacts/feature_pair.h"

namespace kds {

/// A time at which two features begin to meet.
struct Impact {
  double lower = 0, upper = 0;  ///< bracket of the time; equal if the time is a double
  /// Whether the orientation of the four points changes its sign, so that the features pass through each
  /// other. False if they only touch, or stay coplanar.
  bool passes = false;
};

/// Searches queries of one kind and degree, one after the other. May be used by one thread at a time.
class ImpactSearch {
 public:
  /// The orientation's degree is three times as high.
  static constexpr int highest_degree = 20;

  /// Throws std::invalid_argument if the degree is not from 1 to highest_degree.
  explicit ImpactSearch(ImpactKind kind, int degree = 1);
  ImpactSearch(const ImpactSearch&) = delete;
  ImpactSearch& operator=(const ImpactSearch&) = delete;
  ~ImpactSearch();

  /// `points` holds the control points of each of the four points, one after the other, three coordinates
  /// each. Throws InputError if it has another size or a number that is not finite.
  [[nodiscard]] std::optional<Impact> first_impact(std::span<const double> points);
  /// Returns all times at which the features begin to meet, ascending.
  [[nodiscard]] std::vector<Impact> all_impacts(std::span<const double> points);

  /// Returns how many signs and times integers have decided so far.
  [[nodiscard]] std::uint64_t decided_by_integers() const;

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

}  // namespace kds
