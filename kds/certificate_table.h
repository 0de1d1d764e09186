#pragma once
// The certificates of one type that a structure holds. Certificates that never fail in the step are only
// counted. Each other certificate gets a slot in the table and an entry in the queue. A table that has grown
// to its size makes no allocation per certificate.

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "certificates/search/certificate_search.h"
#include "kds/kinetic_structure.h"
#include "kds/simulator.h"
#include "motions/base/grow_little.h"

namespace kds {

/// A structure keeps this handle of each certificate it created: a slot number or one of the values below.
enum class CertificateHandle : std::uint32_t {
  never = 0xffffffffU,     ///< holds for the rest of the step; nothing is kept
  zero = 0xfffffffeU,      ///< the function is zero for the whole step; treated as `never`
  violated = 0xfffffffdU,  ///< does not hold just after the present time; nothing is kept
};                         // any other value is a slot number
[[nodiscard]] constexpr bool has_slot(CertificateHandle handle) {
  return handle < CertificateHandle::violated;
}
[[nodiscard]] constexpr std::uint32_t slot_of(CertificateHandle handle) {
  return static_cast<std::uint32_t>(handle);
}

/// Numbers the tables of a run: by structure, then by table.
class NumberOfTable {
 public:
  /// Throws std::logic_error if the structure or the table has a number of 65536 or more.
  NumberOfTable(std::size_t structure, unsigned number) {
    if (structure >= most || number >= most)
      throw std::logic_error("a run has at most 65536 structures, and each as many tables of certificates");
    table_ = static_cast<std::uint32_t>(structure << 16U) | number;
  }

  [[nodiscard]] std::uint32_t value() const { return table_; }

 private:
  static constexpr std::size_t most = 65536;
  std::uint32_t table_;
};

namespace detail {

/// The identity of a certificate with constants needs two more entries: its last entry names the table, and
/// the entry before the last stays unused.
template <class Certificate>
concept IdentityHasRoom = !HasConstants<Certificate> ||
                          (std::tuple_size_v<decltype(Certificate{}.beads)> + 2 <= Identity::most_beads);

/// Tells whether a table's constants are in use, which is so once a certificate was searched in this step.
/// Empty for certificates without constants.
template <class Certificate>
struct ConstantsInUse {};
template <HasConstants Certificate>
struct ConstantsInUse<Certificate> {
  bool value = false;
};

}  // namespace detail

/// The motion of a table's certificates. A structure with a motion of its own, such as one with other radii,
/// has other functions of the same beads than the run's other structures.
enum class TableMotion : std::uint8_t { of_run, of_structure };

/// A table of certificates of one type, a NamedCertificate. The static assertions say in one sentence what a
/// type lacks, before the compiler reports the violated concept at length.
template <class Certificate>
class CertificateTable final : public FailureSource {
  static_assert(HasCertificateType<Certificate>,
                "a certificate needs `static constexpr kds::CertificateType type{number, name};`");
  static_assert(HasIdentity<Certificate>,
                "a certificate needs `kds::Identity identity() const`: what names its function");
  static_assert(HasSide<Certificate>,
                "a certificate needs `bool side() const`: which sign of its function it wants");
  static_assert(DeclaresItsConstants<Certificate>,
                "a member of a certificate's `struct Constants` needs a declared power of length: it is a "
                "kds::Constant<1>, a kds::ConstantVector, ..., not a number");
  static_assert(detail::IdentityHasRoom<Certificate>, "a certificate with constants has at most 6 beads");

 public:
  /// `number` distinguishes the structure's tables in KineticStructure::fail. Throws std::logic_error if the
  /// run has certificates of another type with the same type number.
  template <int Dimension>
  CertificateTable(Simulator& simulator, KineticStructure& owner, std::size_t structure, unsigned number,
                   const MotionRef<Dimension>& motion, TouchPolicy touches = TouchPolicy::ignored,
                   TableMotion whose = TableMotion::of_run)
      : simulator_(simulator),
        owner_(owner),
        structure_(structure),
        number_(number),
        table_in_run_(structure, number),
        search_(search_over<Certificate>(motion)),
        touches_(touches),
        whose_(whose) {
    simulator.add_table(*this, Certificate::type);
  }

