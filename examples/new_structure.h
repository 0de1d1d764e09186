#pragma once
// A structure defined outside the framework: the pairs of beads closer than a cutoff that may change in time.
// Each pair has one certificate, which states that the pair is near or that it is not.

#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "examples/new_certificate.h"
#include "kds/certified_places.h"

template <int Dimension>
class NeighborPairs final : public kds::CertifiedPlaces<Near> {
 public:
  using Pair = std::array<kds::BeadId, 2>;

  NeighborPairs(kds::Simulator& simulator, const kds::MotionRef<Dimension>& motion)
      : CertifiedPlaces(simulator, motion, "neighbor_pairs", part_and_meet) {
    for (kds::BeadId b = 1; b < motion.bead_count(); ++b)
      for (kds::BeadId a = 0; a < b; ++a) pairs_.push_back({a, b});
    near_.resize(pairs_.size());
  }
  /// Sets the cutoff of the next step: one number, or one number for each control point of the motion.
  void set_cutoff(const kds::Constant<1>& cutoff) { table().set_constants({.cutoff = cutoff}); }
  [[nodiscard]] std::vector<Pair> pairs() const {
    std::vector<Pair> near;
    for (std::size_t p = 0; p < pairs_.size(); ++p)
      if (near_[p]) near.push_back(pairs_[p]);
    return near;
  }

  void build() override {
    for (std::size_t p = 0; p < pairs_.size(); ++p) near_[p] = sign_just_after({pairs_[p]}) > 0;
  }
  void apply(const kds::Change& change) override {
    const std::size_t a = change.ids[0], b = change.ids[1], pair = b * (b - 1) / 2 + a;
    if (a >= b || pair >= pairs_.size() || near_[pair] == (change.kind == 1))
      throw std::invalid_argument("neighbor_pairs: no such change can be made");
    near_[pair] = !near_[pair];
  }
  [[nodiscard]] std::optional<std::string> audit(const kds::Dyadic& time) override {
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
      const int sign = table().search().sign_at({pairs_[p]}, time);
      if (sign != 0 && near_[p] != (sign > 0))
        return "beads " + std::to_string(pairs_[p][0]) + " and " + std::to_string(pairs_[p][1]);
    }
    return std::nullopt;
  }

 private:
  static constexpr std::array<kds::EventKind, 2> part_and_meet{{{"part"}, {"meet"}}};  // ids: the two beads

  [[nodiscard]] std::size_t place_count() const override { return pairs_.size(); }
  [[nodiscard]] Near certificate(std::size_t pair) const override { return {pairs_[pair], near_[pair]}; }
  void repair(std::size_t pair) override {
    near_[pair] = !near_[pair];
    record(near_[pair] ? 1 : 0, {pairs_[pair][0], pairs_[pair][1]});
  }

  std::vector<Pair> pairs_;
  std::vector<bool> near_;
};
