#include "app/page/report_page.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include "app/io/page_command.h"
#include "app/page/report_assets.h"

namespace regoplan {
namespace {

using Filling = std::pair<std::string_view, std::string_view>;

/// Each `{{name}}` of the frame replaced, in one pass: what is filled in is never read again.
template <std::size_t N>
std::string filled(std::string_view frame, const std::array<Filling, N>& fillings) {
  std::string text;
  while (true) {
    const std::size_t open = frame.find("{{");
    text += frame.substr(0, open);
    if (open == std::string_view::npos) return text;
    const std::size_t close = frame.find("}}", open);
    const std::string_view name = frame.substr(open + 2, close - open - 2);
    const auto* filling = std::find_if(fillings.begin(), fillings.end(),
                                       [&](const Filling& f) { return f.first == name; });
    if (close == std::string_view::npos || filling == fillings.end())
      throw std::logic_error("the report's frame asks for {{" + std::string(name) + "}}");
    text += filling->second;
    frame.remove_prefix(close + 2);
  }
}

std::string paragraphs(const std::vector<std::string>& sentences) {
  std::string html;
  for (const std::string& sentence : sentences) html += "<p>" + html_escaped(sentence) + "</p>\n";
  return html;
}

}  // namespace

std::string html_escaped(std::string_view text) {
  std::string html;
  html.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      case '\'':
        html += "&#39;";
        break;
      default:
        html += c;
    }
  }
  return html;
}

std::string json_for_html(const nlohmann::json& data) {
  const std::string json = data.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  std::string html;
  html.reserve(json.size());
  for (const char c : json) {
    if (c == '<') {
      html += "\\u003c";
    } else {
      html += c;
    }
  }
  return html;
}

std::string render(const ReportPage& page) {
  const std::string title = html_escaped(page.title);
  const std::string headline = html_escaped(page.headline);
  const std::string lead = paragraphs(page.lead);
  const std::string mark = page_mark(page.command);
  const std::array<Filling, 11> fillings{{{"mark", mark},
                                          {"title", title},
                                          {"headline", headline},
                                          {"lead", lead},
                                          {"body", page.body_html},
                                          {"data", page.data_json},
                                          {"css", report_assets::kPageCss},
                                          {"d3", report_assets::kD3},
                                          {"d3_licence", report_assets::kD3Licence},
                                          {"page_script", report_assets::kPageScript},
                                          {"script", page.script}}};
  return filled(report_assets::kPageHtml, fillings);
}

}  // namespace regoplan
