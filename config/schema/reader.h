// Reads the fields of one section, checks each against its bound, and knows which keys nobody asked for.
// It is one of three visitors of the schema (fields.h): reader, writer, lister. RT: set-up only.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "reed/config/schema/bound.h"
#include "reed/config/schema/document.h"

namespace reed {

class Reader {
 public:
  /// `table` may be null: an absent section, every field keeps its default.
  Reader(const Document& doc, toml::table* table, std::string section, int joints = 0)
      : doc_(doc), table_(table), section_(std::move(section)), joints_(joints) {}

  void Number(const char* key, double& value, Bound bound, const char* doc);
  void Integer(const char* key, int& value, Bound bound, const char* doc);
  void Integer(const char* key, std::int64_t& value, Bound bound, const char* doc);
  void Seed(const char* key, std::int64_t& value, const char* doc);
  void Boolean(const char* key, bool& value, const char* doc);
  void Text(const char* key, std::string& value, const char* doc);
  void Vector(const char* key, Eigen::Vector3d& value, Bound bound, const char* doc);
  void Numbers(const char* key, std::vector<double>& value, Bound bound, const char* doc);
  /// A list of rows, one number per joint in each.
  void Rows(const char* key, std::vector<std::vector<double>>& value, Bound bound, const char* doc);
  /// A number without a default.
  void Required(const char* key, double& value, Bound bound, const char* doc);
  /// None, one for all joints, or one per joint.
  void PerJoint(const char* key, std::vector<double>& value, Bound bound, const char* doc);
  /// Three rows of three numbers.
  void Matrix(const char* key, Eigen::Matrix3d& value, Bound bound, const char* doc);
  /// A list of rows of numbers: `width` in each, or up to `widest`.
  std::vector<std::vector<double>> Rows(const char* key, std::size_t width, std::size_t widest = 0);

  /// Enumerations: names[i] is the text of value i.
  template <typename Enum, std::size_t K>
  void Choice(const char* key, Enum& value, const char* const (&names)[K], const char* doc) {
    const std::vector<std::string> allowed(std::begin(names), std::end(names));
    int index = static_cast<int>(value);
    ChoiceIndex(key, index, allowed, doc);
    value = static_cast<Enum>(index);
  }

  int joints() const { return joints_; }
  bool Has(const char* key) const { return table_ != nullptr && table_->contains(key); }
  toml::node* Get(const char* key);  // marks the key as known
  std::string KeyName(const std::string& key) const { return section_.empty() ? key : section_ + "." + key; }
  [[noreturn]] void Fail(const std::string& key, const std::string& problem) const;

  /// Throws for the first key that no field asked for, naming the keys there are.
  void RefuseUnknown() const;

  const Document& document() const { return doc_; }

 private:
  void ChoiceIndex(const char* key, int& index, const std::vector<std::string>& allowed, const char* doc);
  double CheckedNumber(const toml::node& node, const std::string& key, const Bound& bound) const;

  const Document& doc_;
  toml::table* table_;
  std::string section_;
  int joints_;
  std::vector<std::string> known_;
};

}  // namespace reed