  /// Sets the constants of all certificates from now to the end of the step, or until constants are set
  /// again. Set them for the first time before the structure is built. Throws std::invalid_argument if a
  /// value cannot be a constant over the motion. Throws std::logic_error if certificates were already
  /// searched in this step, because these depend on the previous constants.
  void set_constants(const ConstantsOf<Certificate>& constants) requires(HasConstants<Certificate>) {
    if (constants_in_use_.value)
      throw std::logic_error(std::string(Certificate::type.name) +
                             ": constants are set in the midst of a step, expected before its certificates");
    search_->set_constants(constants);
  }

  /// Adds a certificate, which guards the structure from now to the end of the step. `place` is the
  /// certificate's place in the structure. The place is passed back with the failure, and
  /// KineticStructure::tie_of turns it into the number that breaks ties between certificates of one function.
  [[nodiscard]] CertificateHandle watch(const Certificate& certificate, std::uint32_t place,
                                        KnownAtStart birth = KnownAtStart::unknown) {
    Failure failure;
    find_failures({&certificate, 1}, {&birth, 1}, {&failure, 1});
    return hold(certificate, place, failure);
  }

  /// Enqueues a certificate to be searched with others: searching four at once costs little more than
  /// searching one. Enqueue many certificates, then call watch_enqueued.
  void enqueue(const Certificate& certificate, std::uint32_t place, KnownAtStart birth) {
    enqueue_empty(place, birth) = certificate;
  }
  /// Enqueues a certificate whose failure is already known.
  void enqueue_known(const Certificate& certificate, std::uint32_t place, const Failure& failure) {
    enqueue(certificate, place, KnownAtStart::unknown);
    known_[waiting_count_ - 1] = 1;
    failures_[waiting_count_ - 1] = failure;
    any_known_ = true;
  }
  /// Enqueues one of possibly very many certificates. The certificates are searched a few hundred at a time,
  /// so that they need little memory. Certificates enqueued this way cannot be forgotten by forget_enqueued.
  void enqueue_one_of_many(const Certificate& certificate, std::uint32_t place, KnownAtStart birth) {
    one_of_many(place, birth) = certificate;
  }
  /// Enqueues one of many as above, and returns a reference, through which the caller constructs it. Copying
  /// a certificate just made elsewhere is slow.
  [[nodiscard]] Certificate& one_of_many(std::uint32_t place, KnownAtStart birth) {
    constexpr std::size_t at_a_time = 512;
    if (waiting_count_ >= at_a_time)
      search_enqueued([this](std::uint32_t at, CertificateHandle handle) {
        append_little(settled_, {at, handle});
      });
    return enqueue_empty(place, birth);
  }
  /// Searches the enqueued certificates and calls `visit` with the place and the handle of each, in the order
  /// in which they were enqueued.
  template <std::invocable<std::uint32_t, CertificateHandle> Visit>
  void watch_enqueued(Visit visit) {
    for (const SearchedCertificate& s : settled_) visit(s.place, s.handle);
    settled_.clear();
    search_enqueued(visit);
  }
  void forget_enqueued() {
    waiting_count_ = 0;
    any_known_ = false;
  }

  /// Removes a certificate that has not failed.
  void drop(CertificateHandle handle) {
    if (handle == CertificateHandle::violated) return;
    --owner_.statistics.certificates.alive;
    if (!has_slot(handle)) return;
    ++owner_.statistics.certificates.cancelled;
    simulator_.cancel(slots_[slot_of(handle)].queued);
    free_.push_back(slot_of(handle));
  }

  /// Removes all certificates in the queue for which `asked(certificate)` is true. Visits every slot. Must
  /// not be called while an event is being handled.
  template <std::predicate<const Certificate&> Asked>
  void drop_if(Asked asked) {
    std::vector<std::uint8_t> is_free(slots_.size(), 0);
    for (const std::uint32_t slot : free_) is_free[slot] = 1;
    for (std::uint32_t slot = 0; slot < is_free.size(); ++slot) {
      if (is_free[slot] == 0 && asked(slots_[slot].certificate)) drop(static_cast<CertificateHandle>(slot));
    }
  }
  /// Sets the certificate's place in the structure from now on.
  void set_place(CertificateHandle handle, std::uint32_t place) {
    if (has_slot(handle)) slots_[slot_of(handle)].place = place;
  }

