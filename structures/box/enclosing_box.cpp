#include "structures/box/enclosing_box.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include "certificates/types/precedes.h"
#include "kds/simulator.h"
#include "structures/tournament/tournament.h"

namespace kds {

namespace {

/// A bead is "ahead" if it is nearer to this end of the axis.
template <int Axis>
struct Nearer {
  bool high;
  PrecedesAlong<Axis> operator()(BeadId ahead, BeadId behind) const {
    return high ? PrecedesAlong<Axis>{{behind, ahead}} : PrecedesAlong<Axis>{{ahead, behind}};
  }
};

/// Returns whether a is nearer than b just after u = 0; the first control points that differ decide.
template <int Dimension>
bool is_nearer(const Curves<Dimension>& curves, int axis, bool high, BeadId a, BeadId b) {
  for (int k = 0; k <= curves.own_degree(); ++k) {
    const double of_a = curves.coordinate(a, k, axis), of_b = curves.coordinate(b, k, axis);
    if (of_a != of_b) return high ? of_a > of_b : of_a < of_b;
  }
  return a < b;
}

constexpr std::array<IdRole, 2> was_is{{{"was"}, {"is"}}};

template <int Dimension>
constexpr auto box_kinds = [] {
  constexpr std::array<std::string_view, 6> ends{"min-x", "max-x", "min-y", "max-y", "min-z", "max-z"};
  std::array<EventKind, 1 + 2 * Dimension> kinds;
  kinds[0] = {"overtake", false, false, was_is};
  for (std::size_t e = 0; e < 2 * Dimension; ++e) kinds[1 + e] = {ends[e], true, false, was_is};
  return with_edits(kinds);
}();

}  // namespace

/// Both ends of the box along one axis.
template <int Dimension>
class EnclosingBox<Dimension>::Ends {
 public:
  virtual ~Ends() = default;
  virtual void start(std::size_t beads, std::span<const char> absent) = 0;
  virtual void count_certificates(CertificatesPerBead& per_bead) const = 0;
  /// Returns no_bead if all beads are absent.
  [[nodiscard]] virtual BeadId at(bool high) const = 0;
  /// The overtaking that a failure means; `behind` and `ahead` are the first two ids of the recorded change.
  struct Overtaking {
    bool high;
    BeadId behind, ahead;
  };
  virtual Overtaking fail(std::uint32_t slot) = 0;
  // These functions act on the tournaments of both ends like the functions of Tournament with these names.
  virtual void give_up(BeadId bead) = 0;
  virtual void set_present(BeadId bead, bool present) = 0;
  virtual void hold_again() = 0;
  /// Returns whether `one` lies beyond `other` at this time.
  [[nodiscard]] virtual bool is_beyond(bool high, BeadId one, BeadId other, const Dyadic& time) const = 0;
};

template <int Dimension>
template <int Axis>
class EnclosingBox<Dimension>::EndsAlong final : public Ends {
 public:
  explicit EndsAlong(EnclosingBox& box)
      : table_(box.simulator(), box, box.index(), Axis, box.motion_),
        low_(table_, {false}, 0, 2),
        high_(table_, {true}, 1, 2) {}

