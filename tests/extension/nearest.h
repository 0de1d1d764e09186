#pragma once
// A user-defined structure: the bead nearest to bead 0. One certificate for each other bead guards it.

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "certificates/search/define_certificate_search.h"
#include "kds/certified_places.h"
#include "structures/session/structure_spec.h"
#include "tests/extension/farther.h"

namespace extension {

class Nearest final : public kds::CertifiedPlaces<Farther> {
 public:
  Nearest(kds::Simulator& simulator, const kds::MotionRef<3>& motion)
      : CertifiedPlaces(simulator, motion, "nearest", overtakes) {
    for (kds::BeadId b = 2; b < motion.bead_count(); ++b) others_.push_back(b);
  }

  [[nodiscard]] kds::BeadId nearest() const { return nearest_; }

  void build() override {
    for (kds::BeadId& other : others_)
      if (sign_just_after({{other, nearest_, 0}}) < 0) std::swap(other, nearest_);
  }
  void apply(const kds::Change& change) override {
    const auto other = std::find(others_.begin(), others_.end(), change.ids[0]);
    if (other == others_.end()) throw std::invalid_argument("nearest: no such change can be made");
    std::swap(*other, nearest_);
  }
  [[nodiscard]] std::optional<std::string> audit(const kds::Dyadic& time) override {
    for (const kds::BeadId other : others_)
      if (table().search().sign_at({{other, nearest_, 0}}, time) < 0)
        return "bead " + std::to_string(other) + " is nearer";
    return std::nullopt;
  }

 private:
  static constexpr std::array<kds::EventKind, 1> overtakes{{{"overtake"}}};  // ids: the new nearest bead

  [[nodiscard]] std::size_t place_count() const override { return others_.size(); }
  [[nodiscard]] Farther certificate(std::size_t place) const override {
    return {{others_[place], nearest_, 0}};
  }
  void repair(std::size_t place) override {
    std::swap(others_[place], nearest_);
    record(0, {nearest_});
    for (std::size_t other = 0; other < others_.size(); ++other)
      if (other != place) certify_anew(other);
  }

  kds::BeadId nearest_ = 1;
  std::vector<kds::BeadId> others_;  // all beads except bead 0 and the nearest one
};

class NearestInRun final : public kds::RunningStructure {
 public:
  NearestInRun(kds::Simulator& simulator, const kds::MotionRef<3>& motion) : nearest_(simulator, motion) {}

  [[nodiscard]] kds::KineticStructure& kinetic() override { return nearest_; }
  [[nodiscard]] std::vector<kds::DumpFile> dump(std::size_t) const override {
    return {{"nearest.csv", "bead\n" + std::to_string(nearest_.nearest()) + "\n"}};
  }
  [[nodiscard]] std::optional<kds::CombinatorialElements> elements(std::size_t) const override {
    kds::CombinatorialElement element;
    element.fill(kds::no_bead);
    element[0] = nearest_.nearest();
    return kds::CombinatorialElements{0, {element}};  // one place
  }
  [[nodiscard]] double static_seconds(std::size_t) const override { return 0; }

 private:
  Nearest nearest_;
};

inline kds::StructureSpec nearest_structure() {
  kds::StructureSpec spec;
  spec.name = "nearest";
  spec.refusal = [](const kds::Scene& scene) -> std::optional<std::string> {
    if (scene.dimension() != 3 || scene.bead_count() < 3) return "needs three beads in space";
    return std::nullopt;
  };
  spec.make = [](kds::Simulator& simulator, const kds::Scene&, const kds::SceneMotion::Ref& motion,
                 const kds::StructureSettings&) {
    return std::make_unique<NearestInRun>(simulator, std::get<kds::MotionRef<3>>(motion));
  };
  return spec;
}

}  // namespace extension
