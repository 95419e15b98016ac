#pragma once

#include <vector>

#include "app/io/staged_files.h"

namespace regoplan {

/// Figs. 6, 7 and 10 of Yoshida & Ishigami (2004) as the model draws them: an SVG and a CSV each.
std::vector<RenderedFile> render_wheel_figures();

}  // namespace regoplan
