#include "structures/box/enclosing_box.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include "certificates/types/precedes.h"
#include "structures/tournament/tournament.h"

namespace kds {

namespace {

enum Kind : std::uint8_t { overtake, first_end };

/// Ahead is who is nearer to an end of an axis.
template <int Axis>
struct Nearer {
  bool high;
  PrecedesAlong<Axis> operator()(BeadId ahead, BeadId behind) const {
    return high ? PrecedesAlong<Axis>{{behind, ahead}} : PrecedesAlong<Axis>{{ahead, behind}};
  }
};

/// Just after u = 0; the first control points that differ decide.
template <int Dimension>
bool is_nearer(const Curves<Dimension>& curves, int axis, bool high, BeadId a, BeadId b) {
  for (int k = 0; k <= curves.own_degree(); ++k) {
    const double of_a = curves.coordinate(a, k, axis), of_b = curves.coordinate(b, k, axis);
    if (of_a != of_b) return high ? of_a > of_b : of_a < of_b;
  }
  return a < b;
}

}  // namespace

/// Both ends along one axis.
template <int Dimension>
class EnclosingBox<Dimension>::Ends {
 public:
  virtual ~Ends() = default;
  virtual void start(std::uint32_t beads, std::vector<std::uint32_t>& certificates_of) = 0;
  [[nodiscard]] virtual BeadId at(bool high) const = 0;
  /// The first two ids of what is recorded of a failure.
  struct Overtaking {
    bool high;
    BeadId behind, ahead;
  };
  virtual Overtaking fail(std::uint32_t slot) = 0;
  /// Whether the one lies beyond the other at this time.
  [[nodiscard]] virtual bool is_beyond(bool high, BeadId one, BeadId other, const Dyadic& time) const = 0;
};

template <int Dimension>
template <int Axis>
class EnclosingBox<Dimension>::EndsAlong final : public Ends {
 public:
  explicit EndsAlong(EnclosingBox& box)
      : table_(box.simulator_, box, box.index_, Axis, box.motion_),
        low_(table_, {false}, 0, 2),
        high_(table_, {true}, 1, 2) {}

  void start(std::uint32_t beads, std::vector<std::uint32_t>& certificates_of) override {
    for (auto* end : {&low_, &high_}) {
      end->start(beads);
      end->each_contest([&](BeadId a, BeadId b) {
        ++certificates_of[a];
        ++certificates_of[b];
      });
    }
  }
  [[nodiscard]] BeadId at(bool high) const override { return (high ? high_ : low_).winner(); }
  typename Ends::Overtaking fail(std::uint32_t slot) override {
    const std::uint32_t place = table_.place_in_structure(slot);
    const bool high = place % 2 == 1;
    auto& end = high ? high_ : low_;
    const auto contest = end.contest(place);
    end.fail(place);
    return {high, contest.winner, contest.loser};
  }
  [[nodiscard]] bool is_beyond(bool high, BeadId one, BeadId other, const Dyadic& time) const override {
    return one != other && table_.search().sign_at(Nearer<Axis>{high}(one, other), time) > 0;
  }

 private:
  CertificateTable<PrecedesAlong<Axis>> table_;
  Tournament<Nearer<Axis>> low_, high_;
};

template <int Dimension>
EnclosingBox<Dimension>::EnclosingBox(Simulator& simulator, const MotionRef<Dimension>& motion)
    : simulator_(simulator), motion_(motion), index_(simulator.add(*this)) {
  axes_.push_back(std::make_unique<EndsAlong<0>>(*this));
  if constexpr (Dimension > 1) axes_.push_back(std::make_unique<EndsAlong<1>>(*this));
  if constexpr (Dimension > 2) axes_.push_back(std::make_unique<EndsAlong<2>>(*this));
}

template <int Dimension>
EnclosingBox<Dimension>::~EnclosingBox() = default;

template <int Dimension>
std::span<const EventKind> EnclosingBox<Dimension>::kinds() const {
  static constexpr std::array<IdRole, 2> was_is{{{"was"}, {"is"}}};
  static constexpr std::array<EventKind, 7> kinds{{{"overtake", false, false, was_is},
                                                   {"min-x", true, false, was_is},
                                                   {"max-x", true, false, was_is},
                                                   {"min-y", true, false, was_is},
                                                   {"max-y", true, false, was_is},
                                                   {"min-z", true, false, was_is},
                                                   {"max-z", true, false, was_is}}};
  return std::span(kinds).first(first_end + 2 * Dimension);
}

template <int Dimension>
void EnclosingBox<Dimension>::build() {
  const Curves<Dimension> curves = motion_.curves();
  ends_.assign(curves.bead_count() == 0 ? 0 : 2 * Dimension, 0);
  for (std::size_t e = 0; e < ends_.size(); ++e) {
    for (BeadId b = 1; b < curves.bead_count(); ++b)
      if (is_nearer(curves, static_cast<int>(e / 2), e % 2 == 1, b, ends_[e])) ends_[e] = b;
  }
}

template <int Dimension>
void EnclosingBox<Dimension>::start_step() {
  std::vector<std::uint32_t> certificates_of(motion_.bead_count(), 0);
  for (const auto& axis : axes_)
    axis->start(static_cast<std::uint32_t>(certificates_of.size()), certificates_of);
  auto& most = statistics.certificates.per_bead_max;
  for (const std::uint32_t count : certificates_of) most = std::max<std::uint64_t>(most, count);
  needs_after_batch = true;
}

template <int Dimension>
void EnclosingBox<Dimension>::fail(unsigned table, std::uint32_t slot) {
  const BeadId low = axes_[table]->at(false), high = axes_[table]->at(true);
  const auto [at_high, behind, ahead] = axes_[table]->fail(slot);
  if (axes_[table]->at(at_high) != (at_high ? high : low)) {
    needs_after_batch = true;
  } else {
    simulator_.record(index_, Change{overtake, 2, {behind, ahead}});
  }
}

template <int Dimension>
void EnclosingBox<Dimension>::after_batch() {
  for (std::size_t e = 0; e < ends_.size(); ++e) {
    const BeadId now = axes_[e / 2]->at(e % 2 == 1);
    if (now == ends_[e]) continue;
    simulator_.record(index_, Change{static_cast<std::uint8_t>(first_end + e), 2, {ends_[e], now}});
    ends_[e] = now;
  }
}

template <int Dimension>
void EnclosingBox<Dimension>::apply(const Change& change) {
  const std::size_t beads = motion_.bead_count();
  if (change.ids[0] >= beads || change.ids[1] >= beads) throw std::invalid_argument("there is no such bead");
  if (change.kind == overtake) return;  // tournaments are not replayed, only what they tell
  BeadId& end = ends_[change.kind - first_end];
  if (end != change.ids[0]) throw std::invalid_argument("the first bead is not at this end of the box");
  end = change.ids[1];
}

template <int Dimension>
std::optional<std::string> EnclosingBox<Dimension>::audit(const Dyadic& time) {
  for (std::size_t e = 0; e < ends_.size(); ++e) {
    for (BeadId b = 0; b < motion_.bead_count(); ++b) {
      if (axes_[e / 2]->is_beyond(e % 2 == 1, b, ends_[e], time))
        return "bead " + std::to_string(b) + " lies beyond bead " + std::to_string(ends_[e]) + ", " +
               std::string(kinds()[first_end + e].name) + " of the box";
    }
  }
  return std::nullopt;
}

template class EnclosingBox<1>;
template class EnclosingBox<2>;
template class EnclosingBox<3>;

}  // namespace kds
