#pragma once

#include <string>
#include <vector>

#include "diagnosis/recording/course.h"

namespace regoplan {

/// What replicates follow, and by how much each channel does.
std::string course_note(const Course& course, const std::vector<ChannelNoise>& noise);

/// A course that gains too little to be believed.
std::string doubtful_course_note(const Course& course);

}  // namespace regoplan
