// A certificate type and a structure as a user might write them, either correct or with one mistake that the
// compiler must name.
#include "user.h"

struct Near {
  static constexpr kds::CertificateType type{1001, "near"};
  struct Constants {
#ifdef BARE_MEMBER
    double cutoff = 4;
#else
    kds::Constant<1> cutoff;
    kds::Constant<2> square;
#endif
  };
  double bare = 4;
  std::array<kds::BeadId, 2> beads{};
#ifndef NO_IDENTITY
  [[nodiscard]] kds::Identity identity() const { return kds::identity_of(type, beads); }
#endif
#ifndef NO_SIDE
  [[nodiscard]] bool side() const { return true; }
#endif
#ifdef FORMULA_NOT_STATIC
#define STATIC
#else
#define STATIC static
#endif
  template <kds::MotionView View>
  STATIC constexpr auto formula(const View& view, const std::array<kds::BeadId, 2>& b) {
    const auto d = view.difference(b[0], b[1]);
#if defined(BARE_CONSTANT)
    return dot(d, d) - 4.0;
#elif defined(BARE_FACTOR)
    return 4 * dot(d, d);
#elif defined(UNDECLARED)
    return dot(d, d) - view.constant(&Near::bare) * view.constant(&Near::bare);
#elif defined(UNLIKE_POWERS)
    return dot(d, d) - view.constant(&Constants::cutoff) * view.constant(&Constants::square);
#elif defined(UNLIKE_DEGREES)
    return dot(d, d) - view.constant(&Constants::cutoff);
#elif defined(POSITIONS_UNSAID)
    return dot(d, view.position(b[0]));
#elif defined(RADII_UNSAID)
    const auto reach = view.radius_sum(b[0], b[1]);
    return dot(d, d) - reach * reach;
#else
    const auto cutoff = view.constant(&Constants::cutoff);
    return dot(d, d) - cutoff * cutoff;
#endif
  }
};

class Watch final : public kds::KineticStructure {
 public:
  Watch(kds::Simulator& simulator, const kds::MotionRef<3>& motion)
      : table_(simulator, *this, simulator.add(*this), 0, motion) {}
  [[nodiscard]] std::string_view name() const override { return "watch"; }
  [[nodiscard]] std::span<const kds::EventKind> kinds() const override { return {}; }
  void build() override { table_.set_constants({.cutoff = {4, 5}, .square = 9}); }
  void start_step() override { static_cast<void>(table_.watch({.beads = {0, 1}}, 0)); }
  void fail(unsigned, std::uint32_t) override {}
#ifndef NO_APPLY
  void apply(const kds::Change&) override {}
#endif
  [[nodiscard]] std::optional<std::string> audit(const kds::Dyadic&) override { return std::nullopt; }

 private:
  kds::CertificateTable<Near> table_;
};

void run(kds::Simulator& simulator, const kds::MotionRef<3>& motion) { const Watch watch(simulator, motion); }
