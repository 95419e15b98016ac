#include "app/page/report_page.h"

#include <gtest/gtest.h>

#include <limits>

#include "app/page/report_assets.h"

namespace regoplan {
namespace {

TEST(ReportPage, FillsEveryPlaceOfItsFrame) {
  const std::string page = render({.title = "T",
                                   .headline = "H",
                                   .lead = {"first", "second"},
                                   .body_html = "<p id=\"b\"></p>",
                                   .script = "draw();",
                                   .data_json = "{\"answer\":42}"});
  EXPECT_NE(page.find("<title>T</title>"), std::string::npos);
  EXPECT_NE(page.find(">H</h1>"), std::string::npos);
  EXPECT_NE(page.find("<p>first</p>\n<p>second</p>"), std::string::npos);
  EXPECT_NE(page.find("<p id=\"b\"></p>"), std::string::npos);
  EXPECT_NE(page.find("draw();\n</script>"), std::string::npos);
  EXPECT_NE(page.find("{\"answer\":42}"), std::string::npos);
  EXPECT_NE(page.find(report_assets::kD3), std::string::npos);
}

TEST(ReportPage, ReadsNoPlaceholderInWhatItFillsIn) {
  ReportPage page;
  page.headline = "a {{data}} b";
  EXPECT_NE(render(page).find("a {{data}} b"), std::string::npos);
}

TEST(ReportPage, EmbedsFilesByteForByte) {
  EXPECT_EQ(report_assets::kPageHtml.rfind("<!DOCTYPE html>", 0), 0u);
  EXPECT_NE(report_assets::kD3.find("d3js.org v5.16"), std::string_view::npos);
  EXPECT_GT(report_assets::kD3.size(), 200000u);
  EXPECT_EQ(report_assets::kPageHtml.substr(report_assets::kPageHtml.size() - 8), "</html>\n");
}

TEST(HtmlEscaped, LeavesNoMarkup) {
  EXPECT_EQ(html_escaped("<a href='x'>\"&\"</a>"),
            "&lt;a href=&#39;x&#39;&gt;&quot;&amp;&quot;&lt;/a&gt;");
}

TEST(JsonForHtml, CannotEndItsScript) {
  const nlohmann::json data = {{"name", "</script><!--"}};
  const std::string text = json_for_html(data);
  EXPECT_EQ(text.find('<'), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(text), data);
}

TEST(JsonForHtml, WritesWhatIsNotFiniteAsNull) {
  EXPECT_EQ(json_for_html({{"x", std::numeric_limits<double>::quiet_NaN()}}), "{\"x\":null}");
}

}  // namespace
}  // namespace regoplan
