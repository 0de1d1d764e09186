#pragma once
// The certificates of a power diagram's facets (facet_certificate.h), created and dropped together. Facets
// that are proved to hold over the whole step (facet_proofs.h) have no certificate and are only counted.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "certificates/base/certificate.h"
#include "certificates/exact/instant.h"
#include "kds/certificate_table.h"
#include "motions/views/lanes_view.h"
#include "structures/power_diagram/diagram_state.h"
#include "structures/power_diagram/facet_proofs.h"

namespace kds {

/// The handle of a facet's certificate in a kinetic power diagram, stored in the 32 bits that its cell keeps
/// for it.
struct FacetHandle {
  /// The function of the certificate: a power test, an orientation on the hull, or the orientation of a cell.
  /// If a power test is zero for the whole step (all its beads stay on one sphere), it would not notice that
  /// the facet's cells turn over. Each side then has a certificate of its own: the orientation of its cell.
  enum class About : std::uint8_t { power, hull, cell };

  CertificateHandle handle = CertificateHandle::violated;
  About about = About::power;

  /// Returns the handle as the cell stores it. A new cell stores 0, which means `violated`.
  [[nodiscard]] constexpr std::uint32_t packed() const {
    return static_cast<std::uint32_t>(about) << 30U |
           ((static_cast<std::uint32_t>(handle) - first_name) & mask);
  }
  [[nodiscard]] static constexpr FacetHandle of(std::uint32_t note) {
    const std::uint32_t low = note & mask;  // 0 to 2: violated, zero, never; then the slots
    return {static_cast<CertificateHandle>(low < names ? first_name + low : low - names),
            static_cast<About>(note >> 30U)};
  }

 private:
  static constexpr std::uint32_t mask = (1U << 30U) - 1, names = 3;
  static constexpr auto first_name = static_cast<std::uint32_t>(CertificateHandle::violated);
};

/// Search results at one moment, stored by certificate. A rebuild builds the diagram at several times until
/// one is correct, and most facets are the same each time. If their functions differ from
/// zero only because coordinates are rounded, each search needs exact integers, so reusing its result pays.
class KnownFailures {
 public:
  template <NamedCertificate Certificate>
  void add(const Certificate& certificate, const Failure& failure) {
    failures_.insert_or_assign(Key{certificate.identity(), certificate.side()}, failure);
  }
  /// Returns null if the result was never added.
  template <NamedCertificate Certificate>
  [[nodiscard]] const Failure* of(const Certificate& certificate) const {
    const auto found = failures_.find(Key{certificate.identity(), certificate.side()});
    return found == failures_.end() ? nullptr : &found->second;
  }

 private:
  struct Key {
    Identity identity;
    bool side;
    friend bool operator==(const Key&, const Key&) = default;
  };
  struct Hash {
    std::size_t operator()(const Key& key) const {
      constexpr std::uint64_t odd = 0x9e3779b97f4a7c15U;
      std::uint64_t hash = key.identity.type * 2 + (key.side ? 1 : 0);
      for (const BeadId bead : key.identity.beads) hash = (hash ^ hash >> 29U ^ bead) * odd;
      return static_cast<std::size_t>(hash ^ hash >> 32U);
    }
  };

  std::unordered_map<Key, Failure, Hash> failures_;
};

template <int Dimension>
class FacetCertificates {
  using State = DiagramState<Dimension>;
  using Beads = typename State::Beads;

 public:
  /// Numbers of the tables.
  enum : unsigned { powers = 0, orientations = 1 };

  explicit FacetCertificates(State& state);

