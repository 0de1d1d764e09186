#pragma once
// Two certificate types defined outside the framework.

#include <array>

#include "certificates/base/certificate.h"
#include "certificates/base/constants.h"

/// Two beads are closer than a cutoff that may change in time. The negated certificate: they are not closer.
struct Near {
  static constexpr kds::CertificateType type{1001, "near"};
  struct Constants {
    kds::Constant<1> cutoff;  // a length
  };
  std::array<kds::BeadId, 2> beads{};
  bool near = true;
  [[nodiscard]] kds::Identity identity() const { return kds::identity_of(type, beads); }
  [[nodiscard]] bool side() const { return near; }
  static constexpr auto formula(const kds::MotionView auto& view, const std::array<kds::BeadId, 2>& b) {
    const auto apart = view.difference(b[0], b[1]);
    const auto cutoff = view.constant(&Constants::cutoff);
    return cutoff * cutoff - dot(apart, apart);
  }
};

/// A bead is above a plane that may move and turn. The negated certificate: the bead is below.
struct Above {
  static constexpr kds::CertificateType type{1002, "above"};
  struct Constants {
    kds::ConstantPoint<3> foot;  // any point of the plane
    kds::ConstantVector<3> normal;
  };
  std::array<kds::BeadId, 1> beads{};
  bool above = true;
  [[nodiscard]] kds::Identity identity() const { return kds::identity_of(type, beads); }
  [[nodiscard]] bool side() const { return above; }
  static constexpr auto formula(const kds::MotionView auto& view, const std::array<kds::BeadId, 1>& b) {
    return dot(view.difference(b[0], view.bead(&Constants::foot)), view.constant(&Constants::normal));
  }
};
