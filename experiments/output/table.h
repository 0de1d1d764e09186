#pragma once
// A table whose columns are declared once. The table writes its rows as JSON, as CSV, and as text for a
// terminal.
//
//   const Table<Row> table{{
//       {.key = "seconds", .heading = "seconds", .value = [](const Row& r) { return Field(r.seconds); },
//        .format = shortly},
//       ...
//   }};

#include <concepts>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "experiments/output/result_json.h"

namespace kds {

/// The value of one row in one column, or no value. No value is written as null in JSON, as nothing in CSV,
/// and as - in tables for people.
class Field {
 public:
  Field() = default;
  Field(bool value) : value_(value) {}
  template <std::integral Value>
  Field(Value count) : value_(static_cast<std::uint64_t>(count)) {}  // not negative
  Field(double value) : value_(value) {}
  Field(const char* text) : value_(std::string(text)) {}
  Field(std::string_view text) : value_(std::string(text)) {}
  Field(std::string text) : value_(std::move(text)) {}
  template <class Value>
  Field(const std::optional<Value>& value) {
    if (value) *this = Field(*value);
  }

  [[nodiscard]] bool is_empty() const { return std::holds_alternative<std::monostate>(value_); }
  /// Returns whether the field is text, true or false. Such a field is aligned left; numbers are aligned
  /// right.
  [[nodiscard]] bool is_text() const {
    return std::holds_alternative<std::string>(value_) || std::holds_alternative<bool>(value_);
  }
  /// Returns the value as a double, or NaN unless the field holds a number.
  [[nodiscard]] double number() const;
  [[nodiscard]] Json json() const;        ///< null if empty or not finite
  [[nodiscard]] std::string csv() const;  ///< reads back as the same value

 private:
  friend std::string plainly(const Field& field);
  std::variant<std::monostate, bool, std::uint64_t, double, std::string> value_;
};

/// Returns a field with the text, or without a value if the text is empty.
[[nodiscard]] Field text_or_nothing(const std::string& text);

/// Formats a field that holds a value for people.
using FieldFormat = std::function<std::string(const Field&)>;

/// Formats text unchanged, booleans as yes or no, whole numbers with thousands separators, and other numbers
/// with all digits.
[[nodiscard]] std::string plainly(const Field& field);
/// Formats numbers with about four figures (short_decimal).
[[nodiscard]] std::string shortly(const Field& field);
/// Returns a format with this many digits after the decimal point.
[[nodiscard]] FieldFormat with_decimals(int digits);
/// Returns a format with this many significant digits.
[[nodiscard]] FieldFormat with_figures(int digits);
/// Formats a share as a percentage with three figures.
[[nodiscard]] std::string in_percent(const Field& field);

struct ColumnNames {
  std::string key = {}, heading = {};
  FieldFormat format = plainly;
  bool in_csv = true, optional = false;
};

/// The cell of one row in one column.
struct TableCell {
  Field field;
  std::optional<Json> json;  ///< replaces the field in JSON
  std::string words;         ///< replaces the formatted field for people, unless empty
  [[nodiscard]] bool is_empty() const { return json ? json->is_null() : field.is_empty(); }
};

/// A Table after its rows have been turned into cells. The cells are independent of the row type.
class TableOfCells {
 public:
  void add_column(ColumnNames column) { columns_.push_back(std::move(column)); }
  void add_row(std::vector<TableCell> cells) { rows_.push_back(std::move(cells)); }

  [[nodiscard]] Json json() const;
  [[nodiscard]] std::string csv_header() const;
  [[nodiscard]] std::string csv_lines() const;
  [[nodiscard]] std::vector<std::string> lines() const;

 private:
  [[nodiscard]] std::string alignment_of(std::span<const std::size_t> columns) const;
  [[nodiscard]] std::vector<std::size_t> shown_columns() const;
  [[nodiscard]] std::string shown(const TableCell& cell, std::size_t column) const;

