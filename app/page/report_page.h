#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace regoplan {

/// What one report is made of. Text is plain text; only `body_html` and `script` are trusted.
struct ReportPage {
  std::string_view command;  ///< that makes it
  std::string title;
  std::string headline;           ///< the verdict in one sentence
  std::vector<std::string> lead;  ///< what else must be known first, a sentence each
  std::string_view body_html;     ///< the report's own sections, from app/report/
  std::string_view script;        ///< draws them, from app/report/; finds `data` as `REPORT`
  std::string data_json;          ///< everything drawn, as `json_for_html` writes it
};

/// One HTML file that opens from disk and loads nothing: d3, style, scripts and data are inside,
/// and a content security policy forbids the rest.
std::string render(const ReportPage& page);

/// Text as it may stand in HTML, also within a quoted attribute.
std::string html_escaped(std::string_view text);

/// JSON as it may stand in a script element: no `<`. Numbers that are not finite become null,
/// text that is not UTF-8 is marked with U+FFFD.
std::string json_for_html(const nlohmann::json& data);

}  // namespace regoplan
