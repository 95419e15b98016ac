#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace regoplan {

/// An empty folder of the running test, or of its suite while that is set up; gone after it.
class ScratchFolder {
 public:
  ScratchFolder() {
    const auto* unit = testing::UnitTest::GetInstance();
    const auto* test = unit->current_test_info();
    path_ = std::filesystem::temp_directory_path() /
            (std::string("regoplan-") + unit->current_test_suite()->name() + "-" +
             (test ? test->name() : "suite") + "-" + std::to_string(::getpid()));
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~ScratchFolder() { std::filesystem::remove_all(path_); }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::string path(const std::string& name) const { return (path_ / name).string(); }

  std::string write(const std::string& name, const std::string& content) const {
    std::ofstream(path(name), std::ios::binary) << content;
    return path(name);
  }

  std::string read(const std::string& name) const {
    std::ifstream stream(path(name), std::ios::binary);
    std::stringstream content;
    content << stream.rdbuf();
    return content.str();
  }

  /// Takes over what stands in another, which stays as it is.
  void copy_from(const ScratchFolder& other) const {
    std::filesystem::copy(other.path_, path_, std::filesystem::copy_options::recursive);
  }

  /// How many files and folders stand in it, at any depth.
  long count() const {
    return std::distance(std::filesystem::recursive_directory_iterator(path_), {});
  }

 private:
  std::filesystem::path path_;
};

}  // namespace regoplan