  std::vector<ColumnNames> columns_;
  std::vector<std::vector<TableCell>> rows_;
};

/// A function of a row, or none. Unlike std::function, it may have a default in the aggregate template
/// Column, where GCC 12 fails with std::function.
template <class Result, class Row>
class OfRow {
 public:
  OfRow() noexcept {}
  OfRow(const OfRow& o) : function_(o.function_) {}
  OfRow(OfRow&& o) noexcept : function_(std::move(o.function_)) {}
  OfRow& operator=(const OfRow& o) {
    function_ = o.function_;
    return *this;
  }
  OfRow& operator=(OfRow&& o) noexcept {
    function_ = std::move(o.function_);
    return *this;
  }
  ~OfRow() noexcept {}
  template <class Function>
  requires std::is_invocable_r_v<Result, const Function&, const Row&> OfRow(Function function)
      : function_(std::move(function)) {}
  explicit operator bool() const { return static_cast<bool>(function_); }
  Result operator()(const Row& row) const { return function_(row); }

 private:
  std::function<Result(const Row&)> function_;
};

template <class Row>
struct Column {
  /// Name in JSON and CSV. A column without a name is in neither. "cost.seconds" is the member `seconds` of
  /// the object `cost` in JSON and the column `seconds` in CSV. The object is null if none of its members has
  /// a value.
  std::string key = {};
  std::string heading = {};      ///< for people, with its unit; if empty, the column is not shown
  OfRow<Field, Row> value = {};  ///< if null, the column is in JSON only
  FieldFormat format = plainly;
  OfRow<std::string, Row> words = {};  ///< replaces the format if people see more than the field
  OfRow<Json, Row> json = {};          ///< replaces the value in JSON, for arrays and objects
  bool optional = false;               ///< if true, JSON omits the member when it has no value
};

/// Columns that take their fields from rows of one type.
template <class Row>
class Table {
 public:
  using Rows = std::span<const Row>;

  Table(std::vector<Column<Row>> columns) : columns_(std::move(columns)) {}
  /// Appends columns at the right.
  Table& add(std::vector<Column<Row>> columns) {
    for (auto& column : columns) columns_.push_back(std::move(column));
    return *this;
  }

  /// Returns an array with an object for each row.
  [[nodiscard]] Json json(Rows rows) const { return filled(rows).json(); }
  [[nodiscard]] Json json(const Row& row) const { return filled({&row, 1}).json().items()->front(); }
  /// Returns a header line and a line for each row.
  [[nodiscard]] std::string csv(Rows rows) const { return csv_header() + filled(rows).csv_lines(); }
  [[nodiscard]] std::string csv_header() const { return filled({}).csv_header(); }
  [[nodiscard]] std::string csv_line(const Row& row) const { return filled({&row, 1}).csv_lines(); }
  /// Returns the header and a line for each row, aligned and without newlines.
  [[nodiscard]] std::vector<std::string> lines(Rows rows) const { return filled(rows).lines(); }
  [[nodiscard]] std::string text(Rows rows, std::string_view indent = "") const {
    std::string text;
    for (const std::string& line : lines(rows)) text.append(indent).append(line).append("\n");
    return text;
  }

 private:
  [[nodiscard]] TableOfCells filled(Rows rows) const {
    TableOfCells table;
    for (const auto& c : columns_)
      table.add_column({c.key, c.heading, c.format, static_cast<bool>(c.value), c.optional});
    for (const Row& row : rows) {
      std::vector<TableCell> cells;
      for (const auto& column : columns_) cells.push_back(cell_of(column, row));
      table.add_row(std::move(cells));
    }
    return table;
  }

  [[nodiscard]] static TableCell cell_of(const Column<Row>& column, const Row& row) {
    TableCell cell;
    if (column.value) cell.field = column.value(row);
    if (column.json) cell.json = column.json(row);
    if (column.words && !cell.field.is_empty()) cell.words = column.words(row);
    return cell;
  }

  std::vector<Column<Row>> columns_;
};

}  // namespace kds
