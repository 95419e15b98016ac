#include "app/settings/settings_node.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "app/io/printable_text.h"
#include "terramech/tables/number_text.h"

namespace regoplan {

/// Turns what yaml-cpp has read into nodes that know their place.
struct SettingsTree {
  std::shared_ptr<const std::string> file;

  SettingsError error(const YAML::Mark& mark, std::string_view what) const {
    return SettingsError(mark.is_null() ? fmt::format("{}: {}", *file, what)
                                        : fmt::format("{}:{}: {}", *file, mark.line + 1, what));
  }

  SettingsNode convert(const YAML::Node& yaml, const std::string& path) const {
    SettingsNode node;
    node.file_ = file;
    node.line_ = yaml.Mark().line + 1;
    node.path_ = path;
    if (yaml.IsScalar()) {
      node.kind_ = SettingsNode::Kind::kScalar;
      node.scalar_ = yaml.Scalar();
      node.quoted_ = yaml.Tag() == "!";
    } else if (yaml.IsSequence()) {
      node.kind_ = SettingsNode::Kind::kList;
      for (std::size_t i = 0; i < yaml.size(); ++i) {
        node.list_.push_back(convert(yaml[i], fmt::format("{}[{}]", path, i)));
      }
    } else if (yaml.IsMap()) {
      node.kind_ = SettingsNode::Kind::kMapping;
      std::map<std::string_view, int> lines;
      for (const auto& entry : yaml) add_entry(node, entry.first, entry.second, lines);
    }
    return node;
  }

  /// \param lines where the keys before it stand
  void add_entry(SettingsNode& mapping, const YAML::Node& key, const YAML::Node& value,
                 std::map<std::string_view, int>& lines) const {
    if (!key.IsScalar()) throw error(key.Mark(), "a key must be a plain word");
    const std::string& name = key.Scalar();
    const int line = key.Mark().line + 1;
    const std::string path = mapping.path_.empty() ? name : mapping.path_ + "." + name;
    const auto [earlier, is_new] = lines.emplace(name, line);
    if (!is_new) {
      throw error(key.Mark(),
                  fmt::format("{}: given twice (first in line {})", path, earlier->second));
    }
    SettingsEntry entry{.key = name, .line = line, .value = convert(value, path)};
    // yaml-cpp marks a list or a mapping where its first element stands.
    if (entry.value.kind_ != SettingsNode::Kind::kScalar) entry.value.line_ = line;
    mapping.mapping_.push_back(std::move(entry));
  }
};

namespace {

constexpr std::size_t kBytesMax = 1 << 20;

/// Refuses, before anything is built of it, what costs far more than its length: aliases, which
/// nine levels deep stand for 10^9 values, nesting and sheer number.
class BoundsOfYaml : public YAML::EventHandler {
 public:
  explicit BoundsOfYaml(const SettingsTree& tree) : tree_(tree) {}

  void OnDocumentStart(const YAML::Mark&) override { depth_ = 0; }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { count(mark); }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                const std::string&) override {
    count(mark);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { refuse_alias(mark); }
  void OnAnchor(const YAML::Mark& mark, const std::string&) override { refuse_alias(mark); }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    descend(mark);
  }
  void OnSequenceEnd() override { --depth_; }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {
    descend(mark);
  }
  void OnMapEnd() override { --depth_; }

 private:
  void refuse_alias(const YAML::Mark& mark) const {
    throw tree_.error(mark, "anchors and aliases (&name, *name) are not allowed; write it out");
  }
  void descend(const YAML::Mark& mark) {
    constexpr int kDepthMax = 20;
    if (++depth_ > kDepthMax) {
      throw tree_.error(mark, fmt::format("nested too deeply (allowed: {} levels)", kDepthMax));
    }
    count(mark);
  }
  void count(const YAML::Mark& mark) {
    constexpr int kMost = 100000;
    if (++values_ > kMost) {
      throw tree_.error(mark, fmt::format("too many values (allowed: {})", kMost));
    }
  }

  const SettingsTree& tree_;
  int depth_ = 0;
  int values_ = 0;
};

std::string kind_text(SettingsNode::Kind kind) {
  switch (kind) {
    case SettingsNode::Kind::kEmpty:
      return "nothing";
    case SettingsNode::Kind::kScalar:
      return "a single value";
    case SettingsNode::Kind::kList:
      return "a list";
    case SettingsNode::Kind::kMapping:
      return "a mapping";
  }
  return "";
}

}  // namespace

SettingsError SettingsNode::error(std::string_view what) const {
  return SettingsError(path_.empty() ? fmt::format("{}:{}: {}", *file_, line_, what)
                                     : fmt::format("{}:{}: {}: {}", *file_, line_, path_, what));
}

SettingsError SettingsNode::not_allowed(std::string_view allowed) const {
  if (kind_ != Kind::kScalar) {
    return error(fmt::format("{} is not valid (allowed: {})", kind_text(kind_), allowed));
  }
  // A file of another kind may be one value as a whole.
  const std::string value = quotable(scalar_);
  const std::string shown = quoted_ || value.empty() ? fmt::format("\"{}\"", value) : value;
  return error(fmt::format("{} is not valid (allowed: {})", shown, allowed));
}

