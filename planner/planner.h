#pragma once

/// Plans, verdicts, and the parts of an OMPL program of one's own.
#include "maps/maps.h"
#include "planner/chart/feasibility_chart.h"
#include "planner/evaluation/evaluation.h"
#include "planner/evaluation/manoeuvres.h"
#include "planner/ompl/ompl_planners.h"
#include "planner/ompl/ompl_problem.h"
#include "planner/plan.h"
#include "planner/verdict/verified_path.h"
