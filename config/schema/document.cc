#include "reed/config/schema/document.h"

#include <charconv>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "reed/config/schema/text_limits.h"

namespace reed {
namespace {

std::string ReadWhole(const std::string& path) {
  std::error_code ec;
  if (!std::filesystem::is_regular_file(path, ec)) throw ConfigError(path + ": no such file");
  if (std::filesystem::file_size(path, ec) > kLargestFile_bytes || ec)
    throw ConfigError(path + ": larger than " + std::to_string(kLargestFile_bytes >> 20U) +
                      " MiB, no configuration");
  std::ifstream in(path);
  if (!in) throw ConfigError(path + ": cannot be read");
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

toml::array ToTomlArray(const nlohmann::json& json);

toml::table ToTomlTable(const nlohmann::json& json);

template <typename Insert>
void ConvertValue(const nlohmann::json& json, Insert insert) {
  switch (json.type()) {
    case nlohmann::json::value_t::object:
      insert(ToTomlTable(json));
      break;
    case nlohmann::json::value_t::array:
      insert(ToTomlArray(json));
      break;
    case nlohmann::json::value_t::string:
      insert(json.get<std::string>());
      break;
    case nlohmann::json::value_t::boolean:
      insert(json.get<bool>());
      break;
    case nlohmann::json::value_t::number_integer:
      insert(json.get<std::int64_t>());
      break;
    case nlohmann::json::value_t::number_unsigned:  // of 64 bits: TOML's integers have a sign
      if (json.get<std::uint64_t>() <= static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()))
        insert(json.get<std::int64_t>());
      else
        insert(json.get<double>());
      break;
    case nlohmann::json::value_t::number_float:
      insert(json.get<double>());
      break;
    default:
      break;  // null: as if the key were absent
  }
}

toml::array ToTomlArray(const nlohmann::json& json) {
  toml::array out;
  for (const auto& item : json)
    ConvertValue(item, [&](auto&& value) { out.push_back(std::forward<decltype(value)>(value)); });
  return out;
}

toml::table ToTomlTable(const nlohmann::json& json) {
  toml::table out;
  for (const auto& item : json.items())
    ConvertValue(item.value(), [&](auto&& value) {
      out.insert_or_assign(item.key(), std::forward<decltype(value)>(value));
    });
  return out;
}

std::size_t LineOfByte(const std::string& text, std::size_t byte) {
  return 1 +
         static_cast<std::size_t>(std::count(
             text.begin(), text.begin() + static_cast<std::ptrdiff_t>(std::min(byte, text.size())), '\n'));
}

static_assert(kDeepestNesting == 64);
constexpr const char* kTooDeep = "nested deeper than 64 levels, no configuration";

toml::table ParseJson(const std::string& path, const std::string& text) {
  try {
    const auto not_too_deep = [&](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
      if (depth > kDeepestNesting) throw ConfigError(path + ": " + kTooDeep);
      return true;
    };
    const nlohmann::json json = nlohmann::json::parse(text, not_too_deep);
    if (!json.is_object()) throw ConfigError(path + ":1: expected an object {...}");
    return ToTomlTable(json);
  } catch (const nlohmann::json::parse_error& error) {
    throw ConfigError(path + ":" + std::to_string(LineOfByte(text, error.byte)) + ": not JSON");
  } catch (const nlohmann::json::exception& error) {
    throw ConfigError(path + ": " + error.what());
  }
}

/// First line on which a JSON text writes the last name of a key such as "bodies[1].mass".
std::size_t LineOfKey(const std::string& text, const std::string& key) {
  std::string name = key.substr(0, key.find('['));
  const std::size_t tail = key.rfind('.');
  if (tail != std::string::npos) name = key.substr(tail + 1);
  name = name.substr(0, name.find('['));
  const std::size_t at = text.find('"' + name + '"');
  return at == std::string::npos ? 1 : LineOfByte(text, at);
}

std::vector<std::string> SplitPath(const std::string& dotted) {
  std::vector<std::string> parts;
  std::istringstream in(dotted);
  for (std::string part; std::getline(in, part, '.');) parts.push_back(part);
  return parts;
}

/// No longer than a name may be.
std::string Cut(const std::string& text) {
  if (text.size() <= kLongestName) return text;
  std::size_t end = kLongestName;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;  // not inside a letter
  return text.substr(0, end);
}

/// A key in an error line: what is wrong with it stays in the line, however long it is.
std::string Short(const std::string& key) { return key.size() <= kLongestName ? key : Cut(key) + " ..."; }

}  // namespace

Document Document::Load(const std::string& path) {
  Document doc;
  doc.path_ = path;
  const std::string text = ReadWhole(path);
  if (path.ends_with(".json")) {
    doc.root_ = ParseJson(path, text);
    doc.json_texts_.emplace_back(path, text);
    return doc;
  }
  if (const std::size_t line = LineOfDeepKey(text); line > 0)
    throw ConfigError(path + ":" + std::to_string(line) + ": " + kTooDeep);
  try {
    doc.root_ = toml::parse(text, path);
  } catch (const toml::parse_error& error) {
    throw ConfigError(path + ":" + std::to_string(error.source().begin.line) +
                      ": not TOML: " + std::string(error.description()));
  }
  return doc;
}

std::string Document::stem() const { return Cut(std::filesystem::path(path_).stem().string()); }

void Document::Graft(const std::string& section, Document&& other) {
  root_.insert_or_assign(section, std::move(other.root_));
  for (auto& text : other.json_texts_) json_texts_.push_back(std::move(text));
}

void Document::Override(const std::string& assignment, const std::string& typed) {
  const auto refuse = [&](const std::string& problem) {
    throw ConfigError("--set " + assignment.substr(0, kLongestName) + ": " + problem);
  };
  if (LineOfDeepKey(assignment) > 0) refuse(kTooDeep);
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0) refuse("expected SECTION.KEY=VALUE");
  const std::string dotted = assignment.substr(0, equals);
  const std::string value_text = assignment.substr(equals + 1);

