// What the program reads of its own is installed with it: an installed program looks nowhere else.
#include <gtest/gtest.h>

#include <regex>

#include "tests/app/documents.h"

namespace regoplan {
namespace {

TEST(ShareFiles, AreAllInstalled) {
  static const std::regex asked(R"re(share_file\("([^"]+)"\))re");
  const std::string installed = page("cmake/shared_files.cmake");
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator("app")) {
    if (entry.path().extension() != ".cpp") continue;
    const std::string source = page(entry.path());
    for (std::sregex_iterator at(source.begin(), source.end(), asked), end; at != end; ++at) {
      const std::string name = (*at)[1].str();
      names.insert(name);
      EXPECT_TRUE(std::filesystem::exists(name)) << entry.path();
      EXPECT_NE(installed.find("    " + name), std::string::npos) << entry.path() << ": " << name;
    }
  }
  EXPECT_TRUE(names.contains("scenarios/drive/sensors_a.yaml"));
}

}  // namespace
}  // namespace regoplan
