#pragma once
// The requirements on a radical certificate type. A radical certificate holds while A + B sqrt(D) is
// positive, where A, B and D are polynomials of a few beads' motions. The sign follows from the signs of A, B
// and the norm A^2 - B^2 D, each known up to a positive factor, and its zeros are zeros of the norm. D itself
// is never evaluated. However, while the certificate is in use neither D nor an omitted factor may turn
// negative, or the sign is meaningless. The type must explain why neither turns negative. If the type has
// `is_usable`, this function decides whether the certificate is usable during a short time.
//
// The function may be subject to a condition, which is another radical. The function counts as negative where
// the condition is negative. While A + B sqrt(D) is positive, the condition must not change sign.

#include <concepts>
#include <cstdint>

#include "certificates/base/certificate.h"

namespace kds {

/// The guarantee about the radii of a necklace.
enum class Radii : std::uint8_t {
  equal,  ///< equal radii and weights for all beads, so no certificate is radical
  any
};

/// Returns the sign of A + B sqrt(D) from the signs of A, B and the norm. An input of 0 may also mean that a
/// filter does not know the sign. In that case the result 0 means unknown, and every other result is right.
[[nodiscard]] constexpr int sign_of_radical(int a, int b, int norm) {
  if (a == b) return a;
  return norm > 0 ? a : norm < 0 ? b : 0;  // the term of larger size decides
}

/// The three polynomials of a radical, each a function of beads.
template <class R, class M>
concept RadicalOf = FunctionOfBeads<typename R::Rational, M> && FunctionOfBeads<typename R::Root, M> &&
    FunctionOfBeads<typename R::Norm, M>;

template <class C, class M>
concept RadicalCertificateFor = NamedCertificate<C> && RadicalOf<typename C::Radical, M> &&
    requires(const C& certificate) {  // if side() is false, positive where the radical is negative
  { certificate.root_sign() } -> std::same_as<int>;  // 1 or -1, which multiplies B
};

/// A radical certificate type with a condition, for at least some motions.
template <class C, class M>
concept ConditionalFor = RadicalOf<typename C::Condition, M> &&
    requires(const C& certificate, const M& motion) {
  { certificate.conditional(motion) } -> std::same_as<bool>;
};

}  // namespace kds
