#pragma once
// A structure of someone else: the bead nearest to bead 0, kept by one certificate for each other bead.

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "certificates/search/define_certificate_search.h"
#include "kds/certificate_table.h"
#include "structures/session/structure_spec.h"
#include "tests/extension/farther.h"

namespace extension {

class Nearest final : public kds::KineticStructure {
 public:
  Nearest(kds::Simulator& simulator, const kds::MotionRef<3>& motion)
      : simulator_(simulator),
        motion_(motion),
        index_(simulator.add(*this)),
        table_(simulator, *this, index_, 0, motion) {}

  [[nodiscard]] std::string_view name() const override { return "nearest"; }
  [[nodiscard]] std::span<const kds::EventKind> kinds() const override {
    static constexpr std::array<kds::EventKind, 1> kinds{{{"overtake"}}};  // ids: the nearest from now on
    return kinds;
  }
  [[nodiscard]] kds::BeadId nearest() const { return nearest_; }

  void build() override {
    nearest_ = 1;
    for (kds::BeadId b = 2; b < motion_.bead_count(); ++b)
      if (is_violated(b)) nearest_ = b;
  }
  void start_step() override { watch_all(); }
  void fail(unsigned, std::uint32_t slot) override {
    const kds::BeadId overtaking = table_.place_in_structure(slot);
    guards_[overtaking] = kds::CertificateHandle::violated;
    become_nearest(overtaking);
  }
  void apply(const kds::Change& change) override { nearest_ = change.ids[0]; }
  [[nodiscard]] std::optional<std::string> audit(const kds::Dyadic& time) override {
    for (kds::BeadId b = 1; b < motion_.bead_count(); ++b)
      if (b != nearest_ && table_.search().sign_at({{b, nearest_, 0}}, time) < 0)
        return "bead " + std::to_string(b) + " is nearer";
    return std::nullopt;
  }

 private:
  [[nodiscard]] bool is_violated(kds::BeadId b) {
    return table_.search().sign_just_after(simulator_.kernel(), {{b, nearest_, 0}}, simulator_.now(),
                                           statistics.stages) < 0;
  }
  void become_nearest(kds::BeadId bead) {
    for (const kds::CertificateHandle guard : guards_) table_.drop(guard);
    nearest_ = bead;
    simulator_.record(index_, {0, 1, {bead}});
    watch_all();
  }
  void watch_all() {
    guards_.assign(motion_.bead_count(), kds::CertificateHandle::violated);
    for (kds::BeadId b = 1; b < motion_.bead_count(); ++b) {
      if (b == nearest_) continue;
      guards_[b] = table_.watch({{b, nearest_, 0}}, b);
      if (guards_[b] == kds::CertificateHandle::violated) return become_nearest(b);
    }
  }

  kds::Simulator& simulator_;
  kds::MotionRef<3> motion_;
  std::size_t index_;
  kds::CertificateTable<Farther> table_;
  kds::BeadId nearest_ = 1;
  std::vector<kds::CertificateHandle> guards_;
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
