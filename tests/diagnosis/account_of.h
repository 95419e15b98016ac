#pragma once

#include <sstream>
#include <string>

#include "diagnosis/fit/account.h"

namespace regoplan {

/// The account that results show as `id`.
inline Account account_of(const std::string& id) {
  for (const auto kind :
       {Account::Kind::kNone, Account::Kind::kParameters, Account::Kind::kUnexplained}) {
    if (Account{kind}.id() == id) return {kind};
  }
  Account account;
  std::istringstream names(id);
  for (std::string name; std::getline(names, name, '+');) account.effects.insert(name);
  return account;
}

}  // namespace regoplan
