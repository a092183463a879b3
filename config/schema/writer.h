// Writes the fields of one section into a TOML table; the reader's twin. RT: set-up only.
#pragma once

#include <toml++/toml.h>

#include <Eigen/Core>

#include "reed/config/schema/bound.h"

namespace reed {

inline toml::array ToToml(const std::vector<double>& numbers) {
  toml::array out;
  for (const double number : numbers) out.push_back(number);
  return out;
}

inline toml::array ToToml(const Eigen::Vector3d& v) { return toml::array{v.x(), v.y(), v.z()}; }

inline toml::array ToToml(const Eigen::Matrix3d& m) {
  toml::array out;
  for (int r = 0; r < 3; ++r) out.push_back(ToToml(Eigen::Vector3d(m.row(r).transpose())));
  return out;
}

class Writer {
 public:
  explicit Writer(toml::table& table) : table_(table) {}

  void Number(const char* key, double value, Bound, const char*) { table_.insert_or_assign(key, value); }
  void Integer(const char* key, std::int64_t value, Bound, const char*) {
    table_.insert_or_assign(key, value);
  }
  void Seed(const char* key, std::int64_t value, const char*) { table_.insert_or_assign(key, value); }
  void Boolean(const char* key, bool value, const char*) { table_.insert_or_assign(key, value); }
  void Text(const char* key, const std::string& value, const char*) { table_.insert_or_assign(key, value); }
  void Vector(const char* key, const Eigen::Vector3d& value, Bound, const char*) {
    table_.insert_or_assign(key, ToToml(value));
  }
  void Numbers(const char* key, const std::vector<double>& value, Bound, const char*) {
    if (!value.empty()) table_.insert_or_assign(key, ToToml(value));
  }
  void Rows(const char* key, const std::vector<std::vector<double>>& rows, Bound, const char*) {
    toml::array out;
    for (const std::vector<double>& row : rows) out.push_back(ToToml(row));
    if (!rows.empty()) table_.insert_or_assign(key, out);
  }
  void Required(const char* key, double value, Bound bound, const char* doc) {
    Number(key, value, bound, doc);
  }
  void PerJoint(const char* key, const std::vector<double>& value, Bound bound, const char* doc) {
    Numbers(key, value, bound, doc);
  }
  void Matrix(const char* key, const Eigen::Matrix3d& value, Bound, const char*) {
    table_.insert_or_assign(key, ToToml(value));
  }
  template <typename Enum, std::size_t K>
  void Choice(const char* key, Enum value, const char* const (&names)[K], const char*) {
    table_.insert_or_assign(key, names[static_cast<std::size_t>(value)]);
  }

 private:
  toml::table& table_;
};

}  // namespace reed
