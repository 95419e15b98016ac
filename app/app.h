#pragma once

/// Commands of the program, for programs of one's own.
#include "app/benchmark/benchmark_main.h"
