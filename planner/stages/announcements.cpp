#include "planner/stages/announcements.h"

namespace regoplan {

void Announcements::stage(std::string_view stage, double share) const {
  session_.on_progress({.stage = stage, .share = share, .found = found_, .verified = verified_});
}

void Announcements::path_verified(const Candidate& candidate) {
  ++verified_;
  const double now_s = budget_.elapsed_s();
  if (!first_verified_s_) first_verified_s_ = now_s;
  session_.on_verified(candidate, now_s);
}

}  // namespace regoplan
