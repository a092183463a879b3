#include "reed/inspect/named_values.h"

namespace reed::inspect {

const Eigen::MatrixXd& NamedValues::Get(const std::string& name, Value::Shape shape,
                                        Eigen::Index size) const {
  const auto found = values_.find(name);
  const std::string wanted =
      shape == Value::Shape::kScalar ? "one number" : "a list of " + std::to_string(size) + " numbers";
  if (found == values_.end()) throw CaseError(name + ": missing; expected " + wanted);
  const Value& value = found->second;
  if (value.shape != shape || value.numbers.rows() != size || !value.numbers.allFinite()) {
    throw CaseError(name + ": expected " + wanted + ", all finite");
  }
  return value.numbers;
}

void NamedValues::Copy(const std::string& name, Value::Shape shape, const double* columns, Eigen::Index rows,
                       Eigen::Index cols) {
  Set(name, {shape, Eigen::Map<const Eigen::MatrixXd>(columns, rows, cols)});
}

}  // namespace reed::inspect
