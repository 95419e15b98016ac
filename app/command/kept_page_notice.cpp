#include "app/command/kept_page_notice.h"

#include <fmt/format.h>

#include "app/command/command.h"
#include "app/io/page_command.h"

namespace regoplan {

void notify_of_kept_page(const ResultFolder& folder, std::string_view command, bool quiet) {
  const std::string page = "report.html", other = other_page(folder, command, page);
  if (other.empty()) return;
  const std::string kept = kept_page_name(other, page);
  require_results_fit(folder, {kept});
  notify(fmt::format("{}: the page of {}, kept as {}", (folder.path / page).string(), other, kept),
         quiet);
}

}  // namespace regoplan
