#include "diagnosis/fit/account.h"

namespace regoplan {

std::string Account::id() const {
  switch (kind) {
    case Kind::kNone:
      return "none";
    case Kind::kParameters:
      return "parameters";
    case Kind::kUnexplained:
      return "unexplained";
    case Kind::kEffects:
      break;
  }
  std::string id;
  for (const std::string& effect : effects) id += (id.empty() ? "" : "+") + effect;
  return id;
}

}  // namespace regoplan
