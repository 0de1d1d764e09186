#pragma once
// Rejects certificates when a search is made for them, if their functions have a higher degree than 64-bit
// binomials allow.

#include <algorithm>
#include <string_view>
#include <utility>

#include "certificates/base/certificate.h"
#include "certificates/base/certificate_type.h"
#include "motions/numbers/bernstein.h"
#include "motions/views/recording_view.h"

namespace kds::detail {

/// Returns the degree of a function of beads over curves of degree `of_curves`. `C`: Curves or LiftedCurves.
template <class Function, class C>
[[nodiscard]] constexpr int degree_of_function(int of_curves) {
  constexpr int degree = decltype(Function::formula(
      std::declval<const RecordingView<C::dimension, lifted<C>, channels_of<Function>>&>(),
      std::declval<Function>().beads))::degree;
  return degree < 0 ? -degree * of_curves : degree;
}

/// Returns the highest degree of a radical's three polynomials.
template <class Radical, class C>
[[nodiscard]] constexpr int degree_of_radical(int of_curves) {
  return std::max({degree_of_function<typename Radical::Rational, C>(of_curves),
                   degree_of_function<typename Radical::Root, C>(of_curves),
                   degree_of_function<typename Radical::Norm, C>(of_curves)});
}

template <class Function>
[[nodiscard]] constexpr std::string_view name_of_function() {
  if constexpr (NamedCertificate<Function>) {
    return Function::type.name;
  } else {
    return Function::name;  // a query about faces of a hull
  }
}

/// Throws std::invalid_argument if the function's degree is above `most_degree_of_function`.
void require_searchable(std::string_view name, int degree_of_function, int degree_of_motion);

}  // namespace kds::detail