  /// Counts certificates that are known to hold for the rest of the step.
  void hold_never(std::uint64_t count) {
    CertificateCounts& counts = owner_.statistics.certificates;
    counts.created += count;
    counts.never_failing += count;
    counts.alive += count;
    counts.peak = std::max(counts.peak, counts.alive);
  }

  /// Prefetches the certificate, which will be needed soon.
  void fetch(CertificateHandle handle) const {
    if (has_slot(handle)) __builtin_prefetch(&slots_[slot_of(handle)]);
  }
  /// Prefetches the queue entry of a certificate that will be removed soon.
  void fetch_scheduled(CertificateHandle handle) const {
    if (has_slot(handle)) simulator_.fetch(slots_[slot_of(handle)].queued);
  }
  /// The failure time of a certificate in the queue.
  [[nodiscard]] const FailureTime& time(std::uint32_t slot) const {
    return simulator_.scheduled(slots_[slot].queued);
  }
  [[nodiscard]] const Certificate& certificate(std::uint32_t slot) const { return slots_[slot].certificate; }
  /// Returns whether the certificate only touches zero at its time and does not fail. Always false unless the
  /// table reports touches.
  [[nodiscard]] bool touches(std::uint32_t slot) const { return slots_[slot].touch; }
  [[nodiscard]] std::uint32_t place_in_structure(std::uint32_t slot) const { return slots_[slot].place; }

  /// Returns the search, which also answers questions about certificates that are not in the table.
  [[nodiscard]] const CertificateSearch<Certificate>& search() const { return *search_; }
  /// Returns the number that distinguishes the structure's tables.
  [[nodiscard]] unsigned number() const { return number_; }

  [[nodiscard]] ExactFunction exact_function(std::uint32_t slot) const override {
    return search_->exact_function(slots_[slot].certificate);
  }
  [[nodiscard]] Identity identity(std::uint32_t slot) const override {
    return identity(slots_[slot].certificate);
  }
  /// Returns the identity of `certificate` in this table. The identity names the beads and, for a type with
  /// constants, the table, because other constants give another function of the same beads. If the motion is
  /// the structure's own, it names the structure.
  [[nodiscard]] Identity identity(const Certificate& certificate) const {
    Identity identity = certificate.identity();
    if (whose_ == TableMotion::of_structure) identity.beads.back() = static_cast<BeadId>(structure_);
    if constexpr (HasConstants<Certificate>) identity.beads.back() = table_in_run_.value();
    return identity;
  }
  [[nodiscard]] TiePlace place(std::uint32_t slot) const override {
    return {table_in_run_.value(), owner_.tie_of(number_, slots_[slot].place)};
  }
  [[nodiscard]] std::size_t structure() const override { return structure_; }

 private:
  // Called by the engine only.

  [[nodiscard]] bool side(std::uint32_t slot) const override { return slots_[slot].certificate.side(); }
  void fetch(std::uint32_t slot, unsigned bins_ahead) const override {
    if (bins_ahead == 2) {
      __builtin_prefetch(&slots_[slot]);
    } else {
      owner_.fetch(number_, slots_[slot].place, bins_ahead == 0);
    }
  }
  void fail(std::uint32_t slot) override {
    ++(touches(slot) ? owner_.statistics.certificates.touched : owner_.statistics.certificates.failed);
    --owner_.statistics.certificates.alive;
    owner_.fail(number_, slot);
  }
  void retire(std::uint32_t slot) override { free_.push_back(slot); }
  void clear() override {
    slots_.clear();
    free_.clear();
    constants_in_use_ = {};
    owner_.statistics.certificates.alive = 0;
  }

  struct Slot {
    Certificate certificate;
    std::uint32_t place = 0;
    QueueHandle queued = 0;
    bool touch = false;
  };