  /// Called at the start of a step, when the certificates of the previous step are gone.
  void start_step();
  /// Creates the certificates of all facets. Facets that slack or lookahead proves are skipped. Facets whose
  /// test is positive over the whole step, as most are, are only counted.
  void watch_all();
  /// Creates the certificates of all facets of new cells. If an event made these cells, a facet between two
  /// of them has all beads of the event and therefore its function.
  void watch_around(std::span<const CellId> cells);
  /// Drops a facet's certificate, if it has one.
  void drop(CellId cell, int i) {
    const FacetHandle facet = handle(cell, i);
    bool vanishes = facet.about == About::power ? state_.give_up(power_tests_, facet.handle)
                                                : state_.give_up(orientations_, facet.handle);
    if (facet.about == About::cell) {
      const auto [other, k] = state_.across(cell, i);
      vanishes |= state_.give_up(orientations_, handle(other, k).handle);
    }
    if (vanishes) state_.touch(std::array{cell, state_.neighbor(cell, i)});
    forget(cell, i);
  }
  /// Drops the certificates of all facets of these cells. Dropping a facet between two of them a second time
  /// has no effect.
  void drop_around(std::span<const CellId> cells) {
    for (const CellId cell : cells) {
      for (int i = 0; i <= Dimension; ++i) drop(cell, i);
    }
  }
  void drop_all();
  /// From now on, keeps all search results and reuses them, until forget_known. Must be called only while
  /// time stands still and all diagrams that follow have the same curves.
  void remember() {
    if (all_move() && !known_) known_.emplace();
  }
  void forget_known() { known_.reset(); }
  /// Called before another triangulation: discards all knowledge of its cells and facets and leaves all
  /// facets without certificates.
  void forget_cells();
  /// Called when beads are about to get other curves.
  void forget_courses() { proofs_.forget_courses(); }

  /// A certificate that fails or touches zero, and calls for a flip.
  struct Failed {
    CellId cell;
    int facet;
    Identity identity;
  };
  [[nodiscard]] std::optional<Failed> take_failure(unsigned table, std::uint32_t slot);

  /// Returns whether `holds(table, handle)` is true for all certificates.
  template <class Holds>
  [[nodiscard]] bool all_of(Holds holds) const {
    const auto handle_holds = [&](FacetHandle g) {
      return g.about == About::power ? holds(power_tests_, g.handle) : holds(orientations_, g.handle);
    };
    bool all = true;
    for_all_facets([&](CellId cell, int i) {
      const auto [other, k] = state_.across(cell, i);
      all = all && handle_holds(handle(cell, i)) &&
            (handle(cell, i).about != About::cell || handle_holds(handle(other, k)));
    });
    return all;
  }

  /// Calls `visit` with at most `most` of the certificates that do not hold just after now, in the order of
  /// their beads. The negations of these certificates hold.
  template <class Visit>
  void for_violated(std::size_t most, Visit visit) const {
    if (!certified_) return;
    for (const Violated& facet : violated_in_order(most)) {
      if (facet.of_cell) {
        visit(Orientation<Dimension>(state_.beads_of(facet.cell), 1));
      } else {
        with_facet_certificate(state_.beads_of(facet.cell), state_.apex(facet.cell, facet.facet), visit);
      }
    }
  }

  /// From now on, only the marked beads move in a step (one entry for each bead). Facets whose beads are all
  /// at rest are skipped. If empty, all beads move.
  void move_only(std::vector<char> moving);
  [[nodiscard]] bool all_move() const { return moving_.empty(); }
  /// Returns the cells that flips made since move_only; cells may be listed repeatedly or may be removed
  /// already.
  [[nodiscard]] std::span<const CellId> flipped() const { return flipped_; }

  /// See FacetProofs.
  [[nodiscard]] std::span<const std::uint8_t> known_positive_at_end() const {
    return proofs_.known_positive_at_end();
  }
  void forget_ends() { proofs_.forget_ends(); }

  /// Returns the two beads opposite a facet as one number. All facets whose certificates have one function
  /// have the same D + 2 beads, so these two beads distinguish the facets.
  [[nodiscard]] std::uint64_t tie_of(FacetId facet) const {
    const auto [low, high] = std::minmax(
        {state_.vertex(cell_of(facet), index_of(facet)), state_.apex(cell_of(facet), index_of(facet))});
    return std::uint64_t{low} << 32U | high;
  }