  void start(std::size_t beads, std::span<const char> absent) override {
    for (auto* end : {&low_, &high_}) end->start(static_cast<std::uint32_t>(beads), absent);
  }
  void count_certificates(CertificatesPerBead& per_bead) const override {
    for (const auto* end : {&low_, &high_}) {
      end->each_contest([&](BeadId a, BeadId b) {
        per_bead.add(a);
        per_bead.add(b);
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
  void give_up(BeadId bead) override {
    for (auto* end : {&low_, &high_}) end->give_up(bead);
  }
  void set_present(BeadId bead, bool present) override {
    for (auto* end : {&low_, &high_}) end->set_present(bead, present);
  }
  void hold_again() override {
    for (auto* end : {&low_, &high_}) end->hold_again();
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
    : EditableBase(simulator, motion.bead_count(), "box", box_kinds<Dimension>), motion_(motion) {
  axes_.push_back(std::make_unique<EndsAlong<0>>(*this));
  if constexpr (Dimension > 1) axes_.push_back(std::make_unique<EndsAlong<1>>(*this));
  if constexpr (Dimension > 2) axes_.push_back(std::make_unique<EndsAlong<2>>(*this));
}

template <int Dimension>
EnclosingBox<Dimension>::~EnclosingBox() = default;

template <int Dimension>
void EnclosingBox<Dimension>::build() {
  const Curves<Dimension> curves = motion_.curves();
  present().structure_is_built();
  const std::vector<BeadId> beads = present().all();
  ends_.assign(curves.bead_count() == 0 ? 0 : 2 * Dimension, beads.empty() ? no_bead : beads[0]);
  for (std::size_t e = 0; e < ends_.size(); ++e) {
    for (const BeadId b : beads)
      if (is_nearer(curves, static_cast<int>(e / 2), e % 2 == 1, b, ends_[e])) ends_[e] = b;
  }
}

template <int Dimension>
void EnclosingBox<Dimension>::start_step() {
  for (const auto& axis : axes_) axis->start(bead_count(), present().absent());
  count_certificates();
  needs_after_batch = true;
}

template <int Dimension>
void EnclosingBox<Dimension>::count_certificates() {
  CertificatesPerBead per_bead(statistics.certificates, bead_count());
  for (const auto& axis : axes_) axis->count_certificates(per_bead);
}

template <int Dimension>
void EnclosingBox<Dimension>::fail(unsigned table, std::uint32_t slot) {
  const BeadId low = axes_[table]->at(false), high = axes_[table]->at(true);
  const auto [at_high, behind, ahead] = axes_[table]->fail(slot);
  if (axes_[table]->at(at_high) != (at_high ? high : low)) {
    needs_after_batch = true;
  } else {
    record(overtake, {behind, ahead});
  }
}

template <int Dimension>
void EnclosingBox<Dimension>::after_batch() {
  for (std::size_t e = 0; e < ends_.size(); ++e) {
    const BeadId now = axes_[e / 2]->at(e % 2 == 1);
    if (now == ends_[e]) continue;
    record(Change{static_cast<std::uint8_t>(first_end + e), 2, {ends_[e], now}});
    ends_[e] = now;
  }
}

template <int Dimension>
void EnclosingBox<Dimension>::apply(const Change& change) {
  if (apply_edit(change)) return;
  const auto [was, is] = std::array{change.ids[0], change.ids[1]};
  if (change.kind == overtake) {  // tournaments are not replayed; only check the beads
    present().require(was, false);
    return present().require(is, false);
  }
  BeadId& end = ends_[change.kind - first_end];
  if (end != was) throw std::invalid_argument("the first bead is not at this end of the box");
  if (is != no_bead || present().count() > 0) present().require(is, false);
  end = is;
}

// Edits: beads are inserted, erased, or change course.

template <int Dimension>
void EnclosingBox<Dimension>::edit(std::uint8_t kind, BeadId bead) {
  record(kind, {bead});
  release({&bead, 1});
  present().set_absent(bead, kind == erases);
  for (const auto& axis : axes_) axis->set_present(bead, kind == inserts);
  hold_again();
}

template <int Dimension>
void EnclosingBox<Dimension>::release(std::span<const BeadId> beads) {
  for (const auto& axis : axes_)
    for (const BeadId bead : beads) axis->give_up(bead);
}

template <int Dimension>
void EnclosingBox<Dimension>::follow(std::span<const BeadId>) {
  hold_again();
}

template <int Dimension>
void EnclosingBox<Dimension>::hold_again() {
  for (const auto& axis : axes_) axis->hold_again();
  after_batch();
}

template <int Dimension>
std::optional<std::string> EnclosingBox<Dimension>::audit(const Dyadic& time) {
  for (std::size_t e = 0; e < ends_.size(); ++e) {
    if (ends_[e] == no_bead ? present().count() > 0 : is_absent(ends_[e]))
      return "no bead of the box is its " + std::string(kinds()[first_end + e].name);
    for (const BeadId b : present().all()) {
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
