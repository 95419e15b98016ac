// Tables on disk: a header, the inputs, the numbers, and a hash over all of it.
#include <fmt/format.h>
#include <unistd.h>

#include <bit>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>
#include <type_traits>
#include <utility>

#include "terramech/force_table/force_table.h"
#include "terramech/parameters/soil.h"

namespace regoplan {
namespace {

/// Changes with the layout of the file, of the table, and with the physics.
constexpr std::string_view kFormat = "regoplan force table 2\n";

std::uint64_t fnv1a(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : bytes) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3ULL;
  }
  return hash;
}

template <class T>
void put(std::ostream& stream, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  std::array<char, sizeof(T)> bytes{};
  std::memcpy(bytes.data(), &value, sizeof(T));
  stream.write(bytes.data(), bytes.size());
}

template <class T>
T get(std::istream& stream) {
  std::array<char, sizeof(T)> bytes{};
  stream.read(bytes.data(), bytes.size());
  T value{};
  std::memcpy(&value, bytes.data(), sizeof(T));
  return value;
}

/// All that a table depends on; a generic correction is added to tables, not part of them.
std::string inputs(const ForceTableSpec& spec) {
  std::ostringstream stream;
  stream << kFormat;
  put(stream, static_cast<int>(spec.model.variant));
  put(stream, spec.model.wheel.radius_m);
  put(stream, spec.model.wheel.width_m);
  for (const SoilParameter& parameter : soil_parameters()) {
    put(stream, spec.model.soil.*parameter.member);
  }
  put(stream, spec.model.gravity_mps2);
  for (const Mechanism& mechanism : spec.model.mechanisms) {
    stream << mechanism.id << ' ' << mechanism.form;
    for (const auto& [name, value] : mechanism.parameters) {
      stream << ' ' << name << ' ';
      put(stream, value);
    }
    stream << '\n';
  }
  put(stream, spec.nominal_load_n);
  put(stream, spec.accuracy.at_999_permille);
  put(stream, spec.accuracy.at_worst);
  return stream.str();
}

std::string whole_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream content;
  content << stream.rdbuf();
  return content.str();
}

/// A folder is shared by processes: each writes beside, under its number.
constexpr std::string_view kSuffix = ".force-table";

/// Removes what processes left that were killed while they wrote. On a disk shared by machines it
/// may take away another's unfinished file: that one then keeps its table to itself.
void sweep_leftovers(const std::filesystem::path& folder) {
  std::error_code failed;
  for (std::filesystem::directory_iterator at(folder, failed), end; !failed && at != end;
       at.increment(failed)) {
    const std::string name = at->path().filename().string();
    const std::size_t dot = name.rfind('.');
    if (dot == std::string::npos || !std::string_view(name).substr(0, dot).ends_with(kSuffix)) {
      continue;
    }
    pid_t process = 0;
    const char* last = name.data() + name.size();
    if (std::from_chars(name.data() + dot + 1, last, process).ptr != last || process <= 0) continue;
    std::error_code ignored;
    if (kill(process, 0) != 0 && errno == ESRCH) std::filesystem::remove(at->path(), ignored);
  }
}

}  // namespace

void ForceTable::write(std::ostream& stream) const {
  put(stream, values_.axes);
  put(stream, values_.sizes);
  put(stream, values_.constant);
  put(stream, error_);
  for (const float value : values_.coefficients) put(stream, value);
}

std::optional<ForceTable> ForceTable::read(std::istream& stream, const ForceTableSpec& spec) {
  const auto axes = get<force_table::Axes>(stream);
  const auto sizes = get<force_table::Sizes>(stream);
  const auto constant = get<force_table::ConstantShares>(stream);
  const auto error = get<TableError>(stream);
  constexpr std::size_t kMost = 10000;
  if (!stream || sizes.loads > kMost || sizes.slips > kMost || sizes.laterals > kMost) {
    return std::nullopt;
  }
  force_table::Values values = force_table::empty_values(axes, sizes, constant);
  for (float& value : values.coefficients) value = get<float>(stream);
  if (!stream) return std::nullopt;
  return ForceTable(spec, std::move(values), error);
}

std::filesystem::path ForceTable::default_cache_folder() {
  if (const char* folder = std::getenv("XDG_CACHE_HOME"); folder && *folder) {
    return std::filesystem::path(folder) / "regoplan";
  }
  if (const char* home = std::getenv("HOME"); home && *home) {
    return std::filesystem::path(home) / ".cache" / "regoplan";
  }
  return {};
}

ForceTable ForceTable::cached(const ForceTableSpec& spec, const std::filesystem::path& folder) {
  if (folder.empty()) return ForceTable(spec);
  const std::string head = inputs(spec);
  const std::filesystem::path file = folder / fmt::format("{:016x}{}", fnv1a(head), kSuffix);
  const std::string content = whole_file(file);
  constexpr std::size_t kHashSize = sizeof(std::uint64_t);
  if (content.size() > head.size() + kHashSize && content.starts_with(head)) {
    const std::string_view body(content.data(), content.size() - kHashSize);
    std::istringstream end(content.substr(body.size()));
    if (get<std::uint64_t>(end) == fnv1a(body)) {
      std::istringstream stream(std::string(body.substr(head.size())));
      if (auto table = read(stream, spec)) return *table;
    }
  }
  ForceTable table(spec);
  std::ostringstream body;
  body << head;
  table.write(body);
  put(body, fnv1a(body.str()));
  // Written beside and renamed: whoever reads meanwhile sees a whole file or none.
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  sweep_leftovers(folder);
  const std::filesystem::path beside = file.string() + fmt::format(".{}", ::getpid());
  std::ofstream stream(beside, std::ios::binary);
  stream << body.str();
  stream.close();
  if (stream) {
    std::filesystem::rename(beside, file, error);
  }
  if (!stream || error) std::filesystem::remove(beside, error);
  return table;
}

}  // namespace regoplan
