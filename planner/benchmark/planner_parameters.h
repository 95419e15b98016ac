#pragma once

#include <ompl/base/Planner.h>

#include <map>
#include <string>

namespace regoplan {

/// Gives a planner its parameters, as OMPL names them. What the planner itself suggests as their
/// range is what is allowed: OMPL's setters take a probability of 3 without a word.
/// \param name of the planner, for the message
/// \throws InputError for a parameter that the planner does not have, or a value that is beyond its
/// range or of another type
void set_parameters(ompl::base::Planner& planner, const std::string& name,
                    const std::map<std::string, std::string>& parameters);

}  // namespace regoplan
