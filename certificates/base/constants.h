#pragma once
// Constants of a certificate type: knowledge besides its beads. Constants are the members of `struct
// Constants` within the type, and all certificates of a table share one set of constants
// (CertificateTable::set_constants). Each constant has a declared power of length, so that the function stays
// homogeneous. A constant may change within a step as beads do: it has one control point, or as many as the
// motion's curves. The control points are doubles that define the constant exactly; nothing is rounded.
//
//   Constant<1>, Constant<2>   a length, a squared length: view.constant(&Constants::name), a polynomial
//   ConstantVector<D>          a vector of lengths, as of a plane's normal: view.constant, D polynomials
//   ConstantPoint<D>           a point: view.bead, used in the formula where a bead is
//   ConstantBead               a bead that all certificates of the table name: view.bead
//
// A type that uses the positions of beads, view.position(bead), declares `static constexpr bool
// uses_positions = true`. Types without constants and positions pay nothing for these features.

#include <array>
#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "motions/base/bead.h"

namespace kds {

namespace detail {

/// The control points in sequence.
class ConstantCurve {
 public:
  [[nodiscard]] const std::vector<double>& numbers() const { return numbers_; }

 protected:
  ConstantCurve() = default;
  std::vector<double> numbers_;
};

template <int Dimension>
class ConstantVectorCurve : public ConstantCurve {
 public:
  using Vector = std::array<double, static_cast<std::size_t>(Dimension)>;

  ConstantVectorCurve() = default;
  ConstantVectorCurve(std::initializer_list<Vector> control_points)
      : ConstantVectorCurve(std::span(control_points.begin(), control_points.size())) {}
  explicit ConstantVectorCurve(std::span<const Vector> control_points) {
    for (const Vector& point : control_points) numbers_.insert(numbers_.end(), point.begin(), point.end());
  }
};

}  // namespace detail

template <int Power>
class Constant : public detail::ConstantCurve {
  static_assert(Power == 1 || Power == 2,
                "a constant is a length, Constant<1>, or a squared length, Constant<2>: higher powers are "
                "products");

 public:
  Constant() = default;
  Constant(double value) { numbers_ = {value}; }  // NOLINT: implicit by intention
  Constant(std::initializer_list<double> control_points) { numbers_ = control_points; }
  explicit Constant(std::span<const double> control_points) {
    numbers_.assign(control_points.begin(), control_points.end());
  }
};

template <int Dimension>
class ConstantVector : public detail::ConstantVectorCurve<Dimension> {
 public:
  using detail::ConstantVectorCurve<Dimension>::ConstantVectorCurve;
};

template <int Dimension>
class ConstantPoint : public detail::ConstantVectorCurve<Dimension> {
 public:
  using detail::ConstantVectorCurve<Dimension>::ConstantVectorCurve;
};

class ConstantBead {
 public:
  ConstantBead() = default;
  ConstantBead(BeadId bead) : bead_(bead) {}  // NOLINT: implicit by intention
  [[nodiscard]] BeadId bead() const { return bead_; }

 private:
  BeadId bead_ = no_bead;
};

template <class Certificate>
concept HasConstants = requires {
  typename Certificate::Constants;
};
template <class Certificate>
inline constexpr bool uses_positions = [] {
  if constexpr (requires { Certificate::uses_positions; }) return Certificate::uses_positions;
  return false;
}();
/// Whether the formula uses more than the relative positions of beads.
template <class Certificate>
concept NeedsAnchors = HasConstants<Certificate> || uses_positions<Certificate>;

namespace detail {

inline constexpr std::size_t most_constants = 6;

struct AnyMember {
  template <class T>
  operator T() const;  // never called: used to count the members of an aggregate
};
template <class Aggregate, class... Members>
[[nodiscard]] consteval std::size_t member_count() {
  if constexpr (sizeof...(Members) <= most_constants && requires { Aggregate{Members{}..., AnyMember{}}; }) {
    return member_count<Aggregate, Members..., AnyMember>();
  } else {
    return sizeof...(Members);
  }
}

/// Returns references to the members of an aggregate, in their order.
template <class Aggregate>
[[nodiscard]] auto members_of(const Aggregate& of) {
  constexpr std::size_t count = member_count<Aggregate>();
  static_assert(count <= most_constants, "a certificate type has at most 6 constants");
  if constexpr (count == 0) {
    return std::tie();
  } else if constexpr (count == 1) {
    const auto& [a] = of;
    return std::tie(a);
  } else if constexpr (count == 2) {
    const auto& [a, b] = of;
    return std::tie(a, b);
  } else if constexpr (count == 3) {
    const auto& [a, b, c] = of;
    return std::tie(a, b, c);
  } else if constexpr (count == 4) {
    const auto& [a, b, c, d] = of;
    return std::tie(a, b, c, d);
  } else if constexpr (count == 5) {
    const auto& [a, b, c, d, e] = of;
    return std::tie(a, b, c, d, e);
  } else {
    const auto& [a, b, c, d, e, f] = of;
    return std::tie(a, b, c, d, e, f);
  }
}

template <class T>
inline constexpr bool is_constant = std::same_as<T, ConstantBead>;
template <int Power>
inline constexpr bool is_constant<Constant<Power>> = true;
template <int Dimension>
inline constexpr bool is_constant<ConstantVector<Dimension>> = true;
template <int Dimension>
inline constexpr bool is_constant<ConstantPoint<Dimension>> = true;

template <class Members>
inline constexpr bool all_are_constants = false;
template <class... T>
inline constexpr bool all_are_constants<std::tuple<const T&...>> = (is_constant<T> && ...);

template <class Member, class Members>
inline constexpr bool is_among = false;
template <class Member, class... T>
inline constexpr bool is_among<Member, std::tuple<const T&...>> = (std::same_as<Member, T> || ...);

struct NoConstants {};
template <class Certificate>
struct ConstantsOfType {
  using Type = NoConstants;
};
template <HasConstants Certificate>
struct ConstantsOfType<Certificate> {
  using Type = typename Certificate::Constants;
};

}  // namespace detail

/// The constants of a certificate type; an empty struct if it has none.
template <class Certificate>
using ConstantsOf = typename detail::ConstantsOfType<Certificate>::Type;
template <class Certificate>
using ConstantMembers = decltype(detail::members_of(std::declval<const ConstantsOf<Certificate>&>()));

/// Whether every constant of the type declares a power of length.
template <class Certificate>
concept DeclaresItsConstants =
    std::is_aggregate_v<ConstantsOf<Certificate>> && detail::all_are_constants<ConstantMembers<Certificate>>;

namespace detail {

template <class Constants>
inline const Constants sample_of_constants{};

}  // namespace detail

/// Returns the index of a member among the constants, from 0.
template <class Constants, class Member>
[[nodiscard, gnu::always_inline]] inline std::size_t index_of_constant(Member Constants::*member) {
  const Constants& sample = detail::sample_of_constants<Constants>;
  const void* const wanted = &(sample.*member);
  std::size_t index = 0;
  bool found = false;
  const auto look_at = [&](const void* member_of_sample) {
    found = found || member_of_sample == wanted;
    if (!found) ++index;
  };
  std::apply([&](const auto&... each) { (look_at(&each), ...); }, detail::members_of(sample));
  return index;
}

}  // namespace kds
