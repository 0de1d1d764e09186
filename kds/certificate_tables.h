#pragma once
// The tables of a structure that holds certificates of several types: one table a type, numbered from 1 in
// the order of the types. No virtual call and no search finds a type's table.

#include <cstddef>
#include <tuple>
#include <type_traits>

#include "kds/certificate_table.h"

namespace kds {

template <class... Certificates>
class CertificateTables {
 public:
  static constexpr std::size_t count = sizeof...(Certificates);

  /// `touches(certificate type)` says what the table of this type does about touches: it is called with a
  /// `std::type_identity`.
  template <int Dimension, class TouchesOf>
  CertificateTables(Simulator& simulator, KineticStructure& owner, std::size_t structure,
                    const MotionRef<Dimension>& motion, TouchesOf touches)
      : tables_(Made<Certificates, Dimension>{simulator, owner, structure, motion,
                                              touches(std::type_identity<Certificates>{})}...) {}

  template <class Certificate>
  [[nodiscard]] auto& of() {
    return std::get<Table<Certificate>>(tables_);
  }
  /// Calls `visit` with the table of this number.
  template <class Visit>
  void visit(unsigned number, Visit&& visit) {
    std::apply([&](auto&... tables) { ((tables.number() == number ? visit(tables) : void()), ...); },
               tables_);
  }

  template <class Certificate>
  static constexpr unsigned number_of = [] {
    unsigned number = 0, found = 0;
    ((++number, found = std::same_as<Certificate, Certificates> ? number : found), ...);
    return found;
  }();

 private:
  template <class Certificate, int Dimension>
  struct Made {
    Simulator& simulator;
    KineticStructure& owner;
    std::size_t structure;
    const MotionRef<Dimension>& motion;
    TouchPolicy touches;
  };
  /// A tuple can hold what can be neither copied nor moved, if one thing makes it.
  template <class Certificate>
  struct Table final : CertificateTable<Certificate> {
    template <int Dimension>
    explicit Table(const Made<Certificate, Dimension>& made)
        : CertificateTable<Certificate>(made.simulator, made.owner, made.structure, number_of<Certificate>,
                                        made.motion, made.touches) {}
  };

  std::tuple<Table<Certificates>...> tables_;
};

}  // namespace kds
