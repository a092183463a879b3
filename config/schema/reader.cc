#include "reed/config/schema/reader.h"

#include <algorithm>
#include <cmath>

#include "reed/config/schema/allowed.h"
#include "reed/config/schema/text_limits.h"
#include "reed/config/sizes/sizes.h"

namespace reed {

std::string ToText(const Bound& bound) {
  const std::string unit = std::string(bound.unit) == "1" ? "" : std::string(" ") + bound.unit;
  return ToText(bound.lo) + " ... " + ToText(bound.hi) + unit;
}

toml::node* Reader::Get(const char* key) {
  known_.emplace_back(key);
  return table_ == nullptr ? nullptr : table_->get(key);
}

void Reader::Fail(const std::string& key, const std::string& problem) const {
  const toml::node* where = table_;
  if (table_ != nullptr) {
    const toml::node* node = table_->get(key.substr(0, key.find('[')));
    if (node != nullptr) where = node;
  }
  doc_.Fail(where, KeyName(key), problem);
}

double Reader::CheckedNumber(const toml::node& node, const std::string& key, const Bound& bound) const {
  const auto number = node.value<double>();
  if (!number || node.is_boolean())
    doc_.Fail(&node, KeyName(key), "expected a number; allowed: " + ToText(bound));
  if (!std::isfinite(*number))
    doc_.Fail(&node, KeyName(key), "not a finite number; allowed: " + ToText(bound));
  if (*number < bound.lo || *number > bound.hi)
    doc_.Fail(&node, KeyName(key), ToText(*number) + " is out of range; allowed: " + ToText(bound));
  return *number;
}

void Reader::Number(const char* key, double& value, Bound bound, const char*) {
  if (const toml::node* node = Get(key)) value = CheckedNumber(*node, key, bound);
}

void Reader::Integer(const char* key, int& value, Bound bound, const char* doc) {
  std::int64_t whole = value;
  Integer(key, whole, bound, doc);
  value = static_cast<int>(whole);
}

void Reader::Integer(const char* key, std::int64_t& value, Bound bound, const char*) {
  const toml::node* node = Get(key);
  if (node == nullptr) return;
  const double number = CheckedNumber(*node, key, bound);
  if (number != std::floor(number)) Fail(key, "expected a whole number; allowed: " + ToText(bound));
  value = static_cast<std::int64_t>(number);
}

void Reader::Seed(const char* key, std::int64_t& value, const char*) {
  const toml::node* node = Get(key);
  if (node == nullptr) return;
  const auto number = node->value_exact<std::int64_t>();
  if (!number || *number < 0) Fail(key, "expected a whole number; allowed: 0 ... 9223372036854775807");
  value = *number;
}

void Reader::Boolean(const char* key, bool& value, const char*) {
  const toml::node* node = Get(key);
  if (node == nullptr) return;
  if (!node->is_boolean()) Fail(key, "allowed: true, false");
  value = *node->value<bool>();
}

void Reader::Text(const char* key, std::string& value, const char*) {
  const toml::node* node = Get(key);
  if (node == nullptr) return;
  if (!node->is_string()) Fail(key, "expected a text in quotes");
  value = *node->value<std::string>();
  if (value.size() > kLongestText) Fail(key, "longer than " + std::to_string(kLongestText) + " bytes");
  if (std::any_of(value.begin(), value.end(),
                  [](char c) { return static_cast<unsigned char>(c) < 0x20U || c == 0x7F; }))
    Fail(key, "has a control character or a line break");
}

void Reader::Numbers(const char* key, std::vector<double>& value, Bound bound, const char*) {
  toml::node* node = Get(key);
  if (node == nullptr) return;
  value.clear();
  if (const toml::array* array = node->as_array()) {
    for (std::size_t i = 0; i < array->size(); ++i)
      value.push_back(CheckedNumber((*array)[i], std::string(key) + "[" + std::to_string(i) + "]", bound));
  } else {
    value.push_back(CheckedNumber(*node, key, bound));
  }
}

void Reader::Vector(const char* key, Eigen::Vector3d& value, Bound bound, const char* doc) {
  if (!Has(key)) {
    known_.emplace_back(key);
    return;
  }
  std::vector<double> numbers;
  Numbers(key, numbers, bound, doc);
  if (numbers.size() != 3) Fail(key, "expected three numbers [x, y, z] in " + std::string(bound.unit));
  value = Eigen::Vector3d(numbers[0], numbers[1], numbers[2]);
}

void Reader::Required(const char* key, double& value, Bound bound, const char* doc) {
  if (!Has(key)) Fail(key, "missing; allowed: " + ToText(bound));
  Number(key, value, bound, doc);
}

void Reader::PerJoint(const char* key, std::vector<double>& value, Bound bound, const char* doc) {
  Numbers(key, value, bound, doc);
  const auto joints = static_cast<std::size_t>(joints_);
  if (value.size() == 1) value.assign(joints, value[0]);
  if (!value.empty() && value.size() != joints)
    Fail(key, std::to_string(value.size()) + " numbers for " + std::to_string(joints) +
                  " joints; one per joint, or one for all");
}

void Reader::Rows(const char* key, std::vector<std::vector<double>>& value, Bound bound, const char*) {
  if (Get(key) == nullptr) return;
  value = Rows(key, 1, kMaxJoints);
  for (std::size_t i = 0; i < value.size(); ++i)
    for (const double number : value[i])
      if (number < bound.lo || number > bound.hi)
        Fail(std::string(key) + "[" + std::to_string(i) + "]",
             ToText(number) + " is out of range; allowed: " + ToText(bound));
}

std::vector<std::vector<double>> Reader::Rows(const char* key, std::size_t width, std::size_t widest) {
  const std::string size = std::to_string(width) + (widest > width + 1 ? " ... " + std::to_string(widest)
                                                    : widest > width   ? " or " + std::to_string(widest)
                                                                       : "");
  toml::node* node = Get(key);
  std::vector<std::vector<double>> rows;
  if (node == nullptr) return rows;
  const toml::array* array = node->as_array();
  if (array == nullptr) Fail(key, "expected a list of rows of " + size + " numbers");
  for (std::size_t i = 0; i < array->size(); ++i) {
    const std::string name = std::string(key) + "[" + std::to_string(i) + "]";
    const toml::array* row = (*array)[i].as_array();
    if (row == nullptr || row->size() < width || row->size() > std::max(width, widest))
      doc_.Fail(&(*array)[i], KeyName(name), "expected a row of " + size + " numbers");
    std::vector<double> numbers;
    for (const toml::node& cell : *row) {
      const auto number = cell.value<double>();
      if (!number || !std::isfinite(*number)) doc_.Fail(&cell, KeyName(name), "expected a finite number");
      numbers.push_back(*number);
    }
    rows.push_back(numbers);
  }
  return rows;
}

void Reader::Matrix(const char* key, Eigen::Matrix3d& value, Bound bound, const char*) {
  const std::vector<std::vector<double>> rows = Rows(key, 3);
  if (rows.empty()) return;
  if (rows.size() != 3) Fail(key, "expected three rows of three numbers in " + std::string(bound.unit));
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) value(r, c) = rows[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)];
  if (value.minCoeff() < bound.lo || value.maxCoeff() > bound.hi)
    Fail(key, "out of range; allowed: " + ToText(bound));
}

void Reader::ChoiceIndex(const char* key, int& index, const std::vector<std::string>& allowed, const char*) {
  const toml::node* node = Get(key);
  if (node == nullptr) return;
  const auto text = node->value_exact<std::string>();
  const auto found = text ? std::find(allowed.begin(), allowed.end(), *text) : allowed.end();
  if (found == allowed.end()) {
    Fail(key, (text ? "'" + *text + "' is unknown" : std::string("expected a text")) + "; " +
                  Allowed(text.value_or(""), allowed));
  }
  index = static_cast<int>(found - allowed.begin());
}

void Reader::RefuseUnknown() const {
  if (table_ == nullptr) return;
  for (const auto& [key, node] : *table_) {
    if (std::find(known_.begin(), known_.end(), key.str()) != known_.end()) continue;
    const std::string word(key.str());
    doc_.Fail(&node, KeyName(word), "unknown key; " + Allowed(word, known_));
  }
}

}  // namespace reed
