#pragma once

#include <gtest/gtest.h>

#include <string>

#include "tests/app/command_output.h"
#include "tests/scratch_folder.h"

namespace regoplan {

/// Opens pages in Debian's Chromium, where it is installed, and reads what they drew.
class InTheBrowser : public testing::Test {
 protected:
  void SetUp() override {
    const std::string programs =
        output_of("command -v chromium-headless-shell || command -v chromium");
    if (programs.empty())
      GTEST_SKIP()
          << "neither chromium-headless-shell nor chromium is installed; pages are not opened";
    // The shell, where it is there: it starts in less than half the time.
    browser_ = programs.substr(0, programs.find('\n'));
  }

  /// What a page shows once its scripts have run: its elements without the scripts.
  std::string drawn(const std::string& page) const {
    const std::string file = folder_.write("report.html", page);
    return without_scripts(
        output_of(browser_ +
                  " --headless --no-sandbox --disable-gpu --no-first-run "
                  "--disable-background-networking --disable-component-update --disable-sync "
                  "--user-data-dir=" +
                  folder_.path("profile") +
                  " --window-size=1400,2400 --virtual-time-budget=4000 --dump-dom file://" + file +
                  " 2>/dev/null"));
  }

  static void expect_drawn_without_error(const std::string& page) {
    EXPECT_NE(page.find("data-drawn=\"yes\""), std::string::npos);
    const std::size_t failure = page.find("id=\"failure\"");
    EXPECT_NE(page.find("id=\"failure\" role=\"alert\" hidden"), std::string::npos)
        << page.substr(failure, page.find("</p>", failure) - failure);
    EXPECT_EQ(page.find("NaN"), std::string::npos);
    EXPECT_EQ(page.find(">undefined"), std::string::npos);
  }

 private:
  static std::string without_scripts(std::string page) {
    const std::string end = "</script>";
    while (true) {
      const std::size_t open = page.find("<script");
      if (open == std::string::npos) return page;
      page.erase(open, page.find(end, open) + end.size() - open);
    }
  }

  std::string browser_;
  ScratchFolder folder_;
};

}  // namespace regoplan
