#pragma once
// A structure that the framework does not have: the pairs of beads closer than a cutoff, which may change in
// time. Each pair has one certificate: that it is near, or that it is not.

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "examples/new_certificate.h"
#include "kds/certificate_table.h"
#include "kds/simulator.h"

template <int Dimension>
class NeighborPairs final : public kds::KineticStructure {
 public:
  using Pair = std::array<kds::BeadId, 2>;

  NeighborPairs(kds::Simulator& simulator, const kds::MotionRef<Dimension>& motion)
      : simulator_(simulator), index_(simulator.add(*this)), table_(simulator, *this, index_, 0, motion) {
    for (kds::BeadId b = 1; b < motion.bead_count(); ++b)
      for (kds::BeadId a = 0; a < b; ++a) pairs_.push_back({a, b});
    near_.resize(pairs_.size());
  }
  /// In the next step: one number, or one each control point of the motion.
  void set_cutoff(const kds::Constant<1>& cutoff) { table_.set_constants({.cutoff = cutoff}); }
  [[nodiscard]] std::vector<Pair> pairs() const {
    std::vector<Pair> near;
    for (std::uint32_t p = 0; p < pairs_.size(); ++p)
      if (near_[p]) near.push_back(pairs_[p]);
    return near;
  }

  [[nodiscard]] std::string_view name() const override { return "neighbor_pairs"; }
  [[nodiscard]] std::span<const kds::EventKind> kinds() const override {
    static constexpr std::array<kds::EventKind, 2> kinds{{{"part"}, {"meet"}}};  // ids: the two beads
    return kinds;
  }
  void build() override {
    for (std::uint32_t p = 0; p < pairs_.size(); ++p)
      near_[p] = table_.search().sign_just_after(simulator_.kernel(), {pairs_[p]}, simulator_.now(),
                                                 statistics.stages) > 0;
  }
  void start_step() override {
    for (std::uint32_t p = 0; p < pairs_.size(); ++p) watch(p, kds::KnownAtStart::unknown);
  }
  void fail(unsigned, std::uint32_t slot) override {
    const std::uint32_t pair = table_.place_in_structure(slot);
    change(pair);
    watch(pair, kds::KnownAtStart::at_own_root);
  }
  void apply(const kds::Change& change) override {
    const std::uint32_t a = change.ids[0], b = change.ids[1], pair = b * (b - 1) / 2 + a;
    if (a >= b || pair >= pairs_.size() || near_[pair] == (change.kind == 1))
      throw std::invalid_argument("neighbor_pairs: no such change can be made");
    near_[pair] = !near_[pair];
  }
  [[nodiscard]] std::optional<std::string> audit(const kds::Dyadic& time) override {
    for (std::uint32_t p = 0; p < pairs_.size(); ++p) {
      const int sign = table_.search().sign_at({pairs_[p]}, time);
      if (sign != 0 && near_[p] != (sign > 0))
        return "beads " + std::to_string(pairs_[p][0]) + " and " + std::to_string(pairs_[p][1]);
    }
    return std::nullopt;
  }

 private:
  void watch(std::uint32_t pair, kds::KnownAtStart known) {
    if (table_.watch({pairs_[pair], near_[pair]}, pair, known) != kds::CertificateHandle::violated) return;
    change(pair);  // at the very start of a step
    static_cast<void>(table_.watch({pairs_[pair], near_[pair]}, pair));
  }
  void change(std::uint32_t pair) {
    near_[pair] = !near_[pair];
    const std::uint8_t kind = near_[pair] ? 1 : 0;
    simulator_.record(index_, {kind, 2, {pairs_[pair][0], pairs_[pair][1]}});
  }

  kds::Simulator& simulator_;
  std::size_t index_;
  kds::CertificateTable<Near> table_;
  std::vector<Pair> pairs_;
  std::vector<bool> near_;
};