  struct SearchedCertificate {
    std::uint32_t place;
    CertificateHandle handle;
  };

  template <std::invocable<std::uint32_t, CertificateHandle> Visit>
  void search_enqueued(Visit visit) {
    const std::size_t count = waiting_count_;
    for (std::size_t from = 0; from < count;) {  // search all between two known ones at once
      std::size_t to = count;
      if (any_known_) {
        while (from < count && known_[from] != 0) ++from;
        to = from;
        while (to < count && known_[to] == 0) ++to;
      }
      if (from < to) {
        find_failures(std::span(waiting_).subspan(from, to - from),
                      std::span(births_).subspan(from, to - from),
                      std::span(failures_).subspan(from, to - from));
      }
      from = to;
    }
    any_known_ = false;
    for (std::size_t i = 0; i < count; ++i) visit(places_[i], hold(waiting_[i], places_[i], failures_[i]));
    waiting_count_ = 0;
  }

  [[nodiscard]] Certificate& enqueue_empty(std::uint32_t place, KnownAtStart birth) {
    if (waiting_count_ == waiting_.size()) make_room();
    places_[waiting_count_] = place;
    births_[waiting_count_] = birth;
    known_[waiting_count_] = 0;
    return waiting_[waiting_count_++];
  }

  void make_room() {
    const std::size_t room = std::max<std::size_t>(16, 2 * waiting_.size());
    waiting_.resize(room);
    places_.resize(room);
    births_.resize(room);
    known_.resize(room);
    failures_.resize(room);
  }

  void find_failures(std::span<const Certificate> certificates, std::span<const KnownAtStart> births,
                     std::span<Failure> failures) {
    if constexpr (HasConstants<Certificate>) constants_in_use_.value = true;
    search_->first_failures(simulator_.kernel(), certificates, simulator_.now(), births,
                            owner_.statistics.stages, touches_, failures);
  }

  [[nodiscard]] CertificateHandle hold(const Certificate& certificate, std::uint32_t place,
                                       const Failure& failure) {
    if constexpr (HasConstants<Certificate>) constants_in_use_.value = true;
    CertificateCounts& counts = owner_.statistics.certificates;
    ++counts.created;
    if (failure.kind == Failure::Kind::at_birth) {
      ++counts.failed;
      return CertificateHandle::violated;
    }
    counts.peak = std::max(counts.peak, ++counts.alive);
    if (failure.kind != Failure::Kind::later) {
      ++counts.never_failing;
      return failure.kind == Failure::Kind::zero ? CertificateHandle::zero : CertificateHandle::never;
    }
    std::uint32_t slot = 0;
    if (free_.empty()) {
      slot = static_cast<std::uint32_t>(slots_.size());
      extend_little(slots_);
    } else {
      slot = free_.back();
      free_.pop_back();
    }
    Slot& held = slots_[slot];
    held.certificate = certificate;
    held.place = place;
    held.touch = failure.time.touch;
    held.queued = simulator_.schedule(failure.time, *this, slot);
    return static_cast<CertificateHandle>(slot);
  }

  Simulator& simulator_;
  KineticStructure& owner_;
  std::size_t structure_;
  unsigned number_;
  NumberOfTable table_in_run_;
  std::unique_ptr<CertificateSearch<Certificate>> search_;
  TouchPolicy touches_;
  TableMotion whose_;
  std::vector<Slot> slots_;
  std::vector<std::uint32_t> free_;
  // The enqueued certificates with their places, births and failures. These arrays have room for more than
  // `waiting_count_` entries.
  std::vector<Certificate> waiting_;
  std::vector<std::uint32_t> places_;
  std::vector<KnownAtStart> births_;
  std::vector<Failure> failures_;
  std::vector<std::uint8_t> known_;  // for each entry: whether failures_ has its failure already
  bool any_known_ = false;
  std::size_t waiting_count_ = 0;
  std::vector<SearchedCertificate> settled_;  // already searched, from enqueue_one_of_many
  [[no_unique_address]] detail::ConstantsInUse<Certificate> constants_in_use_;
};

}  // namespace kds
