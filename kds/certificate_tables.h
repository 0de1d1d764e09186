#pragma once
// The tables of a structure that holds certificates of several types: one table for each type, numbered from
// 1 in the order of the types. Finding the table of a type takes neither a virtual call nor a search. A type
// has no table if the structure can never hold a certificate of this type.

#include <cstddef>
#include <optional>
#include <tuple>
#include <type_traits>

#include "kds/certificate_table.h"

namespace kds {

template <class... Certificates>
class CertificateTables {
 public:
  static constexpr std::size_t count = sizeof...(Certificates);

  /// `touches` is called with the `std::type_identity` of each certificate type. `touches` returns the touch
  /// policy of the table of this type, or an empty optional if the type has no table.
  template <int Dimension, class TouchesOf>
  CertificateTables(Simulator& simulator, KineticStructure& owner, std::size_t structure,
                    const MotionRef<Dimension>& motion, TouchesOf touches) {
    const auto make = [&]<class Certificate>(std::optional<CertificateTable<Certificate>>& table) {
      if (const std::optional<TouchPolicy> policy = touches(std::type_identity<Certificate>{}))
        table.emplace(simulator, owner, structure, number_of<Certificate>, motion, *policy);
    };
    std::apply([&](auto&... tables) { (make(tables), ...); }, tables_);
  }

  template <class Certificate>
  [[nodiscard]] auto& of() {
    return *std::get<std::optional<CertificateTable<Certificate>>>(tables_);
  }
  /// Calls `visit` with the table that has this number.
  template <class Visit>
  void visit(unsigned number, Visit&& visit) {
    const auto visit_if = [&](auto& table) {
      if (table && table->number() == number) visit(*table);
    };
    std::apply([&](auto&... tables) { (visit_if(tables), ...); }, tables_);
  }

  template <class Certificate>
  static constexpr unsigned number_of = [] {
    unsigned number = 0, found = 0;
    ((++number, found = std::same_as<Certificate, Certificates> ? number : found), ...);
    return found;
  }();

 private:
  std::tuple<std::optional<CertificateTable<Certificates>>...> tables_;
};

}  // namespace kds