  toml::table parsed;
  try {
    parsed = toml::parse("value = " + value_text);
  } catch (const toml::parse_error&) {
    parsed.insert("value", value_text);  // a bare word is a string
  }

  const auto index_in = [&](const toml::array& array, const std::string& part) {
    std::size_t index = array.size();
    const auto end = std::from_chars(part.data(), part.data() + part.size(), index);
    if (end.ec != std::errc{} || end.ptr != part.data() + part.size() || index >= array.size())
      refuse("no entry '" + part + "'; " +
             (array.empty() ? "the list is empty" : "allowed: 0 ... " + std::to_string(array.size() - 1)));
    return index;
  };
  const std::vector<std::string> parts = SplitPath(dotted);
  toml::node* node = &root_;
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    toml::node* next = nullptr;
    if (toml::table* table = node->as_table()) {
      next = table->get(parts[i]);
      if (next == nullptr) {
        table->insert(parts[i], toml::table{});
        next = table->get(parts[i]);
      }
    } else if (toml::array* array = node->as_array()) {
      next = array->get(index_in(*array, parts[i]));
    }
    if (next == nullptr || (!next->is_table() && !next->is_array()))
      refuse("'" + parts[i] + "' is not a section");
    node = next;
  }
  toml::node* value = parsed.get("value");
  if (toml::table* table = node->as_table()) {
    value->visit([&](auto& concrete) { table->insert_or_assign(parts.back(), concrete); });
  } else if (toml::array* array = node->as_array()) {
    const std::size_t index = index_in(*array, parts.back());
    value->visit([&](auto& concrete) {
      array->replace(array->cbegin() + static_cast<std::ptrdiff_t>(index), concrete);
    });
  }
  overridden_[dotted] = typed.empty() ? dotted : typed;
}

void Document::Fail(const toml::node* where, const std::string& whole_key, const std::string& problem) const {
  const std::string key = Short(whole_key);
  std::string plain;  // key with [i] written as .i, as --set takes it
  for (const char c : whole_key) {
    if (c == '[')
      plain += '.';
    else if (c != ']')
      plain += c;
  }
  const bool written = where != nullptr && where->source().path && where->source().begin;
  for (const auto& [set, typed] : overridden_)
    if (plain == set || plain.starts_with(set + ".") || (!written && set.starts_with(plain + ".")))
      throw ConfigError("--set " + Short(typed) + ": " + (plain == set ? "" : key + ": ") + problem);
  if (written)
    throw ConfigError(*where->source().path + ":" + std::to_string(where->source().begin.line) + ": " + key +
                      ": " + problem);
  for (const auto& [path, text] : json_texts_)
    throw ConfigError(path + ":" + std::to_string(LineOfKey(text, whole_key)) + ": " + key + ": " + problem);
  throw ConfigError(path_ + ": " + key + ": " + problem);
}

}  // namespace reed
