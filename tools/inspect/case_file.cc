#include "reed/inspect/case_file.h"

#include <istream>
#include <limits>
#include <nlohmann/json.hpp>
#include <ostream>

namespace reed::inspect {
namespace {

using Json = nlohmann::ordered_json;

bool IsListOfNumbers(const Json& list) {
  for (const Json& item : list) {
    if (!item.is_number()) return false;
  }
  return list.is_array();
}

bool IsListOfRows(const Json& list) {
  for (const Json& row : list) {
    if (!IsListOfNumbers(row) || row.size() != list.front().size()) return false;
  }
  return list.is_array() && !list.empty();
}

/// Adds what is numeric; notes and nested tables are nobody's input.
void Add(const std::string& name, const Json& node, NamedValues& values) {
  if (node.is_number()) {
    values.SetScalar(name, node.get<double>());
  } else if (IsListOfNumbers(node)) {
    const auto numbers = node.get<std::vector<double>>();
    values.SetVector<Eigen::Dynamic>(name,
                                     Eigen::Map<const Eigen::VectorXd>(numbers.data(), std::ssize(numbers)));
  } else if (IsListOfRows(node)) {
    Eigen::MatrixXd matrix(std::ssize(node), std::ssize(node.front()));
    for (Eigen::Index r = 0; r < matrix.rows(); ++r) {
      for (Eigen::Index c = 0; c < matrix.cols(); ++c) {
        matrix(r, c) = node[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)].get<double>();
      }
    }
    values.SetMatrix(name, matrix);
  }
}

Json Row(const Eigen::MatrixXd& numbers, Eigen::Index r) {
  Json row = Json::array();
  for (Eigen::Index c = 0; c < numbers.cols(); ++c) row.push_back(numbers(r, c));
  return row;
}

Json ToJson(const Value& value) {
  if (value.shape == Value::Shape::kScalar) return value.numbers(0, 0);
  if (value.shape == Value::Shape::kVector) return Row(value.numbers.transpose(), 0);
  Json rows = Json::array();
  for (Eigen::Index r = 0; r < value.numbers.rows(); ++r) rows.push_back(Row(value.numbers, r));
  return rows;
}

}  // namespace

std::vector<Case> ReadCases(std::istream& in) {
  Json file;
  try {
    file = Json::parse(in);
  } catch (const Json::parse_error& error) {
    throw CaseError("not JSON, byte " + std::to_string(error.byte));
  }
  if (!file.is_object() || !file.contains("cases") || !file["cases"].is_array()) {
    throw CaseError("expected an object with a list \"cases\"");
  }
  NamedValues shared;
  for (const auto& [name, node] : file.items()) {
    if (name != "cases") Add(name, node, shared);
  }
  std::vector<Case> cases;
  for (const Json& item : file["cases"]) {
    if (!item.is_object()) throw CaseError("cases[" + std::to_string(cases.size()) + "]: expected an object");
    Case read{shared, {}};
    for (const auto& [name, node] : item.items()) {
      Add(name, node, read.values);
      if (node.is_number() || node.is_array()) read.names.push_back(name);
    }
    cases.push_back(std::move(read));
  }
  return cases;
}

void WriteCases(std::ostream& out, const std::string& arm, const std::vector<NamedValues>& cases) {
  Json list = Json::array();
  for (const NamedValues& values : cases) {
    Json item = Json::object();
    for (const auto& [name, value] : values.all()) item[name] = ToJson(value);
    list.push_back(std::move(item));
  }
  out << Json{{"arm", arm}, {"cases", std::move(list)}}.dump() << '\n';
}

}  // namespace reed::inspect
