#pragma once

#include <set>
#include <string>

namespace regoplan {

/// What a recording is laid to.
struct Account {
  enum class Kind {
    kNone,         ///< the model as it was given
    kParameters,   ///< other soil numbers
    kUnexplained,  ///< something without a name
    kEffects,
  };
  Kind kind = Kind::kEffects;
  std::set<std::string> effects = {};  ///< their names, for `kEffects` only

  /// The model itself, with these soil numbers or others.
  bool is_plain() const { return kind == Kind::kNone || kind == Kind::kParameters; }

  /// As results show it: `none`, `parameters`, `unexplained`, `grousers`, `grousers+multi_pass`.
  std::string id() const;
};

}  // namespace regoplan
