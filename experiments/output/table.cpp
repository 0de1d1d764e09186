#include "experiments/output/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/output/text.h"
#include "motions/base/text_input.h"

namespace kds {

namespace {

/// Returns the name of a column in CSV: the part of the key after the last dot.
std::string_view last_name(std::string_view key) { return key.substr(key.rfind('.') + 1); }

}  // namespace

double Field::number() const {
  if (const auto* whole = std::get_if<std::uint64_t>(&value_)) return static_cast<double>(*whole);
  if (const auto* real = std::get_if<double>(&value_)) return *real;
  return std::numeric_limits<double>::quiet_NaN();
}

Json Field::json() const {
  if (const auto* real = std::get_if<double>(&value_); real != nullptr && !std::isfinite(*real)) return {};
  return std::visit(
      []<class Value>(const Value& value) {
        if constexpr (std::is_same_v<Value, std::monostate>) {
          return Json();
        } else {
          return Json(value);
        }
      },
      value_);
}

std::string Field::csv() const {
  if (is_empty()) return "";
  if (const auto* text = std::get_if<std::string>(&value_)) return csv_field(*text);
  if (const auto* truth = std::get_if<bool>(&value_)) return *truth ? "true" : "false";
  if (const auto* whole = std::get_if<std::uint64_t>(&value_)) return fmt::format("{}", *whole);
  return fmt::format("{}", std::get<double>(value_));
}

std::string plainly(const Field& field) {
  if (const auto* text = std::get_if<std::string>(&field.value_)) return *text;
  if (const auto* truth = std::get_if<bool>(&field.value_)) return *truth ? "yes" : "no";
  if (const auto* whole = std::get_if<std::uint64_t>(&field.value_)) return with_thousands(*whole);
  return field.csv();
}

std::string shortly(const Field& field) { return short_decimal(field.number()); }

FieldFormat with_decimals(int digits) {
  return [digits](const Field& field) { return fmt::format("{:.{}f}", field.number(), digits); };
}

FieldFormat with_figures(int digits) {
  return [digits](const Field& field) { return fmt::format("{:.{}g}", field.number(), digits); };
}

std::string in_percent(const Field& field) { return fmt::format("{:.3g}%", 100 * field.number()); }

Field text_or_nothing(const std::string& text) { return text.empty() ? Field() : Field(text); }

std::vector<std::size_t> TableOfCells::shown_columns() const {
  std::vector<std::size_t> indices;
  for (std::size_t c = 0; c < columns_.size(); ++c)
    if (!columns_[c].heading.empty()) indices.push_back(c);
  return indices;
}

std::string TableOfCells::shown(const TableCell& cell, std::size_t column) const {
  if (cell.field.is_empty()) return "-";
  return cell.words.empty() ? columns_[column].format(cell.field) : cell.words;
}

Json TableOfCells::json() const {
  Json rows = Json::array();
  for (const std::vector<TableCell>& cells : rows_) {
    Json row = Json::object();
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      const std::string& key = columns_[c].key;
      if (key.empty() || (columns_[c].optional && cells[c].is_empty())) continue;
      const Json value = cells[c].json ? *cells[c].json : cells[c].field.json();
      const std::size_t dot = key.find('.');
      if (dot == std::string::npos) {
        row[key] = value;
        continue;
      }
      const std::string_view object = std::string_view(key).substr(0, dot + 1);
      const bool has_values = std::ranges::any_of(columns_, [&](const ColumnNames& other) {
        const auto index = static_cast<std::size_t>(&other - columns_.data());
        return other.key.starts_with(object) && !cells[index].is_empty();
      });
      Json& member = row[object.substr(0, dot)];
      if (has_values) member[last_name(key)] = value;
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string TableOfCells::csv_header() const {
  std::string line;
  for (const ColumnNames& column : columns_) {
    if (!column.key.empty() && column.in_csv) line += csv_field(last_name(column.key)) + ',';
  }
  if (!line.empty()) line.pop_back();
  return line + '\n';
}

std::string TableOfCells::csv_lines() const {
  std::string text;
  for (const std::vector<TableCell>& cells : rows_) {
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      if (!columns_[c].key.empty() && columns_[c].in_csv) text += cells[c].field.csv() + ',';
    }
    if (!text.empty()) text.back() = '\n';
  }
  return text;
}

std::string TableOfCells::alignment_of(std::span<const std::size_t> columns) const {
  std::string alignment;
  for (const std::size_t c : columns) {
    const bool is_text =
        std::ranges::any_of(rows_, [&](const auto& cells) { return cells[c].field.is_text(); });
    alignment += is_text ? '<' : '>';
  }
  return alignment;
}

std::vector<std::string> TableOfCells::lines() const {
  const std::vector<std::size_t> columns = shown_columns();
  std::vector<std::vector<std::string>> lines(1);
  for (const std::size_t c : columns) lines[0].push_back(columns_[c].heading);
  for (const std::vector<TableCell>& cells : rows_) {
    std::vector<std::string>& line = lines.emplace_back();
    for (const std::size_t c : columns) line.push_back(one_line(shown(cells[c], c)));
  }
  return in_columns(lines, alignment_of(columns));
}

}  // namespace kds
