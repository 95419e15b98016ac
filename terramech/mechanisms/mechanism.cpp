#include "terramech/mechanisms/mechanism.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "terramech/basics/input_error.h"
#include "terramech/basics/nearest_name.h"
#include "terramech/mechanisms/mechanism_catalogue.h"

namespace regoplan {
namespace {

using mechanism_catalogue::Definition;

const std::vector<Definition>& all_definitions() {
  static const std::vector<Definition> all = [] {
    std::vector<Definition> sum;
    for (const auto& of : {mechanism_catalogue::of_sinkage(), mechanism_catalogue::of_shear(),
                           mechanism_catalogue::of_soil(), mechanism_catalogue::of_wheel(),
                           mechanism_catalogue::of_flanks_and_rim()}) {
      sum.insert(sum.end(), of.begin(), of.end());
    }
    return sum;
  }();
  return all;
}

std::size_t index_of(const Mechanism& mechanism) {
  const std::vector<MechanismForm>& forms = mechanism_forms();
  std::vector<std::string> of_id;
  for (std::size_t i = 0; i < forms.size(); ++i) {
    if (forms[i].id != mechanism.id) continue;
    if (mechanism.form.empty() || mechanism.form == forms[i].form) return i;
    of_id.emplace_back(forms[i].form);
  }
  if (of_id.empty()) {
    throw InputError(fmt::format("mechanism id: {} is not known ({})", mechanism.id,
                                 name_hint(mechanism.id, mechanism_ids())));
  }
  throw InputError(fmt::format("mechanism {}: form {} is not known ({})", mechanism.id,
                               mechanism.form, name_hint(mechanism.form, of_id)));
}

}  // namespace

const std::vector<MechanismForm>& mechanism_forms() {
  static const std::vector<MechanismForm> forms = [] {
    std::vector<MechanismForm> all;
    for (const Definition& definition : all_definitions()) all.push_back(definition.form);
    return all;
  }();
  return forms;
}

std::vector<std::string> mechanism_ids() {
  std::vector<std::string> ids;
  for (const MechanismForm& form : mechanism_forms()) {
    if (ids.empty() || ids.back() != form.id) ids.emplace_back(form.id);
  }
  return ids;
}

const MechanismForm& form_of(const Mechanism& mechanism) {
  const MechanismForm& form = mechanism_forms()[index_of(mechanism)];
  for (const auto& parameter : mechanism.parameters) {
    const std::string& name = parameter.first;
    const double value = parameter.second;
    const auto known = std::ranges::find(form.parameters, name, &MechanismParameter::name);
    if (known == form.parameters.end()) {
      std::vector<std::string> names;
      for (const MechanismParameter& p : form.parameters) names.emplace_back(p.name);
      throw InputError(fmt::format("mechanism {}: parameter {} is not known ({})", mechanism.id,
                                   name, names.empty() ? "it has none" : name_hint(name, names)));
    }
    if (!(value >= known->least && value <= known->most)) {
      throw ValueError(name, value, fmt::format("{:g} to {:g}", known->least, known->most));
    }
  }
  return form;
}

BoundMechanism bind(const Mechanism& mechanism) {
  const MechanismForm& form = form_of(mechanism);
  BoundMechanism bound{.form = index_of(mechanism)};
  for (std::size_t i = 0; i < form.parameters.size(); ++i) {
    const auto given = mechanism.parameters.find(std::string(form.parameters[i].name));
    bound.parameters.at(i) =
        given == mechanism.parameters.end() ? form.parameters[i].typical : given->second;
  }
  return bound;
}

Effects apply(const std::vector<BoundMechanism>& mechanisms, Effects effects,
              const WheelState& state) {
  for (const BoundMechanism& mechanism : mechanisms) {
    effects = all_definitions()[mechanism.form].act(effects, mechanism.parameters, state);
  }
  return effects;
}

}  // namespace regoplan
