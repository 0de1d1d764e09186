// A structure with one certificate: which of two beads on a line is ahead.
#include <cstdio>

#include "certificates/types/precedes.h"
#include "kds/certificate_table.h"
#include "motions/curves/bezier_motion.h"

namespace {

class Race final : public kds::KineticStructure {
 public:
  Race(kds::Simulator& simulator, const kds::MotionRef<1>& motion)
      : simulator_(simulator), index_(simulator.add(*this)), table_(simulator, *this, index_, 0, motion) {}

  [[nodiscard]] std::string_view name() const override { return "race"; }
  [[nodiscard]] std::span<const kds::EventKind> kinds() const override {
    static constexpr std::array<kds::EventKind, 1> kinds{{{"overtake"}}};
    return kinds;
  }
  void build() override {}
  void start_step() override { static_cast<void>(table_.watch({{0, 1}}, 0)); }
  void fail(unsigned, std::uint32_t) override { simulator_.record(index_, {0, 2, {1, 0}}); }
  void apply(const kds::Change&) override {}
  [[nodiscard]] std::optional<std::string> audit(const kds::Dyadic&) override { return std::nullopt; }

 private:
  kds::Simulator& simulator_;
  std::size_t index_;
  kds::CertificateTable<kds::Precedes> table_;
};

}  // namespace

int main() {
  kds::BezierMotion<1, 1> motion(2);
  motion.set_coordinate(0, 1, 0, 3);
  motion.set_coordinate(1, 0, 0, 1);
  motion.set_coordinate(1, 1, 0, 2);
  kds::Simulator simulator;
  Race race(simulator, motion);
  simulator.build();
  simulator.run_step();
  std::printf("events: %d\n", static_cast<int>(race.statistics.events_per_step.front()));
}
