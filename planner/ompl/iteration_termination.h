#pragma once

/// OMPL's header has no guard of its own (1.5): it is included here and nowhere else.
#include <ompl/base/terminationconditions/IterationTerminationCondition.h>
