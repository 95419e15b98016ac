#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace regoplan {

/// The shortest text that reads back to the same number; empty for NaN and infinities.
std::string number_cell(double value);

/// Text as a CSV cell, quoted where it must be.
std::string text_cell(std::string_view text);

/// As `text_cell`, for text that this program writes of its own accord, as the name of a soil:
/// where a spreadsheet would take it for a formula, an apostrophe stands in front.
std::string own_text_cell(std::string_view text);

/// Whether a cell holds a byte that no text has, and at which a message that quotes it would end.
bool holds_zero_byte(const std::vector<std::string>& cells);

/// What a header shows of a table that other programs wrote, in words: separated by something else
/// than commas, UTF-16, or lines that end in a carriage return alone. Nothing where it is a header.
std::optional<std::string> why_no_table(const std::vector<std::string>& columns);

/// What a table's columns are called where columns `added` are written beside them: one of the same
/// name is `input_<name>`, with as many `input_` as make it a name of its own.
std::vector<std::string> names_beside(const std::vector<std::string>& columns,
                                      const std::vector<std::string>& added);

/// The cells of one line, quotes taken off. Nothing where a quote is not closed.
std::optional<std::vector<std::string>> split_cells(std::string_view line);

}  // namespace regoplan
