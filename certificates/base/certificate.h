#pragma once
// What a certificate type must offer. It names a few beads and has one function of time, written once over a
// MotionView: positive while the certificate holds. The function must be homogeneous in lengths (weights
// count as squares) and must not depend on the origin. Everything else is derived: the floating-point filter
// and its error bound, four certificates at once, the exact isolation, the order of simultaneous failures.
//
// The function is a static `formula(view, beads)`, or its negative where side() is false. One that asks for
// weights or radii says so: `static constexpr bool uses_weights = true` (`uses_radii`).

#include <array>
#include <concepts>
#include <cstdint>

#include "motions/views/motion_view.h"

namespace kds {

/// Names the function of a certificate among all of a run, whatever structure holds it. Certificates with the
/// same identity have, up to a positive or negative factor, the same function. Ties between failure times are
/// broken by it: type first, then beads.
struct Identity {
  std::uint32_t type = 0;
  std::array<BeadId, 5> beads{};  ///< unused places hold the highest id

  friend constexpr auto operator<=>(const Identity&, const Identity&) = default;
};

/// Types in the order in which simultaneous failures are handled.
enum class CertificateType : std::uint32_t {
  precedes,
  orientation,
  power_test,
  bead_in_sphere,
  contact,
  ball_in_sphere,
};

/// What a function asks of beads besides their centres: it says so by `uses_weights` and `uses_radii`.
template <class F>
inline constexpr Channels channels_of = [] {
  Channels channels;
  if constexpr (requires { F::uses_weights; }) channels.weights = F::uses_weights;
  if constexpr (requires { F::uses_radii; }) channels.radii = F::uses_radii;
  return channels;
}();

/// A function of a few beads' motions. Where weights are fictitious none asks for radii.
template <class F, class M>
concept FunctionOfBeads =
    Motion<M> && !(lifted<M> && channels_of<F>.radii) && requires(const F& f, const DoubleView<M>& view) {
  {
    F {}
    } -> std::same_as<F>;
  { F::formula(view, f.beads).scaled[0] } -> std::convertible_to<double>;
};

/// The function itself, in the view's numbers.
template <class F, MotionView View>
[[nodiscard]] auto function_of(const F& f, const View& view) {
  const auto value = F::formula(view, f.beads);
  if constexpr (requires { f.side(); }) {
    return f.side() ? value : -value;
  } else {
    return value;
  }
}

/// The identity of a certificate that keeps its beads in one order.
template <std::size_t N>
[[nodiscard]] constexpr Identity identity_of(CertificateType type, const std::array<BeadId, N>& beads) {
  static_assert(N <= 5);
  Identity identity{static_cast<std::uint32_t>(type), {no_bead, no_bead, no_bead, no_bead, no_bead}};
  for (std::size_t i = 0; i < N; ++i) identity.beads[i] = beads[i];
  return identity;
}

template <class C, class M>
concept CertificateFor = FunctionOfBeads<C, M> && requires(const C& certificate) {
  { certificate.identity() } -> std::same_as<Identity>;
  {
    certificate.side()
    } -> std::same_as<bool>;  // differs between a function and its negative of one identity
};

}  // namespace kds
