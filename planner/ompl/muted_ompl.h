#pragma once

#include <ompl/util/Console.h>

namespace regoplan {

/// Keeps OMPL from printing while it lives, then puts back the output handler that there was. The
/// handler is the process's: one at a time.
class MutedOmpl {
 public:
  MutedOmpl() : before_(ompl::msg::getOutputHandler()) { ompl::msg::noOutputHandler(); }
  ~MutedOmpl() { ompl::msg::useOutputHandler(before_); }
  MutedOmpl(const MutedOmpl&) = delete;
  MutedOmpl& operator=(const MutedOmpl&) = delete;

 private:
  ompl::msg::OutputHandler* before_;
};

}  // namespace regoplan