std::string number_text(const ValueRange& allowed) {
  const std::string range = allowed.text();
  return range == kAnyNumber.text() ? range : "a number, " + range;
}

double SettingsNode::number(const ValueRange& allowed) const {
  if (kind_ != Kind::kScalar || quoted_) throw not_allowed(number_text(allowed));
  const std::optional<double> value = parse_number(scalar_);
  if (!value) throw not_allowed(number_text(allowed));
  if (!allowed.contains(*value)) throw not_allowed(allowed.text());
  return *value;
}

std::string whole_number_text(std::int64_t min, std::int64_t max) {
  return fmt::format("a whole number, {} to {}", min, max);
}

std::int64_t SettingsNode::integer(std::int64_t min, std::int64_t max) const {
  const std::string allowed = whole_number_text(min, max);
  if (kind_ != Kind::kScalar || quoted_) throw not_allowed(allowed);
  std::int64_t value = 0;
  const char* end = scalar_.data() + scalar_.size();
  const auto [parsed, failed] = std::from_chars(scalar_.data(), end, value);
  if (failed != std::errc() || parsed != end || value < min || value > max) {
    throw not_allowed(allowed);
  }
  return value;
}

bool SettingsNode::truth() const {
  if (quoted_) throw not_allowed("true | false");
  return choice({"true", "false"}) == 0;
}

std::string SettingsNode::text() const {
  if (kind_ != Kind::kScalar || scalar_.empty()) throw not_allowed("text");
  return scalar_;
}

std::size_t SettingsNode::choice(const std::vector<std::string>& choices) const {
  const auto found =
      kind_ == Kind::kScalar ? std::find(choices.begin(), choices.end(), scalar_) : choices.end();
  if (found == choices.end()) throw not_allowed(fmt::format("{}", fmt::join(choices, " | ")));
  return static_cast<std::size_t>(found - choices.begin());
}

const std::vector<SettingsNode>& SettingsNode::list() const {
  if (kind_ != Kind::kList) throw not_allowed("a list");
  return list_;
}

const std::vector<SettingsEntry>& SettingsNode::mapping() const {
  if (kind_ != Kind::kMapping) throw not_allowed("a mapping of keys to values");
  return mapping_;
}

const SettingsNode* SettingsNode::child(std::string_view name) const {
  for (const SettingsEntry& entry : mapping_) {
    if (entry.key == name) return &entry.value;
  }
  for (const SettingsNode& item : list_) {
    const SettingsNode* item_name = item.child("name");
    if (item_name && item_name->scalar_ == name) return &item;
  }
  return nullptr;
}

const SettingsNode* SettingsNode::first_key(std::string_view key) const {
  if (const SettingsNode* found = child(key)) return found;
  for (const SettingsEntry& entry : mapping_) {
    if (const SettingsNode* found = entry.value.first_key(key)) return found;
  }
  for (const SettingsNode& item : list_) {
    if (const SettingsNode* found = item.first_key(key)) return found;
  }
  return nullptr;
}

const SettingsNode* SettingsNode::find(std::string_view field) const {
  std::size_t dot = field.find('.');
  const SettingsNode* node = first_key(field.substr(0, dot));
  while (node && dot != std::string_view::npos) {
    field.remove_prefix(dot + 1);
    dot = field.find('.');
    const SettingsNode* deeper = node->child(field.substr(0, dot));
    if (!deeper) break;
    node = deeper;
  }
  return node;
}

SettingsNode parse_settings(const std::string& text, const std::string& file) {
  const SettingsTree tree{std::make_shared<const std::string>(file)};
  if (text.size() > kBytesMax) {
    throw SettingsError(fmt::format("{}: too long (allowed: {} bytes)", file, kBytesMax));
  }
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    BoundsOfYaml bounds(tree);
    while (parser.HandleNextDocument(bounds)) {
    }
    const std::vector<YAML::Node> documents = YAML::LoadAll(text);
    if (documents.size() > 1) {
      throw SettingsError(
          fmt::format("{}: {} YAML documents (allowed: one)", file, documents.size()));
    }
    if (documents.empty() || documents.front().IsNull()) {
      throw SettingsError(file + ": empty");
    }
    return tree.convert(documents.front(), "");
  } catch (const YAML::Exception& bad) {
    throw tree.error(bad.mark, "not valid YAML: " + bad.msg);
  }
}

std::string settings_text(const std::string& file) {
  if (!std::filesystem::exists(file)) throw SettingsError(file + ": no such file");
  if (std::filesystem::is_directory(file)) throw SettingsError(file + ": is a folder");
  std::ifstream stream(file, std::ios::binary);
  // One byte more tells a file that is too long; a pipe does not say its size.
  std::string text(kBytesMax + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (stream.bad() || !stream.is_open()) {
    throw SettingsError(file + ": cannot be read");
  }
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return text;
}

SettingsNode read_settings(const std::string& file) {
  return parse_settings(settings_text(file), file);
}

}  // namespace regoplan
