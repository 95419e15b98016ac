#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "terramech/basics/input_error.h"
#include "terramech/basics/value_range.h"

namespace regoplan {

/// A number of a table that is none of those allowed there.
struct CellOutOfRange {
  std::int64_t line = 0;
  std::string column;
  double value = 0;
  std::string allowed;  ///< in words
};

class OutOfRangeError : public InputError {
 public:
  OutOfRangeError(const InputError& error, CellOutOfRange cell)
      : InputError(error), cell_(std::move(cell)) {}

  const CellOutOfRange& cell() const { return cell_; }

 private:
  CellOutOfRange cell_;
};

/// A line that is no row of its table, as a log ends in where the power failed: another number of
/// cells than the header, or zero bytes.
class TornRowError : public InputError {
 public:
  explicit TornRowError(const InputError& error) : InputError(error) {}
};

/// The known name that a column of another writing (`Load_N`, `load_n [N]`) most likely stands for:
/// none that the table has.
std::optional<std::string> meant_column(std::string_view written,
                                        const std::vector<std::string>& columns,
                                        const std::vector<std::string>& known);

/// What lines without anything but blanks and separators are.
enum class EmptyLines { kOnlyAtTheEnd, kAnywhere };

/// A CSV table with a header (RFC 4180, one line a row), read row by row. A byte-order mark, blanks
/// around cells and columns without name and content (separators that a spreadsheet leaves at the
/// end) say nothing, nor does a first column without a name that counts the rows (what data frames
/// write). What is wrong with it is an InputError that names file and line.
class CsvTable {
 public:
  using Cells = std::vector<std::string>;

  /// \param file the table's name, for errors
  /// \throws InputError for a missing header and a column given twice
  CsvTable(std::istream& stream, std::string file,
           EmptyLines empty_lines = EmptyLines::kOnlyAtTheEnd);

  const Cells& columns() const { return columns_; }
  std::optional<std::size_t> find_column(std::string_view sought) const;
  /// \throws InputError where there is none
  std::size_t column(std::string_view sought) const;

  /// As `column`; where there is none, the error says which column may be meant to be it.
  /// \param known all names that mean something in such a table
  std::size_t required_column(std::string_view sought, const std::vector<std::string>& known) const;

  /// The next row, as wide as `columns`; nothing at the end.
  /// \throws TornRowError for a row of another width than the header or with zero bytes, InputError
  ///   for a value in a column without a name: of what it is nobody knows
  std::optional<Cells> next();
  /// Where the row stands that `next` gave last.
  std::int64_t line() const { return line_; }

  /// A cell of the row that `next` gave last.
  /// \param hint what may be meant instead, for the error
  /// \throws OutOfRangeError for a number outside `allowed`, InputError for what is no number
  double number(const Cells& cells, std::size_t index, const ValueRange& allowed,
                std::string_view hint = "") const;

  InputError error(const std::string& what) const;

 private:
  std::optional<Cells> next_line();
  bool is_empty(std::string_view line) const;
  void read_header();
  /// The cells of the columns with a name. \throws InputError where another has one
  Cells named(const Cells& cells) const;

  std::istream& stream_;
  std::string file_;
  EmptyLines empty_lines_;
  std::int64_t line_ = 0;
  Cells columns_;
  std::vector<std::size_t> places_;  ///< of `columns_` in the header
  std::size_t width_ = 0;            ///< cells of the header
};

}  // namespace regoplan
