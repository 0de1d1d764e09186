#pragma once
// A table whose columns are declared once. It writes its rows as JSON, as CSV, as text for a terminal and as
// HTML for a page.
//
//   const Table<Row> table{{
//       {.key = "seconds", .heading = "seconds", .value = [](const Row& r) { return Field(r.seconds); },
//        .format = shortly},
//       ...
//   }};

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "experiments/output/result_json.h"

namespace kds {

/// A value of one row in one column, or no value: null in JSON, nothing in CSV, - for people.
class Field {
 public:
  Field() = default;
  Field(bool value) : value_(value) {}
  template <std::unsigned_integral Value>
  Field(Value value) : value_(std::uint64_t{value}) {}
  Field(double value) : value_(value) {}
  Field(const char* text) : value_(std::string(text)) {}
  Field(std::string_view text) : value_(std::string(text)) {}
  Field(std::string text) : value_(std::move(text)) {}
  template <class Value>
  Field(const std::optional<Value>& value) {
    if (value) *this = Field(*value);
  }

  [[nodiscard]] bool is_empty() const { return std::holds_alternative<std::monostate>(value_); }
  [[nodiscard]] bool is_text() const { return std::holds_alternative<std::string>(value_); }
  /// The value as a double; NaN unless the field holds a number.
  [[nodiscard]] double number() const;
  [[nodiscard]] Json json() const;        ///< null if empty or not finite
  [[nodiscard]] std::string csv() const;  ///< reads back as the same value

 private:
  friend std::string plainly(const Field& field);
  std::variant<std::monostate, bool, std::uint64_t, double, std::string> value_;
};

/// How people read a field that holds a value.
using FieldFormat = std::function<std::string(const Field&)>;

/// Text as it is, yes or no, whole numbers with thousands, other numbers with all their digits.
[[nodiscard]] std::string plainly(const Field& field);
/// About four figures (short_decimal).
[[nodiscard]] std::string shortly(const Field& field);
/// Numbers with so many digits behind the point.
[[nodiscard]] FieldFormat with_decimals(int digits);
/// Numbers with so many significant digits.
[[nodiscard]] FieldFormat with_figures(int digits);
/// Shares as percentages with three figures.
[[nodiscard]] std::string in_percent(const Field& field);

/// Where people see a column.
enum class Shown : std::uint8_t { everywhere, in_text, on_pages };

struct ColumnNames {
  /// Name in JSON and CSV; empty: the column is in neither. "cost.seconds" is the member `seconds` of the
  /// object `cost` in JSON, which is null if none of its members has a value, and `seconds` in CSV.
  std::string key = {};
  std::string heading = {};  ///< for people, with its unit; empty: they do not see the column
  FieldFormat format = plainly;
  Shown shown = Shown::everywhere;
};

/// Names of columns and rows of fields: what a Table is made of without its type of row.
class TableOfFields {
 public:
  void add_column(ColumnNames column) { columns_.push_back(std::move(column)); }
  void add_row(std::vector<Field> fields) { rows_.push_back(std::move(fields)); }

  [[nodiscard]] Json json() const;        ///< an array with an object for each row
  [[nodiscard]] std::string csv() const;  ///< a header and a line for each row
  /// A header and a line for each row; text at the left of its column, numbers at the right.
  [[nodiscard]] std::string text(std::string_view indent) const;
  [[nodiscard]] std::string html() const;

 private:
  [[nodiscard]] std::string shown(std::size_t row, std::size_t column) const;
  [[nodiscard]] std::vector<std::size_t> columns_for(Shown reader) const;

  std::vector<ColumnNames> columns_;
  std::vector<std::vector<Field>> rows_;
};

template <class Row>
struct Column {
  std::string key = {};
  std::string heading = {};
  std::function<Field(const Row&)> value;
  FieldFormat format = plainly;
  Shown shown = Shown::everywhere;
};

/// Columns that take their fields from rows of one type.
template <class Row>
class Table {
 public:
  Table(std::vector<Column<Row>> columns) : columns_(std::move(columns)) {}

  [[nodiscard]] Json json(std::span<const Row> rows) const { return filled(rows).json(); }
  [[nodiscard]] std::string csv(std::span<const Row> rows) const { return filled(rows).csv(); }
  [[nodiscard]] std::string text(std::span<const Row> rows, std::string_view indent = "") const {
    return filled(rows).text(indent);
  }
  [[nodiscard]] std::string html(std::span<const Row> rows) const { return filled(rows).html(); }

 private:
  [[nodiscard]] TableOfFields filled(std::span<const Row> rows) const {
    TableOfFields table;
    for (const auto& c : columns_) table.add_column({c.key, c.heading, c.format, c.shown});
    for (const Row& row : rows) {
      std::vector<Field> fields;
      for (const auto& c : columns_) fields.push_back(c.value(row));
      table.add_row(std::move(fields));
    }
    return table;
  }

  std::vector<Column<Row>> columns_;
};

}  // namespace kds