  /// Prefetches data for a flip that comes near: first the cell, then, if `next`, the data it refers to.
  void fetch(CellId cell, bool next) const;

 private:
  using About = FacetHandle::About;
  static constexpr std::uint32_t skipped_note = FacetHandle{CertificateHandle::never, About::power}.packed();

  [[nodiscard]] FacetHandle handle(CellId cell, int i) const {
    return FacetHandle::of(state_.triangulation.cells()[cell].note[static_cast<std::size_t>(i)]);
  }
  /// Sets the handle as this cell alone stores it.
  [[gnu::always_inline]] void set_own_handle(CellId cell, int i, FacetHandle value) {
    state_.triangulation.note(cell, i) = value.packed();
    if (notes_ != Notes::any && value.packed() != skipped_note) remember_noted(cell);
  }
  void remember_noted(CellId cell);
  void set_handle(CellId cell, int i, FacetHandle value) {
    set_own_handle(cell, i, value);
    const auto [other, k] = state_.across(cell, i);
    set_own_handle(other, k, value);
  }
  void forget(CellId cell, int i) { set_handle(cell, i, {}); }
  template <class Visit>
  void for_all_facets(Visit visit) const {
    for (CellId cell = 0; cell < state_.triangulation.cells().size(); ++cell) {
      if (!state_.triangulation.is_live(cell)) continue;
      for (int i = 0; i <= Dimension; ++i) {
        if (cell < state_.neighbor(cell, i)) visit(cell, i);
      }
    }
  }

  /// Certificates are searched together: enqueue several, then call watch_enqueued.
  void enqueue(CellId cell, int i);
  void enqueue(const CellCertificates<Dimension + 1>& certificates, CellId cell, int i, KnownAtStart known);
  void watch_enqueued();
  /// Enqueues one certificate of a facet, to be searched with others or already known.
  template <class Certificate, class Make>
  void enqueue_in(CertificateTable<Certificate>& table, FacetId place, KnownAtStart birth, Make make);
  template <class Certificate>
  void remember(const CertificateTable<Certificate>& table, FacetId facet, CertificateHandle handle);
  /// Creates the certificates of all facets that are not proved to hold. Without `in_lanes` no filter is
  /// used.
  template <bool in_lanes>
  void watch_all_moving();
  void watch_marked();
  void note_skipped();
  void hold_inner(CellId cell, int i);
  void watch_cells_beside(CellId cell, int i);
  void watch_cell(CellId cell, int i);
  /// Prefetches the queue entries that a flip will cancel.
  void fetch_scheduled(CellId cell) const {
    for (int i = 0; i <= Dimension; ++i) {
      if (const FacetHandle facet = handle(cell, i); facet.about == About::power)
        power_tests_.fetch_scheduled(facet.handle);
    }
  }

  /// A certificate that does not hold just after now.
  struct Violated {
    std::array<BeadId, Dimension + 2> beads;  ///< ascending; no_bead last if `of_cell`
    bool of_cell;                             ///< the orientation of `cell`
    CellId cell;
    int facet;
  };
  [[nodiscard]] std::vector<Violated> violated_in_order(std::size_t most) const;

  State& state_;
  CertificateTable<PowerTest<Dimension>> power_tests_;
  CertificateTable<Orientation<Dimension>> orientations_;
  FacetProofs<Dimension> proofs_;
  bool certified_ = false;
  /// The meaning of the notes in cells: `any` makes no promise; with `skipped`, all facets are skipped except
  /// perhaps those of the cells in `noted_`.
  enum class Notes : std::uint8_t { any, skipped };
  Notes notes_ = Notes::any;
  std::vector<CellId> noted_;
  std::optional<KnownFailures> known_;
  std::vector<char> moving_;  // for each bead; empty: all move
  std::vector<CellId> flipped_;
};

extern template class FacetCertificates<2>;
extern template class FacetCertificates<3>;

}  // namespace kds
