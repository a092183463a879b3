// The numbers of one case by name, each a scalar, a vector or a matrix. RT: set-up only (allocates, throws).
#pragma once

#include <Eigen/Core>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

namespace reed::inspect {

/// Something in the input that cannot be worked with; the text names the key and what it must be.
class CaseError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Value {
  enum class Shape { kScalar, kVector, kMatrix } shape = Shape::kScalar;
  Eigen::MatrixXd numbers;  // 1x1, nx1 or rows x columns
};

class NamedValues {
 public:
  bool Has(const std::string& name) const { return values_.contains(name); }
  template <typename... Names>
  bool HasAll(const Names&... names) const {
    return (Has(names) && ...);
  }

  double Scalar(const std::string& name) const { return Get(name, Value::Shape::kScalar, 1)(0); }

  /// Exactly N numbers, or a CaseError.
  template <int N>
  Eigen::Matrix<double, N, 1> Vector(const std::string& name) const {
    return Get(name, Value::Shape::kVector, N);
  }
  Eigen::VectorXd Vector(const std::string& name, Eigen::Index size) const {
    return Get(name, Value::Shape::kVector, size);
  }

  void SetScalar(const std::string& name, double value) {
    Set(name, {Value::Shape::kScalar, Eigen::MatrixXd::Constant(1, 1, value)});
  }
  /// Matrices of any size, by one copy for all of them. `used`: so many leading entries or columns.
  template <int R>
  void SetVector(const std::string& name, const Eigen::Matrix<double, R, 1>& value) {
    SetVector(name, value, value.rows());
  }
  template <int R>
  void SetVector(const std::string& name, const Eigen::Matrix<double, R, 1>& value, Eigen::Index used) {
    Copy(name, Value::Shape::kVector, value.data(), used, 1);
  }
  template <int R, int C>
  void SetMatrix(const std::string& name, const Eigen::Matrix<double, R, C>& value) {
    SetMatrix(name, value, value.cols());
  }
  template <int R, int C>
  void SetMatrix(const std::string& name, const Eigen::Matrix<double, R, C>& value, Eigen::Index used) {
    Copy(name, Value::Shape::kMatrix, value.data(), value.rows(), used);
  }
  void Set(const std::string& name, Value value) { values_[name] = std::move(value); }

  const std::map<std::string, Value>& all() const { return values_; }

 private:
  void Copy(const std::string& name, Value::Shape shape, const double* columns, Eigen::Index rows,
            Eigen::Index cols);
  const Eigen::MatrixXd& Get(const std::string& name, Value::Shape shape, Eigen::Index size) const;

  std::map<std::string, Value> values_;
};

}  // namespace reed::inspect
